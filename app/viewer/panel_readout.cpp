// SPDX-License-Identifier: MIT
// What stays in sight at the bottom of the panel, beside the picture: error, values under the
// cursor, legend of the colours, messages.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "app/truth/error_map.h"
#include "app/viewer/panel.h"

namespace grisaille::app::viewer {
namespace {

constexpr float kMostReadout = 0.4f;  // of the panel's height
constexpr float kMessageLines = 5;    // most lines in sight

// One line of text, or the legend of the difference colours.
struct Line {
  std::string id, text;                // id: for the layout
  bool dim = false;                    // nothing to tell
  std::string dark = "", bright = "";  // of a legend: its ends
};

void addTruth(const TruthStatus& status, std::vector<Line>& lines) {
  const truth::Comparison& c = status.comparison;
  if (c.pixels == 0) {
    lines.push_back({"truth numbers",
                     status.running ? "preparing the scene for tracing" : "nothing is traced",
                     true});
    return;
  }
  lines.push_back({"truth numbers", fmt::format("RMSE {:.4f} \u00b1 {:.1g}, mean error {:+.4f}",
                                                c.rmse, c.error, c.bias)});
  lines.push_back(
      {"truth state",
       fmt::format("truth \u00b1{:.3f} per pixel, {:.0f} rays, {:.3g} % of pixels{}", c.noise,
                   status.rays, 100 * status.share, status.running ? " \u2026" : "")});
  if (const auto& point = status.cursor) {
    lines.push_back(
        {"truth here",
         fmt::format("here {:.3f}, truth {:.3f} \u00b1 {:.3f}, error {:+.3f}", point->shown,
                     point->truth, point->truthError, point->shown - point->truth)});
  } else {
    lines.push_back({"truth here", "here: nothing under the cursor", true});
  }
}

std::string valuesText(const std::vector<float>& values, const char* format) {
  std::string text;
  for (const float value : values) text += " " + fmt::format(fmt::runtime(format), value);
  return text;
}

void addValues(const Status& status, bool split, std::vector<Line>& lines) {
  const auto& [a, b] = status.cursorValues;
  const std::string at = fmt::format("{}, {}:", status.cursorTexel.x, status.cursorTexel.y);
  if (!split) {
    lines.push_back(a.empty() ? Line{"value none", "value: nothing under the cursor", true}
                              : Line{"value", at + valuesText(a, "{:.6g}")});
    return;
  }
  if (a.empty() || b.empty()) {
    lines.push_back({"value none", "values: nothing under the cursor", true});
    lines.insert(lines.end(), 2, {"", "", true});  // the panel does not jump
    return;
  }
  lines.push_back({"value left", at + " A" + valuesText(a, "{:.6g}")});
  lines.push_back({"value right", at + " B" + valuesText(b, "{:.6g}")});
  std::vector<float> off;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) off.push_back(a[i] - b[i]);
  lines.push_back({"value apart", "A - B" + valuesText(off, "{:+.4g}")});
}

void drawLegend(const Line& line, Layout& layout) {
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = 0.6f * ImGui::GetTextLineHeight();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const auto colorAt = [](float error) {
    const glm::vec3 color = truth::errorColor(error);
    return ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, 1));
  };
  const ImU32 dark = colorAt(-truth::kFullError), bright = colorAt(truth::kFullError);
  const ImU32 right = colorAt(0);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = from.x + width / 2;
  list.AddRectFilledMultiColor(from, ImVec2(middle, from.y + height), dark, right, right, dark);
  list.AddRectFilledMultiColor(ImVec2(middle, from.y), ImVec2(from.x + width, from.y + height),
                               right, bright, bright, right);
  ImGui::Dummy(ImVec2(width, height));
  layout.note(line.id, line.dark + " | " + line.bright);
  ImGui::TextUnformatted(line.dark.c_str());
  ImGui::SameLine(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(line.bright.c_str()).x);
  ImGui::TextUnformatted(line.bright.c_str());
}

float heightOf(const Line& line, float width) {
  const ImGuiStyle& style = ImGui::GetStyle();
  if (!line.dark.empty()) return 1.6f * ImGui::GetTextLineHeight() + 2 * style.ItemSpacing.y;
  const float text = ImGui::CalcTextSize(line.text.c_str(), nullptr, false, width).y;
  return std::max(text, ImGui::GetTextLineHeight()) + style.ItemSpacing.y;
}

std::vector<Line> linesOf(const Session& session, const Status& status) {
  std::vector<Line> lines;
  if (!session.comparedOutput().empty()) {
    addTruth(status.truth, lines);
    const bool legend =
        session.left == kErrorView || (session.split && session.right == kErrorView);
    if (legend) {
      lines.push_back({"error legend", "", false,
                       fmt::format("-{:.2f} too dark", truth::kFullError),
                       fmt::format("too bright +{:.2f}", truth::kFullError)});
    }
  }
  if (session.split) {
    if (const auto& apart = status.apart) {
      lines.push_back(
          {"split numbers", fmt::format("A and B: RMSE {:.5g}, largest difference {:.4g}",
                                        apart->rmse, apart->largest)});
    } else {
      lines.push_back({"split numbers", "A and B have different units: no RMSE", true});
    }
    if (session.splitting.way == SplitWay::kDifference) {
      lines.push_back({"split legend", "", false,
                       fmt::format("-{:.3g} A is darker", session.splitting.full),
                       fmt::format("A is brighter +{:.3g}", session.splitting.full)});
    }
  }
  if (session.inspecting) addValues(status, session.split, lines);
  return lines;
}

}  // namespace

float Panel::heightBelow(const Status& status, glm::vec2 window) {
  const float width = ImGui::GetContentRegionAvail().x;
  readoutHeight_ = 0;
  for (const Line& line : linesOf(session_, status)) readoutHeight_ += heightOf(line, width);
  readoutHeight_ = std::min(readoutHeight_, kMostReadout * window.y);
  const float spacing = ImGui::GetStyle().ItemSpacing.y, separator = 2 * spacing + 1;
  const float most = kMessageLines * ImGui::GetTextLineHeightWithSpacing();
  float messages = 0;
  for (auto one = session_.messages.rbegin(); one != session_.messages.rend() && messages < most;
       ++one) {
    messages += ImGui::CalcTextSize(one->text.c_str(), nullptr, false, width).y + spacing;
  }
  messages = std::min(messages, most);
  return readoutHeight_ + messages + (readoutHeight_ > 0 ? separator : 0) +
         (messages > 0 ? separator : 0);
}

void Panel::drawReadout(const Status& status) {
  if (readoutHeight_ <= 0) return;
  ImGui::Separator();
  ImGui::BeginChild("readout", ImVec2(0, readoutHeight_));
  for (const Line& line : linesOf(session_, status)) {
    if (!line.dark.empty()) {
      drawLegend(line, layout);
      continue;
    }
    if (line.dim)
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", line.text.c_str());
    if (line.dim) ImGui::PopStyleColor();
    if (!line.id.empty()) layout.note(line.id, line.text);
  }
  ImGui::EndChild();
}

void Panel::drawMessages() {
  scrolls = false;
  if (session_.messages.empty()) return messageSeen_.clear();
  ImGui::Separator();
  ImGui::BeginChild("messages");
  for (const Message& message : session_.messages) {
    if (message.error) ImGui::PushStyleColor(ImGuiCol_Text, errorColour());
    ImGui::TextWrapped("%s", message.text.c_str());
    if (message.error) ImGui::PopStyleColor();
  }
  const std::string& last = session_.messages.back().text;
  const bool fresh =
      std::exchange(messagesSeen_, session_.messages.size()) != session_.messages.size() ||
      messageSeen_ != last;
  if (fresh) {
    messageSeen_ = last;
    ImGui::SetScrollHereY(1);
    scrolls = true;
  }
  layout.note("message", last);
  const auto error = std::ranges::find(session_.messages.rbegin(), session_.messages.rend(), true,
                                       &Message::error);
  if (error != session_.messages.rend()) layout.note("error", 0, 0, 0, 0, error->text);
  ImGui::EndChild();
}

}  // namespace grisaille::app::viewer
