// SPDX-License-Identifier: MIT
// Finds pictures that cannot be right, before effects run on them: a picture of another unit, space
// or encoding still gives a plausible result.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace grisaille::app {

// Prints warnings. A sequence has the same defect in every frame: each kind is printed once.
class Warnings {
 public:
  // Prints "warning: TEXT" to standard error.
  void once(const std::string& kind, const std::string& text);

 private:
  std::set<std::string> kinds_;
};

// The surface pixels of a frame: view depth, 0 in the sky, and its camera.
struct Surfaces {
  const image::Image& viewDepth;
  const scene::Camera& camera;
};

// A depth picture as apply has read it. All names are those of options.
struct DepthSource {
  const image::Image& stored;  // the file's channel, before its conversion to view depth
  bool integers = false;       // whether the file stores integers, which read as 0 to 1
  std::string kind;            // --depth-kind
  std::string file;            // for messages
};

// Throws kPictureDepth if the file stores integers but the kind counts in metres, or if the sky has
// the value that the kind gives to the near plane. Call it before the conversion.
void checkStoredDepth(const DepthSource& depth);

// Warns of depths that are hardly right: no surface, one depth everywhere, another kind or unit.
void checkViewDepth(const DepthSource& depth, const Surfaces& surfaces, Warnings& warnings);

// Warns if `camera`, from --camera, and the camera of the depth's file differ.
void checkCamera(const scene::Camera& camera, const image::Picture& depth, const std::string& file,
                 Warnings& warnings);

// Throws kPictureColour for a value that is not finite. Warns of values outside 0 to 1.
void checkBaseColour(const image::Image& colour, const std::string& file, Warnings& warnings);

}  // namespace grisaille::app
