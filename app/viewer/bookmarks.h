// SPDX-License-Identifier: MIT
// Bookmarks: named cameras, kept in a folder as one camera file NAME.json per bookmark.
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
    std::optional<scene::Camera> camera;  // none: the file is invalid
    std::string error;                    // why the file is invalid, one line; else ""
  };

  // The first save() creates the folder.
  explicit Bookmarks(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Reads the folder and returns its bookmarks, sorted by name. A missing folder has none.
  std::vector<Entry> list() const;

  // Replaces a bookmark of the same name. Throws kBookmarkName, kFileUnwritable.
  void save(const std::string& name, const scene::Camera& camera) const;

  // Does nothing without a bookmark of this name. Throws kBookmarkName, kFileUnwritable.
  void remove(const std::string& name) const;

  // Throws kBookmarkName unless `name` can name a file: 1 to 200 bytes, no slash, backslash or
  // control character, no leading dot.
  static void checkName(std::string_view name);

 private:
  std::filesystem::path fileOf(const std::string& name) const;

  std::filesystem::path folder_;
};

}  // namespace grisaille::app::viewer
