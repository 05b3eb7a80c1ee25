// SPDX-License-Identifier: MIT
// Where each control lies, for programs that drive the viewer from outside: tests, screen readers.
#pragma once

#include <map>
#include <string>

namespace grisaille::app::viewer {

class Layout {
 public:
  void begin() { controls_.clear(); }

  // The item that ImGui drew last, where it can be seen. `value` as the control shows it.
  void note(const std::string& name, const std::string& value = "");
  // Pixels of the window: left, top, right, bottom.
  void note(const std::string& name, float left, float top, float right, float bottom,
            const std::string& value = "");

  // {"name": {"rect": [left, top, right, bottom], "value": "..."}, ...}
  std::string json() const;

 private:
  struct Control {
    float rect[4];
    std::string value;
  };
  std::map<std::string, Control> controls_;
};

}  // namespace grisaille::app::viewer
