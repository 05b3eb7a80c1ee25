// SPDX-License-Identifier: MIT
#include "app/viewer/side_labels.h"

#include <fmt/format.h>

#include <algorithm>

namespace grisaille::app::viewer {
namespace {

// Draws a label at the bottom of the part of the picture between `left` and `right`, at its left or
// right end; cuts it off there.
void drawLabel(const std::string& name, const std::string& text, float left, float right,
               float bottom, bool atRight, Layout& layout) {
  const float pad = 0.35f * ImGui::GetFontSize();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float width = size.x + 2 * pad, height = size.y + 2 * pad;
  const float x = atRight ? std::max(right - width - pad, left + pad) : left + pad;
  const float y = bottom - height - pad;
  const float end = std::min(x + width, right - pad);
  if (end - x < 2 * pad) return;  // no room for a letter
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect(ImVec2(x, y), ImVec2(end, y + height), true);
  list.AddRectFilled(ImVec2(x, y), ImVec2(end, y + height), IM_COL32(16, 16, 18, 210), pad);
  list.AddText(ImVec2(x + pad, y + pad), IM_COL32(240, 240, 240, 255), text.c_str());
  list.PopClipRect();
  layout.note(name, x, y, end, y + height, text);
}

}  // namespace

void drawSideLabels(const Session& session, const Status& status, glm::vec2 corner, glm::vec2 size,
                    Layout& layout) {
  const float right = corner.x + size.x, bottom = corner.y + size.y;
  const std::string a = "A: " + status.sides[0], b = "B: " + status.sides[1];
  switch (session.splitting.way) {
    case SplitWay::kLine: {
      const float line = corner.x + session.line * size.x;
      drawLabel("label left", a, corner.x, line, bottom, false, layout);
      drawLabel("label right", b, line, right, bottom, true, layout);
      break;
    }
    case SplitWay::kDifference: {
      const float row = 2 * ImGui::GetTextLineHeight();
      drawLabel("label left", a, corner.x, right, bottom - row, false, layout);
      drawLabel("label right", b, corner.x, right, bottom, false, layout);
      break;
    }
    case SplitWay::kFlicker:
      drawLabel(status.turned ? "label right" : "label left", status.turned ? b : a, corner.x,
                right, bottom, status.turned, layout);
      break;
  }
}

}  // namespace grisaille::app::viewer
