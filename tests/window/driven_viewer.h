// SPDX-License-Identifier: MIT
// Drives the viewer as a user does: a window on an X server, with mouse and key events from
// xdotool.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/program/run.h"

namespace grisaille::tests {

struct Point {
  int x = 0, y = 0;
};

class DrivenViewer {
 public:
  // Runs `grisaille view ARGUMENTS --layout FILE` in the folder, which also holds the viewer's
  // saved state. Waits for the first picture; throws std::runtime_error if none appears.
  DrivenViewer(const TemporaryFolder& folder, std::vector<std::string> arguments,
               std::vector<std::string> environment = {});
  ~DrivenViewer();  // ends the viewer

  // The viewer's report on its controls, by name.
  nlohmann::json layout() const;
  std::string value(const std::string& control) const;  // "": not visible

  // Waits until `holds` returns true. Throws std::runtime_error with `what` after 200 seconds.
  void until(const std::string& what, const std::function<bool(const nlohmann::json&)>& holds);
  void untilValue(const std::string& control, const std::string& value);
  void untilChanged(const std::string& control, const std::string& from);
  void untilThere(const std::string& control);
  void untilDrawn();  // waits until the viewer has drawn everything

  Point middle(const std::string& control) const;
  // A point of a control; x and y are shares of its width and height.
  Point at(const std::string& control, double x, double y) const;

  void click(Point point, int button = 1);
  void click(const std::string& control, int button = 1) { click(middle(control), button); }
  // Clicks a field until it takes text. Throws std::runtime_error if it never does.
  void clickText(const std::string& control);
  void drag(Point from, Point to, int button = 1);
  void key(const std::string& keys) { send("key " + keys); }
  void type(const std::string& text) { send("type " + text); }
  void send(const std::string& words);  // arguments of xdotool

  // Presses F12. Returns the path of the EXR that the viewer writes.
  std::string savePicture();

  // Presses Ctrl+Q. Call it once.
  Outcome quit();
  // Waits for a viewer that ends by itself. Call it once.
  Outcome ended() { return outcome_.get(); }

  // Gives the window the keys, also a window that has replaced the first one.
  void focus();

 private:
  bool isDrawn(const nlohmann::json& now) const;

  const TemporaryFolder& folder_;
  std::string layoutFile_;
  std::future<Outcome> outcome_;
  std::string drawnBefore_;  // frames drawn at the last xdotool command
  std::chrono::steady_clock::time_point sent_;
};

}  // namespace grisaille::tests
