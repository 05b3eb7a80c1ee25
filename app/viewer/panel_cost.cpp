// SPDX-License-Identifier: MIT
// The panel's cost: the times of passes, their sum and the whole frame, as a table, as a graph and
// as a file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/panel.h"
#include "core/base/atomic_file.h"

namespace grisaille::app::viewer {
namespace {

// Okabe and Ito's palette, safe for all kinds of colour vision; without black.
const std::array<ImVec4, 7> kColours = {{{0.90f, 0.62f, 0.00f, 1},
                                         {0.34f, 0.71f, 0.91f, 1},
                                         {0.00f, 0.62f, 0.45f, 1},
                                         {0.94f, 0.89f, 0.26f, 1},
                                         {0.00f, 0.45f, 0.70f, 1},
                                         {0.84f, 0.37f, 0.00f, 1},
                                         {0.80f, 0.47f, 0.65f, 1}}};
constexpr size_t kFrameColour = 6;
constexpr size_t kRounds = 3;      // of the passes' colours, each nearer to the text's colour
constexpr float kGraphHeight = 7;  // lines of text
constexpr float kDot = 2;          // half the side of a single frame's square

// Passes, their sum, the frame. A sum of one pass is left out.
std::vector<PassStats> rowsOf(const Status& status) {
  std::vector<PassStats> rows = status.passes;
  if (rows.size() > 1) rows.push_back(status.sum);
  rows.push_back(status.whole);
  return rows;
}

ImVec4 colourOf(size_t row, size_t passes, size_t rows) {
  if (row + 1 == rows) return readable(kColours[kFrameColour]);
  if (row >= passes) return ImGui::GetStyleColorVec4(ImGuiCol_Text);
  const ImVec4 own = readable(kColours[row % kFrameColour]);
  const ImVec4 text = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  const float share = static_cast<float>(row / kFrameColour % kRounds) / kRounds;
  return {std::lerp(own.x, text.x, share), std::lerp(own.y, text.y, share),
          std::lerp(own.z, text.z, share), 1};
}

// A square of a line's colour, beside its name: as text, some of them would be faint.
void drawSwatch(ImVec4 colour) {
  const float side = 0.7f * ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + (ImGui::GetTextLineHeight() - side) / 2;
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x, top), ImVec2(at.x + side, top + side),
                                            ImGui::GetColorU32(colour));
  ImGui::Dummy(ImVec2(side, ImGui::GetTextLineHeight()));
}

// A power of ten times 1, 2 or 5, at least `most`.
float roundedUp(float most) {
  float step = 1e-3f;
  for (int i = 0; step < most && i < 30; ++i) step *= i % 3 == 1 ? 2.5f : 2;
  return step;
}

}  // namespace

void Panel::saveCost(const Status& status) {
  session_.attempt("cost", [&] {
    const std::string file = fmt::format("grisaille-{}-cost.csv", timeStamp());
    writeFileAtomically(file, costCsv(rowsOf(status)));
    session_.say(fmt::format("{}, {} frames", file, status.whole.recent.size()));
  });
}

// The last frames, the newest at the right end. `top`: milliseconds of the whole height.
void Panel::drawCostGraph(const std::vector<PassStats>& rows, size_t passes, float top) {
  const ImVec2 size(ImGui::GetContentRegionAvail().x, kGraphHeight * ImGui::GetTextLineHeight());
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(from, ImVec2(from.x + size.x, from.y + size.y),
                     ImGui::GetColorU32(ImGuiCol_FrameBg));
  std::vector<ImVec2> points;
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::vector<float>& recent = rows[i].recent;
    points.clear();
    const float step = size.x / static_cast<float>(PassTimes::kFramesKept - 1);
    for (size_t k = 0; k < recent.size(); ++k) {
      points.emplace_back(from.x + size.x - step * static_cast<float>(recent.size() - 1 - k),
                          from.y + size.y * (1 - recent[k] / top));
    }
    const ImU32 colour = ImGui::GetColorU32(colourOf(i, passes, rows.size()));
    list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, 1.5f);
    // A line of one frame has no length.
    if (points.size() == 1) {
      list.AddRectFilled(ImVec2(points[0].x - 2 * kDot, points[0].y - kDot),
                         ImVec2(points[0].x, points[0].y + kDot), colour);
    }
  }
  const std::string label = fmt::format("{:g} ms", top);
  list.AddText(from, ImGui::GetColorU32(ImGuiCol_Text), label.c_str());
  ImGui::Dummy(size);
  layout.note("cost graph", label);
}

void Panel::drawCost(const Status& status) {
  const std::vector<PassStats> rows = rowsOf(status);
  const char* clock = gpu::clockName(status.device.clock);
  const size_t frames = status.whole.recent.size();
  ImGui::TextDisabled("%s clock, last %zu frame%s", clock, frames, frames == 1 ? "" : "s");
  float most = 0;
  for (const PassStats& row : rows) {
    for (const float ms : row.recent) most = std::max(most, ms);
  }
  if (most > 0) drawCostGraph(rows, status.passes.size(), roundedUp(most));
  toggle("Render all the time", "continuous", session_.continuous,
         "Off: renders a frame only when something has changed");
  if (button("Save as CSV", "save cost", "The times of these frames, into the current folder")) {
    saveCost(status);
  }
  if (!ImGui::BeginTable("cost", 3, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("mean, ms", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableSetupColumn("p95, ms", ImGuiTableColumnFlags_WidthFixed);
  ImGui::TableHeadersRow();
  for (size_t i = 0; i < rows.size(); ++i) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    drawSwatch(colourOf(i, status.passes.size(), rows.size()));
    ImGui::SameLine();
    ImGui::TextUnformatted(rows[i].label.c_str());
    ImGui::TableNextColumn();
    ImGui::Text("%.2f", rows[i].mean);
    layout.note("cost." + rows[i].label, fmt::format("{:.3f}", rows[i].mean));
    ImGui::TableNextColumn();
    ImGui::Text("%.2f", rows[i].p95);
  }
  ImGui::EndTable();
}

}  // namespace grisaille::app::viewer
