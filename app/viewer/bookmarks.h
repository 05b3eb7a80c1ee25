// SPDX-License-Identifier: MIT
// Named cameras: a folder of camera files, one NAME.json each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/camera.h"

namespace grisaille::app::viewer {

class Bookmarks {
 public:
  struct Entry {
    std::string name;
    std::optional<scene::Camera> camera;  // none: the file is broken
    std::string error;                    // why it is, as one line
  };

  // The folder is made with the first save().
  explicit Bookmarks(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // As the folder is now, by name; none where there is no folder.
  std::vector<Entry> list() const;

  // In the place of one of that name. Throws kBookmarkName, kFileUnwritable.
  void save(const std::string& name, const scene::Camera& camera) const;

  // Nothing happens where there is none. Throws kBookmarkName, kFileUnwritable.
  void remove(const std::string& name) const;

  // Throws kBookmarkName unless `name` can be a file's: 1 to 200 bytes, no slashes or control
  // characters, no dot at its beginning.
  static void checkName(std::string_view name);

 private:
  std::filesystem::path fileOf(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace grisaille::app::viewer
