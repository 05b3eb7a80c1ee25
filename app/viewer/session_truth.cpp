// SPDX-License-Identifier: MIT
// The session's comparison with truth.
#include <algorithm>

#include "app/viewer/session.h"

namespace grisaille::app::viewer {

// Applies --compare-truth, --truth-radius and --truth-rays.
void Session::beginComparing() {
  const double radius = options_.truthRadius;
  const uint32_t rays = options_.truthRays;
  if (radius != 0) setTruthRadius(radius);
  if (rays != 0) comparing.rays = rays;
  if (!options_.compareTruth) {
    if (radius == 0 && rays == 0) return;
    throw Error(ErrorId::kUsage, "--truth-radius and --truth-rays need --compare-truth");
  }
  compareWithTruth(true);
  if (!comparing.on) throw Error(ErrorId::kUsage, "{}", messages.back().text);
}

std::vector<std::string> Session::comparable() const {
  std::vector<std::string> outputs;
  for (const effect::Selection::Entry& entry : chain.selection.entries()) {
    if (!entry.on) continue;
    for (const grisaille_output_desc& output : entry.effect().outputs()) {
      const gpu::Format format = effect::formatOf(output.format);
      if (output.role != GRISAILLE_ROLE_VISIBILITY) continue;
      if (gpu::formatInfo(format).channels != 1) continue;
      outputs.push_back(std::string(entry.key()) + "." + output.key);
    }
  }
  return outputs;
}

std::string Session::comparedOutput() const {
  if (!comparing.on) return "";
  const std::vector<std::string> outputs = comparable();
  if (outputs.empty()) return "";
  const bool there = std::ranges::find(outputs, comparing.output) != outputs.end();
  return there ? comparing.output : outputs.front();
}

double Session::truthRadius(const std::string& output) const {
  if (comparing.radius) return *comparing.radius;
  for (const effect::Selection::Entry& entry : chain.selection.entries()) {
    if (!output.starts_with(std::string(entry.key()) + ".")) continue;
    for (const grisaille_param_desc& param : entry.effect().params()) {
      if (std::string_view(param.key) != "radius") continue;
      const double radius = entry.values.get("radius");
      if (radius > 0 && radius <= TruthSettings::kFarthest) return radius;
    }
  }
  return suitableRadius_;  // for effects without a radius
}

void Session::setTruthRadius(double metres) {
  if (!(metres > 0 && metres <= TruthSettings::kFarthest)) {
    throw Error(ErrorId::kUsage, "the truth's radius is {} m; allowed: over 0 and up to {} m",
                metres, TruthSettings::kFarthest);
  }
  comparing.radius = metres;
}

void Session::compareWithTruth(bool on) {
  if (on && comparable().empty()) {
    comparing.on = false;
    say("no effect that is on has a visibility output to compare with the truth");
    return;
  }
  comparing.on = on;
  if (on) {
    if (!isTruthView(left)) leftBefore_ = left;
    left = kErrorView;
    if (!split) {  // else the user has chosen what the right side shows
      if (!isTruthView(right)) rightBefore_ = right;
      right = kTruthView;
    }
  } else {
    if (isTruthView(left)) left = leftBefore_;
    if (isTruthView(right)) right = rightBefore_;
  }
  checkViews();
}

}  // namespace grisaille::app::viewer
