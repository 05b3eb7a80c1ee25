// SPDX-License-Identifier: MIT
// The panel's time line.
#include <fmt/format.h>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {

void Panel::drawAnimationChoice() {
  const scene::Pose& pose = session_.playback.pose;
  const auto label = [&](size_t index) { return labelOf(*session_.scene, index); };
  if (ImGui::BeginCombo(fit("Animation", "animation").c_str(),
                        pose.animation ? label(*pose.animation).c_str() : "At rest")) {
    if (ImGui::Selectable("At rest", !pose.animation)) {
      session_.playback.playing = false;
      session_.attempt("pose", [&] { session_.choose({}); });
    }
    layout.note("animation.rest");
    for (size_t i = 0; i < animationsOf(*session_.scene).size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(label(i).c_str(), pose.animation == i)) {
        session_.attempt("pose", [&] { session_.choose(i); });
      }
      layout.note(fmt::format("animation.{}", i));
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  layout.note("animation", pose.animation ? fmt::format("{}", *pose.animation) : "rest");
}

void Panel::drawTime() {
  drawAnimationChoice();
  Playback& playback = session_.playback;
  const double duration = session_.duration(), start = 0;
  double seconds = playback.pose.seconds;
  if (ImGui::SliderScalar(fit("Time", "time").c_str(), ImGuiDataType_Double, &seconds, &start,
                          &duration, "%.3f s")) {
    session_.attempt("pose", [&] { session_.seek(seconds); });
  }
  layout.note("time", fmt::format("{}", playback.pose.seconds));
  if (button(playback.playing ? "Pause##time" : "Play##time", "play", "(K)")) {
    session_.attempt("pose", [&] { session_.play(!playback.playing); });
  }
  layout.note("playing", playback.playing ? "true" : "false");
  ImGui::SameLine();
  if (button("<", "frame back", "One frame back (,)")) session_.stepFrames(-1);
  ImGui::SameLine();
  if (button(">", "frame on", "One frame on (.)")) session_.stepFrames(1);
  ImGui::SameLine();
  ImGui::Text("Frame %.0f of %.0f, %.0f a second", session_.frameNumber(), session_.lastFrame(),
              Playback::kFrames);
  const double least = 0.05, most = 4;
  ImGui::SliderScalar(fit("Speed", "play speed").c_str(), ImGuiDataType_Double, &playback.speed,
                      &least, &most, "%.3g x",
                      ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  layout.note("play speed", fmt::format("{}", playback.speed));
}

}  // namespace grisaille::app::viewer
