// SPDX-License-Identifier: MIT
// Small pictures of the scenes opened last, one file each, and all of them as one texture for the
// panel.
#pragma once

#include <imgui/imgui.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/viewer/interface.h"
#include "core/image/image.h"

namespace grisaille::app::viewer {

class Thumbnails {
 public:
  static constexpr uint32_t kWidth = 192, kHeight = 108;  // pixels

  // The first save() creates the folder.
  explicit Thumbnails(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Writes the picture of a scene, any size, RGBA; cuts it to the thumbnail's shape. Throws
  // kFileUnwritable.
  void save(const std::string& scene, const image::Image8& picture);

  // Reads the thumbnails of these scenes, and removes the files of all others. A thumbnail that
  // cannot be read is missing.
  void read(const std::vector<std::string>& scenes);

  bool has(const std::string& scene) const { return slots_.contains(scene); }
  // Draws a thumbnail, or an empty frame, into the current window.
  void draw(const std::string& scene, ImVec2 corner, ImVec2 size) const;

  const InterfacePictures& pictures() const { return pictures_; }

 private:
  std::filesystem::path fileOf(const std::string& scene) const;

  std::filesystem::path folder_;
  std::map<std::string, size_t> slots_;  // by scene: its place in the texture, from the top
  InterfacePictures pictures_;
};

}  // namespace grisaille::app::viewer
