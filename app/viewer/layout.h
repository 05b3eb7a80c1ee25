// SPDX-License-Identifier: MIT
// Records the rectangle of each control, for programs that drive the viewer from outside: tests,
// screen readers.
#pragma once

#include <map>
#include <string>

namespace grisaille::app::viewer {

class Layout {
 public:
  void begin() { controls_.clear(); }

  // Records the last item that ImGui drew, if it is visible. `value`: as the control shows it. The
  // item that has the keyboard's focus is also recorded as "focus", with its name as the value.
  void note(const std::string& name, const std::string& value = "");
  // Records a rectangle in pixels of the window.
  void note(const std::string& name, float left, float top, float right, float bottom,
            const std::string& value = "");

  // {"name": {"rect": [left, top, right, bottom], "value": "...", "id": 1}, ...}. `id`: ImGui's id
  // of the control, different for each; missing: it takes no input.
  std::string json() const;

 private:
  struct Control {
    float rect[4] = {};
    std::string value;
    unsigned id = 0;  // 0: none
  };
  std::map<std::string, Control> controls_;
};

}  // namespace grisaille::app::viewer
