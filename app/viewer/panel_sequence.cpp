// SPDX-License-Identifier: MIT
// The panel's sequence: a path of cameras, and the pictures along it.
#include <fmt/format.h>
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>

#include "app/viewer/panel.h"

namespace grisaille::app::viewer {

// The cameras of the path, in order.
void Panel::drawPath() {
  std::vector<scene::Camera>& keys = session_.sequence.keys;
  std::optional<size_t> removed, earlier;
  for (size_t i = 0; i < keys.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton("x")) removed = i;
    layout.note(fmt::format("path.remove.{}", i));
    tip("Takes this camera out of the path");
    ImGui::SameLine();
    if (ImGui::ArrowButton("earlier", ImGuiDir_Up) && i > 0) earlier = i;
    layout.note(fmt::format("path.earlier.{}", i));
    tip("Earlier on the path");
    ImGui::SameLine();
    const glm::dvec3& eye = keys[i].eye;
    const std::string name =
        fmt::format("{}  ({:.2f}, {:.2f}, {:.2f})", i + 1, eye.x, eye.y, eye.z);
    if (ImGui::Selectable(name.c_str())) session_.goTo(keys[i]);
    layout.note(fmt::format("path.{}", i));
    ImGui::PopID();
  }
  if (removed) keys.erase(keys.begin() + static_cast<ptrdiff_t>(*removed));
  if (earlier) std::swap(keys[*earlier], keys[*earlier - 1]);
  ImGui::BeginDisabled(keys.size() >= Sequence::kMostKeys);
  if (button("Add this camera", "path add", "The next camera of the path is the present one")) {
    keys.push_back(session_.camera);
  }
  ImGui::SameLine();
  if (ImGui::BeginCombo("###path bookmark", "Add a bookmark")) {
    for (const Bookmarks::Entry& entry : bookmarkList_) {
      if (!entry.camera) continue;
      if (ImGui::Selectable(entry.name.c_str())) keys.push_back(*entry.camera);
      layout.note("path bookmark." + entry.name);
    }
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  layout.note("path bookmark", fmt::format("{}", keys.size()));
}

void Panel::drawSequence(const Status& status, Requests& requests) {
  Sequence& sequence = session_.sequence;
  drawPath();
  if (session_.hasAnimations()) {
    toggle("With the animation", "sequence animated", sequence.animated,
           "The animation plays once, from its start to its end, while the camera takes the path");
  }
  const bool animated = sequence.animated && session_.hasAnimations();
  ImGui::BeginDisabled(animated);
  double seconds = session_.sequenceSeconds();
  if (ImGui::InputDouble(fit("Seconds", "sequence seconds").c_str(), &seconds, 0, 0, "%.6g")) {
    sequence.seconds = std::clamp(seconds, Sequence::kShortest, Sequence::kLongest);
  }
  layout.note("sequence seconds", fmt::format("{}", seconds));
  ImGui::EndDisabled();
  ImGui::TextDisabled("%u frames, %.0f a second", session_.sequenceFrames(), Playback::kFrames);
  layout.note("sequence frames", fmt::format("{}", session_.sequenceFrames()));
  if (button(session_.isPreviewing() ? "Stop" : "Preview", "sequence preview",
             "Moves the camera along the path")) {
    session_.previewSequence(!session_.isPreviewing());
  }
  ImGui::InputText(fit("Files", "sequence file").c_str(), &sequence.file);
  layout.note("sequence file", sequence.file);
  tip("#### stands for the number of the frame. As large as saved pictures: see View");
  toggle("Make a video", "sequence filmed", sequence.filmed,
         "Runs the program ffmpeg, if it is installed, on the .png files");
  if (sequence.filmed) {
    ImGui::InputText(fit("Video", "sequence video").c_str(), &sequence.video);
    layout.note("sequence video", sequence.video);
    tip("The ending chooses the format: .mp4, .webm, .gif and what else ffmpeg knows");
  }
  const SequenceStatus& now = status.sequence;
  if (now.running) {
    ImGui::ProgressBar(static_cast<float>(now.done));
    layout.note("sequence progress", now.text);
    if (button("Cancel##sequence", "sequence cancel")) requests.cancelSequence = true;
    ImGui::TextDisabled("%s", now.text.c_str());
  } else if (button("Render", "sequence render",
                    "Runs `grisaille render` in the background, and shows its command below")) {
    requests.sequence = true;
  }
}

}  // namespace grisaille::app::viewer
