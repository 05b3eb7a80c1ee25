// SPDX-License-Identifier: MIT
// Loads claims files (TOML): statements about effects, each with the settings to run and the
// comparisons of numbers that decide it. docs/manual/lab.md and studies/claims.toml have examples.
//
//   title = "..."                      optional
//   [[claim]]
//   key = "bands"                      letters, digits, - and _; names the pictures' files
//   text = "..."                       the statement
//   source = "..."                     its author
//   note = "..."                       optional: a remark on the measurement
//   scene = "FILE.gltf"                relative to the claims file, or to --scenes; or the name of
//   a
//                                      built-in scene; default: the atrium
//   optional = true                    leaves the claim out if there is no such file
//   floor = true                       puts a floor under the scene
//   camera = {eye = [..], ...}         same keys as a camera file; for a path, an array of cameras
//   frames = 12                        number of frames; only with a path or an animation
//   seconds = [0, 1]                   optional: times of the first and the last frame in the
//                                      scene's animation; the others lie evenly between
//   animation = 0                      which animation; only with `seconds`
//   size = [480, 270]                  pixels
//   radius = 0.5                       metres: length of the truth's rays, and scale of regions
//   distance = 10                      metres of view depth: end of the region "near"
//   effects = ["ssao"]                 effects to run, in order
//   output = "ssao.ao"                 output to measure; of four channels, the last one
//   set = ["ssao.bias=0"]              values for all runs, same form as --set
//   shots = [{origin = [..], ...}]     shots of paint, same keys as a file of sspm's objects; or
//                                      the name of such a file
//   runs = [
//     {name = "few", set = [..]},      also: presets = ["ssao=fast"], under the run's values and
//   ]                                  over the claim's; camera; against = "NAME", a run that
//                                      replaces the truth; shots = 8, the number of shots, which
//                                      repeat those of the claim, each turn from a millimetre
//                                      farther back; noise = "screen", splats fixed to the screen
//   expect = ["few.noise > 2 * many.noise"]    see expectation.h
//   picture = {show = "output", crop = [x, y, width, height], zoom = 2, low = 0, high = 1}
//
// The truth is the ray-traced ambient visibility. For a claim with shots it is the ray-traced mask
// of their paint: 1 inside, 0 outside.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/effect/selection.h"
#include "core/scene/camera.h"
#include "lab/claims/expectation.h"
#include "lab/paint/shot.h"

namespace grisaille::lab::claims {

// What a claim's pictures show:
// - kOutput: the measured output;
// - kColor: the composed picture;
// - kChange: the unwanted change from the first frame to the second at the same point of the world,
//   which is the change of the error for visibility, and any change for paint.
enum class PictureKind : uint8_t { kOutput, kColor, kChange };

struct PictureDesc {
  PictureKind show = PictureKind::kOutput;
  glm::uvec4 crop = glm::uvec4(0);  // x, y, width, height, pixels
  uint32_t zoom = 1;                // magnification, 1 ... 16
  double low = 0, high = 1;         // drawn black and white; of a change, `high` has full colour
};

struct ClaimRun {
  std::string name;
  std::vector<std::string> presets;    // "EFFECT=NAME", over the claim's values
  std::vector<std::string> sets;       // over both
  std::vector<scene::Camera> cameras;  // one per frame
  std::vector<double> seconds;         // one per frame; empty: the scene is at rest
  bool still = false;                  // all frames are the last one
  std::string against;                 // run to compare with; "": the truth
  uint32_t shots = 0;                  // number of shots
  bool screenNoise = false;            // splats fixed to the screen
};

struct Claim {
  std::string key, text, source, note;
  std::string place;      // file:line, for messages
  std::string scene;      // a path, or as of loadScene()
  bool optional = false;  // left out if there is no such file
  bool floor = false;     // addFloor()
  glm::uvec2 size = glm::uvec2(480, 270);
  double radius = 0.5, distance = 10;
  size_t animation = 0;         // of the scene
  std::vector<double> seconds;  // one per frame; empty: the scene is at rest
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

// Loads and checks a claims file, as far as possible without rendering. `scenes`: a folder for
// scenes that do not stand beside the claims file; "": none. Throws kSettingsUnreadable,
// kSettingsInvalid, and the errors of a camera, a shot, an effect or a parameter. Each message
// starts with file:line.
ClaimsFile loadClaims(const std::string& path, const effect::Registry& registry,
                      const std::string& scenes = "");

// The claim's effects with the claim's values and, unless `run` is null, the run's presets and
// values. Throws kUsage, and what Selection and applyPresets() throw.
effect::Selection selectionOf(const effect::Registry& registry, const Claim& claim,
                              const ClaimRun* run);

// The same claim with all picture sizes multiplied by `scale`.
Claim scaled(const Claim& claim, double scale);

}  // namespace grisaille::lab::claims
