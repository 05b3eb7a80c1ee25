// SPDX-License-Identifier: MIT
// What the panel's file dialog lists and completes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace grisaille::app::viewer {

// Files that the viewer opens. kAll: those of every other kind.
enum class FileKind : uint8_t { kAll, kScene, kSettings, kJson };
inline constexpr size_t kFileKinds = 4;

const char* kindLabel(FileKind kind);  // with its endings, for a list of choices
// Whether the name's ending belongs to the kind. Case does not matter.
bool isOfKind(std::string_view name, FileKind kind);

struct ListedFile {
  std::string name;
  bool folder = false;
};

struct FolderList {
  static constexpr size_t kMost = 5000;

  std::vector<ListedFile> files;  // folders first, each sorted by name; at most kMost
  bool cut = false;               // there are more
  std::string error;              // why the folder cannot be read; else ""
};

// The folders, and the files of this kind, of a folder. Leaves out names that begin with a dot.
FolderList listFolder(const std::string& folder, FileKind kind);

// `text`, a path from `folder` or an absolute one, extended as far as all names that begin with it
// agree; a folder that is the only one gets its slash.
std::string completed(const std::string& text, const std::string& folder, FileKind kind);

// `text` from `folder`, as an absolute path without dots. "~" stands for the home folder.
std::string wholePath(const std::string& text, const std::string& folder);

}  // namespace grisaille::app::viewer
