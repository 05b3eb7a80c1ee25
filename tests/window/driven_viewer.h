// SPDX-License-Identifier: MIT
// The viewer as people drive it: a window on an X server, mouse and keys sent by xdotool.
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
  // `grisaille view ARGUMENTS --layout FILE` in the folder, which also keeps what the viewer
  // remembers. Waits for its first picture. Throws std::runtime_error where it does not come.
  DrivenViewer(const TemporaryFolder& folder, std::vector<std::string> arguments,
               std::vector<std::string> environment = {});
  ~DrivenViewer();  // ends it

  // What the viewer says of its controls, by name.
  nlohmann::json layout() const;
  std::string value(const std::string& control) const;  // "": it cannot be seen

  // Waits; throws std::runtime_error with `what` after 200 seconds.
  void until(const std::string& what, const std::function<bool(const nlohmann::json&)>& holds);
  void untilValue(const std::string& control, const std::string& value);
  void untilChanged(const std::string& control, const std::string& from);
  void untilThere(const std::string& control);
  void untilDrawn();  // nothing is left to draw

  Point middle(const std::string& control) const;
  // Of the control's width and height.
  Point at(const std::string& control, double x, double y) const;

  void click(Point point, int button = 1);
  void click(const std::string& control, int button = 1) { click(middle(control), button); }
  void drag(Point from, Point to, int button = 1);
  void key(const std::string& keys) { send("key " + keys); }
  void type(const std::string& text) { send("type " + text); }
  void send(const std::string& words);  // to xdotool

  // F12; the path of the EXR that it wrote.
  std::string savePicture();

  // Ctrl+Q. Once.
  Outcome quit();
  // Once it has ended by itself. Once.
  Outcome ended() { return outcome_.get(); }

 private:
  void focus();
  bool isDrawn(const nlohmann::json& now) const;

  const TemporaryFolder& folder_;
  std::string layoutFile_;
  std::future<Outcome> outcome_;
  std::string drawnBefore_;  // frames, when words went to xdotool
  std::chrono::steady_clock::time_point sent_;
};

}  // namespace grisaille::tests
