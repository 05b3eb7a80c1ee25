// SPDX-License-Identifier: MIT
#include "tests/window/driven_viewer.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace grisaille::tests {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatience(200);
constexpr std::chrono::milliseconds kLook(10);
constexpr std::chrono::seconds kQuits(20);          // longest time from the key to the viewer's end
constexpr std::chrono::milliseconds kArrives(300);  // longest delay of input by xdotool

}  // namespace

DrivenViewer::DrivenViewer(const TemporaryFolder& folder, std::vector<std::string> arguments,
                           std::vector<std::string> environment)
    : folder_(folder), layoutFile_(folder / "layout.json") {
  std::filesystem::remove(layoutFile_);
  std::vector<std::string> all = {"view", "--layout", layoutFile_, "--check"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  environment.push_back("XDG_STATE_HOME=" + (folder / "state"));
  environment.push_back("XDG_CONFIG_HOME=" + (folder / "config"));
  // No dialog on the desktop of whoever runs the tests.
  if (std::ranges::none_of(environment, [](const std::string& one) {
        return one.starts_with("DBUS_SESSION_BUS_ADDRESS=");
      })) {
    environment.push_back("DBUS_SESSION_BUS_ADDRESS=");
  }
  outcome_ = std::async(std::launch::async, [all, environment, path = folder.path()] {
    return runProgram(all, path, environment);
  });
  untilDrawn();
  focus();
}

// Keys go to the focused window. Without a window manager, the test must set the focus itself.
void DrivenViewer::focus() {
  const Point at = middle("picture");
  send("search --sync --name Grisaille windowfocus --sync mousemove " + std::to_string(at.x) + " " +
       std::to_string(at.y));
  untilDrawn();
}

DrivenViewer::~DrivenViewer() {
  if (!outcome_.valid()) return;
  try {
    quit();
  } catch (const std::exception&) {
    // The time limit of runProgram() ends it.
  }
}

nlohmann::json DrivenViewer::layout() const {
  if (!std::filesystem::exists(layoutFile_)) return nlohmann::json::object();
  return nlohmann::json::parse(readFile(layoutFile_));
}

std::string DrivenViewer::value(const std::string& control) const {
  const nlohmann::json all = layout();
  return all.contains(control) ? all[control].value("value", "") : "";
}

void DrivenViewer::until(const std::string& what,
                         const std::function<bool(const nlohmann::json&)>& holds) {
  const auto end = Clock::now() + kPatience;
  while (Clock::now() < end) {
    const nlohmann::json now = layout();
    if (holds(now)) return;
    if (outcome_.wait_for(kLook) == std::future_status::ready) {
      const Outcome outcome = outcome_.get();
      throw std::runtime_error(what + ": the viewer ended with status " +
                               std::to_string(outcome.status) + ": " + outcome.err);
    }
  }
  throw std::runtime_error(what + " did not appear: " + layout().dump());
}

void DrivenViewer::untilValue(const std::string& control, const std::string& value) {
  until(control + " = " + value, [&](const nlohmann::json& now) {
    return now.contains(control) && now[control]["value"] == value;
  });
  untilDrawn();
}

void DrivenViewer::untilChanged(const std::string& control, const std::string& from) {
  until(control + " other than " + from, [&](const nlohmann::json& now) {
    return now.contains(control) && now[control]["value"] != from;
  });
  untilDrawn();
}

void DrivenViewer::untilThere(const std::string& control) {
  until(control, [&](const nlohmann::json& now) { return now.contains(control); });
  untilDrawn();
}

void DrivenViewer::untilDrawn() {
  until("a picture", [&](const nlohmann::json& now) { return isDrawn(now); });
}

// Input has arrived once the viewer has drawn a frame for it. Input without effect draws no frame.
bool DrivenViewer::isDrawn(const nlohmann::json& now) const {
  if (!now.contains("picture")) return false;
  const std::string picture = now["picture"]["value"];
  if (picture != "done" && picture != "empty") return false;
  return now["drawn"]["value"] != drawnBefore_ || Clock::now() - sent_ > kArrives;
}

Point DrivenViewer::at(const std::string& control, double x, double y) const {
  const nlohmann::json all = layout();
  if (!all.contains(control)) throw std::runtime_error(control + " is not visible");
  const auto rect = all[control]["rect"].get<std::vector<double>>();
  return {static_cast<int>(rect[0] + x * (rect[2] - rect[0])),
          static_cast<int>(rect[1] + y * (rect[3] - rect[1]))};
}

Point DrivenViewer::middle(const std::string& control) const {
  return at(control, 0.5, 0.5);
}

void DrivenViewer::send(const std::string& words) {
  // Waits until the previous input is drawn. A viewer that sprays never stops drawing, hence the
  // limit.
  for (const auto end = Clock::now() + kArrives; !isDrawn(layout()) && Clock::now() < end;) {
    std::this_thread::sleep_for(kLook);
  }
  drawnBefore_ = value("drawn");
  sent_ = Clock::now();
  if (std::system(("xdotool " + words).c_str()) != 0) {
    throw std::runtime_error("xdotool fails at: " + words);
  }
}

void DrivenViewer::click(Point point, int button) {
  send("mousemove " + std::to_string(point.x) + " " + std::to_string(point.y) + " click " +
       std::to_string(button));
}

void DrivenViewer::clickText(const std::string& control) {
  // On a busy machine the panel may still move when the pointer arrives.
  for (int attempt = 0; attempt < 5; ++attempt) {
    click(control);
    untilDrawn();
    if (value("typing") == "true") return;
  }
  throw std::runtime_error(control + " takes no text: " + layout().dump());
}

void DrivenViewer::drag(Point from, Point to, int button) {
  const auto move = [](Point p) {
    return "mousemove " + std::to_string(p.x) + " " + std::to_string(p.y);
  };
  const std::string b = std::to_string(button);
  send(move(from) + " mousedown " + b);
  untilDrawn();
  send(move(to));
  untilDrawn();
  send("mouseup " + b);
  untilDrawn();
}

std::string DrivenViewer::savePicture() {
  const std::string before = value("message");
  key("F12");
  untilChanged("message", before);
  std::string newest;
  for (const std::string& file : folder_.files()) {
    if (file.ends_with(".exr") && (newest.empty() || before.find(file) == std::string::npos)) {
      if (value("message").find(file) != std::string::npos) newest = file;
    }
  }
  if (newest.empty()) throw std::runtime_error("no picture: " + value("message"));
  return folder_ / newest;
}

Outcome DrivenViewer::quit() {
  // After earlier input the window may be changing its size or its focus. It then refuses the
  // focus, or loses the key.
  const auto end = Clock::now() + kPatience;
  std::future_status status = std::future_status::timeout;
  do {
    try {
      send("search --name Grisaille windowfocus key ctrl+q");
      status = outcome_.wait_for(kQuits);
    } catch (const std::runtime_error&) {
      status = outcome_.wait_for(kArrives);
    }
  } while (status != std::future_status::ready && Clock::now() < end);
  return outcome_.get();
}

}  // namespace grisaille::tests
