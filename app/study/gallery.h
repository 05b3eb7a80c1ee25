// SPDX-License-Identifier: MIT
// Reads a gallery: the scenes that a study measures together, each at its own radius.
//
//   [[scene]]
//   name = "room"                    letters, digits, - and _; for reports
//   file = "room.glb"                relative to the gallery file, or to --scenes; or the name of a
//                                    built-in scene; default: the atrium
//   optional = true                  leaves the scene out if there is no such file
//   radius = 0.3                     metres: length of the truth's rays
//   set = ["ssao.radius=0.3"]        values in all settings, same form as --set
//   cameras = ["cameras/room_table.json"]    camera files, relative to the gallery file
#pragma once

#include <string>
#include <vector>

namespace grisaille::app::study {

struct GalleryScene {
  std::string name;
  std::string scene;                 // as of scene::loadScene()
  double radius = 0.5;               // length of the truth's rays, metres
  std::vector<std::string> sets;     // "EFFECT.KEY=VALUE"
  std::vector<std::string> cameras;  // paths of camera files
};

// The built-in scene of the name `scene`, or else the file `scene` beside the file `beside` or, if
// there is none, in the folder `scenes` ("": no such folder).
std::string sceneFile(const std::string& beside, const std::string& scene,
                      const std::string& scenes);

// Reads a gallery and leaves out optional scenes that are missing, of which it prints the names to
// standard error. Throws kSettingsUnreadable, and kSettingsInvalid for a damaged file, two scenes
// or two cameras of one name, a scene without cameras, or a file that is missing and not optional.
std::vector<GalleryScene> loadGallery(const std::string& path, const std::string& scenes);

}  // namespace grisaille::app::study
