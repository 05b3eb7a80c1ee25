// SPDX-License-Identifier: MIT
#include "app/viewer/bookmarks.h"

#include <algorithm>

#include "core/base/error.h"

namespace grisaille::app::viewer {

namespace fs = std::filesystem;

namespace {
constexpr size_t kLongestName = 200;  // bytes; file systems allow 255, with all suffixes
}  // namespace

void Bookmarks::checkName(std::string_view name) {
  const auto wrong = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f || c == '/' || c == '\\';
  };
  if (name.empty() || name.size() > kLongestName || name.front() == '.' ||
      std::ranges::any_of(name, wrong)) {
    throw Error(ErrorId::kBookmarkName, "'{}' cannot name a bookmark", oneLine(name));
  }
}

fs::path Bookmarks::fileOf(const std::string& name) const {
  checkName(name);
  return folder_ / (name + ".json");
}

std::vector<Bookmarks::Entry> Bookmarks::list() const {
  std::vector<Entry> entries;
  std::error_code failed;
  for (fs::directory_iterator file(folder_, failed); !failed && file != fs::directory_iterator();
       file.increment(failed)) {
    if (file->path().extension() != ".json") continue;
    Entry& entry = entries.emplace_back();
    entry.name = file->path().stem().string();
    try {
      entry.camera = scene::loadCamera(file->path().string());
    } catch (const Error& error) {
      entry.error = error.what();
    }
  }
  std::ranges::sort(entries, {}, &Entry::name);
  return entries;
}

void Bookmarks::save(const std::string& name, const scene::Camera& camera) const {
  const fs::path file = fileOf(name);
  std::error_code failed;
  fs::create_directories(folder_, failed);  // on failure, saveCamera() throws
  scene::saveCamera(camera, file.string());
}

void Bookmarks::remove(const std::string& name) const {
  const fs::path file = fileOf(name);
  std::error_code failed;
  fs::remove(file, failed);
  if (failed) throw Error(ErrorId::kFileUnwritable, "{}: {}", file.string(), failed.message());
}

}  // namespace grisaille::app::viewer
