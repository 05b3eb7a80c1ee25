// SPDX-License-Identifier: MIT
// Study files: what is said of effects, each with the settings that show it and the numbers that
// decide it. TOML; README.md has an example, studies/claims.toml is one.
//
//   title = "..."                      optional
//   [[claim]]
//   key = "bands"                      letters, digits, - and _; names the pictures' files
//   text = "..."                       what is said
//   source = "..."                     by whom
//   note = "..."                       optional: what a reader should know of the measurement
//   scene = "FILE.gltf"                beside the study file; without it, the built-in atrium
//   camera = {eye = [..], ...}         as camera files have it; of a path, an array of them
//   frames = 12                        of the path; without it, there is none
//   size = [480, 270]                  pixels
//   radius = 0.5                       metres: of the truth's rays, and of regions
//   distance = 10                      metres of view depth: where "near" ends
//   effects = ["ssao"]                 that run, in order
//   output = "ssao.ao"                 what is measured; of four channels, the last one
//   set = ["ssao.bias=0"]              under all runs, as --set has them
//   shots = [{origin = [..], ...}]     of paint, as files of sspm's objects have them, or the name
//                                      of such a file
//   runs = [
//     {name = "few", set = [..]},      further: camera; against = "NAME", the run that is right
//   ]                                  instead of the truth; shots = 8, so many, those of the claim
//                                      in turn; noise = "screen", splats tied to the screen
//   expect = ["few.noise > 2 * many.noise"]    see expectation.h
//   picture = {show = "output", crop = [x, y, width, height], zoom = 2, low = 0, high = 1}
//
// The truth is the ray-traced ambient visibility or, where a claim has shots, 1 where rays say that
// one of them paints and 0 elsewhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/effect/selection.h"
#include "core/scene/camera.h"
#include "lab/claims/expectation.h"
#include "lab/paint/shot.h"

namespace grisaille::lab::claims {

// What a claim's pictures show: what is measured; the composed picture; or what changes from the
// first frame to the second one at the same point of the world and should not: for visibility, its
// error; for paint, itself.
enum class PictureKind : uint8_t { kOutput, kColor, kChange };

struct PictureDesc {
  PictureKind show = PictureKind::kOutput;
  glm::uvec4 crop = glm::uvec4(0);  // x, y, width, height, pixels
  uint32_t zoom = 1;                // pixels a side that one is drawn as, 1 ... 16
  double low = 0, high = 1;         // that are drawn black and white; of a change, high is full
};

struct ClaimRun {
  std::string name;
  std::vector<std::string> sets;       // over those of the claim
  std::vector<scene::Camera> cameras;  // one a frame
  std::string against;                 // "": the truth
  uint32_t shots = 0;                  // how many
  bool screenNoise = false;
};

struct Claim {
  std::string key, text, source, note;
  std::string place;  // file:line, for messages
  std::string scene;  // a path; "": the built-in atrium
  glm::uvec2 size = glm::uvec2(480, 270);
  double radius = 0.5, distance = 10;
  std::vector<std::string> effects;
  std::string output;
  std::vector<std::string> sets;
  std::vector<Shot> shots;
  std::vector<ClaimRun> runs;
  std::vector<Expectation> expectations;
  PictureDesc picture;
};

struct ClaimsFile {
  std::string title;
  std::vector<Claim> claims;
};

// All that can be told without rendering is checked. Throws kSettingsUnreadable and
// kSettingsInvalid, or what a camera, a shot, an effect or its parameter is refused with, each with
// file:line before the message.
ClaimsFile loadClaims(const std::string& path, const effect::Registry& registry);

// The claim's effects with its values and, where `run` is not null, that run's over them. Throws
// kUsage and as Selection does.
effect::Selection selectionOf(const effect::Registry& registry, const Claim& claim,
                              const ClaimRun* run);

// The same claim in pictures of `scale` times the size.
Claim scaled(const Claim& claim, double scale);

}  // namespace grisaille::lab::claims
