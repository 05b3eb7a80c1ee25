// SPDX-License-Identifier: MIT
#include "app/study/gallery.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/settings/toml_table.h"
#include "app/settings/toml_values.h"
#include "core/base/error.h"
#include "core/scene/built_in.h"

namespace grisaille::app::study {
namespace {

namespace fs = std::filesystem;

// The path, or none if the file is missing and the scene optional.
std::optional<std::string> fileOf(TomlTable& table, const std::string& scenes) {
  const std::string file = table.text("file", "");
  const bool optional = table.flag("optional", false);
  const std::string path = sceneFile(table.file(), file, scenes);
  std::error_code failed;
  if (scene::findBuiltIn(path) != nullptr || fs::exists(path, failed)) return path;
  if (optional) return std::nullopt;
  table.refuse(table.require("file"), fmt::format("there is no file '{}'", path));
}

GalleryScene sceneOf(TomlTable& table) {
  GalleryScene scene;
  scene.name = table.text("name");
  scene.radius = table.number("radius", scene.radius, 1e-6, 1e6);
  scene.sets = table.texts("set");
  for (const std::string& camera : table.texts("cameras")) {
    scene.cameras.push_back(fs::path(table.file()).parent_path() / camera);
  }
  if (scene.cameras.empty()) table.refuse(table.require("cameras"), "'cameras' is empty");
  return scene;
}

// Throws if two scenes or two cameras share a name, which is a file's name without its extension.
void requireDistinctNames(const std::string& path, const std::vector<GalleryScene>& gallery) {
  std::vector<std::string> scenes, cameras;
  for (const GalleryScene& scene : gallery) {
    scenes.push_back(scene.name);
    for (const std::string& camera : scene.cameras) cameras.push_back(fs::path(camera).stem());
  }
  for (std::vector<std::string>* names : {&scenes, &cameras}) {
    std::ranges::sort(*names);
    const auto twice = std::ranges::adjacent_find(*names);
    if (twice == names->end()) continue;
    throw Error(ErrorId::kSettingsInvalid, "{}: two {} have the name '{}'", path,
                names == &scenes ? "scenes" : "cameras", *twice);
  }
}

}  // namespace

std::string sceneFile(const std::string& beside, const std::string& scene,
                      const std::string& scenes) {
  if (scene::findBuiltIn(scene) != nullptr) return scene;
  const fs::path own = fs::path(beside).parent_path() / scene;
  std::error_code failed;
  if (scenes.empty() || fs::exists(own, failed)) return own.string();
  return (fs::path(scenes) / scene).string();
}

std::vector<GalleryScene> loadGallery(const std::string& path, const std::string& scenes) {
  const toml::table document = parseTomlFile(path);
  TomlTable table(path, document);
  std::vector<GalleryScene> gallery;
  for (const toml::table* one : table.tables("scene")) {
    TomlTable entry(path, *one);
    GalleryScene scene = sceneOf(entry);
    const std::optional<std::string> file = fileOf(entry, scenes);
    entry.finish();
    if (file) {
      scene.scene = *file;
      gallery.push_back(std::move(scene));
    } else {
      fmt::print(stderr, "note: {} is left out, as its file is not there\n", scene.name);
    }
  }
  table.finish();
  if (gallery.empty()) throw Error(ErrorId::kSettingsInvalid, "{} has no scene", path);
  requireDistinctNames(path, gallery);
  return gallery;
}

}  // namespace grisaille::app::study
