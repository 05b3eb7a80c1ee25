// SPDX-License-Identifier: MIT
#include "app/viewer/file_list.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <system_error>

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::array kSceneEndings = {".glb", ".gltf"};
constexpr std::array kSettingsEndings = {".toml"};
constexpr std::array kJsonEndings = {".json"};

bool endsIn(const std::string& ending, std::span<const char* const> endings) {
  return std::ranges::find(endings, std::string_view(ending)) != endings.end();
}

}  // namespace

const char* kindLabel(FileKind kind) {
  switch (kind) {
    case FileKind::kScene:
      return "Scenes (.glb, .gltf)";
    case FileKind::kSettings:
      return "Settings (.toml)";
    case FileKind::kJson:
      return "Sessions, cameras, objects (.json)";
    default:
      return "All that the viewer opens";
  }
}

bool isOfKind(std::string_view name, FileKind kind) {
  std::string ending = fs::path(name).extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  });
  const bool all = kind == FileKind::kAll;
  return ((all || kind == FileKind::kScene) && endsIn(ending, kSceneEndings)) ||
         ((all || kind == FileKind::kSettings) && endsIn(ending, kSettingsEndings)) ||
         ((all || kind == FileKind::kJson) && endsIn(ending, kJsonEndings));
}

FolderList listFolder(const std::string& folder, FileKind kind) {
  FolderList list;
  std::error_code failed;
  for (fs::directory_iterator file(folder, failed); !failed && file != fs::directory_iterator();
       file.increment(failed)) {
    const std::string name = file->path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code unknown;  // a link to nowhere is no folder
    const bool isFolder = file->is_directory(unknown);
    if (!isFolder && !isOfKind(name, kind)) continue;
    if (list.files.size() == FolderList::kMost) {
      list.cut = true;
      break;
    }
    list.files.push_back({name, isFolder});
  }
  if (failed) list.error = failed.message();
  std::ranges::sort(list.files, [](const ListedFile& a, const ListedFile& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
  return list;
}

std::string wholePath(const std::string& text, const std::string& folder) {
  std::string given = text;
  const char* home = std::getenv("HOME");
  if (home != nullptr && (given == "~" || given.starts_with("~/"))) given = home + given.substr(1);
  return (fs::path(folder) / given).lexically_normal().string();
}

std::string completed(const std::string& text, const std::string& folder, FileKind kind) {
  const size_t slash = text.rfind('/');
  const std::string above = slash == std::string::npos ? "" : text.substr(0, slash + 1);
  const std::string begun = text.substr(above.size());
  std::string common;
  size_t count = 0;
  bool isFolder = false;
  for (const ListedFile& file : listFolder(wholePath(above, folder), kind).files) {
    if (!file.name.starts_with(begun)) continue;
    if (count++ == 0) {
      common = file.name;
      isFolder = file.folder;
      continue;
    }
    const auto [end, other] = std::ranges::mismatch(common, file.name);
    common.erase(end, common.end());
  }
  if (count == 0) return text;
  while (!common.empty() && count > 1 &&
         (static_cast<unsigned char>(common.back()) & 0xc0u) == 0x80u) {
    common.pop_back();  // names that differ in the middle of a letter
  }
  if (common.size() < begun.size()) return text;
  return above + common + (count == 1 && isFolder ? "/" : "");
}

}  // namespace grisaille::app::viewer
