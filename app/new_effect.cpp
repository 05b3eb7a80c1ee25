// SPDX-License-Identifier: MIT
// grisaille new-effect: writes a complete project for a new effect.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/command.h"
#include "app/new_effect_files.h"
#include "app/settings/load_effects.h"
#include "app/settings/settings.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/library_folder.h"
#include "core/base/quote.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

struct NewEffectOptions {
  std::string key, folder, language = "c++";
};

constexpr size_t kLongestKey = 40;

void checkKey(const std::string& key) {
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto fits = [&](char c) { return small(c) || (c >= '0' && c <= '9') || c == '_'; };
  if (key.empty() || key.size() > kLongestKey || !small(key[0]) ||
      !std::ranges::all_of(key, fits)) {
    throw Error(ErrorId::kProjectName, "'{}' is not a valid effect key", oneLine(key));
  }
  if (std::ranges::find(kReservedKeys, key) != std::end(kReservedKeys)) {
    throw Error(ErrorId::kProjectName, "'{}' is a reserved key of settings files", key);
  }
  const auto registry = loadEffects({});
  for (const effect::Effect& effect : registry->effects()) {
    if (key == effect.desc->key) {
      throw Error(ErrorId::kProjectName, "an effect '{}' already exists: {}", key, effect.path);
    }
  }
}

void checkFolder(const fs::path& folder) {
  std::error_code failed;
  const fs::file_status status = fs::status(folder, failed);
  if (status.type() == fs::file_type::not_found) return;
  if (status.type() != fs::file_type::directory) {
    throw Error(ErrorId::kProjectFolder, "{} exists and is not a folder", folder.string());
  }
  const bool empty = fs::is_empty(folder, failed);
  if (failed) throw Error(ErrorId::kProjectFolder, "{}: {}", folder.string(), failed.message());
  if (!empty) throw Error(ErrorId::kProjectFolder, "{} is not empty", folder.string());
}

// For the key "edge_lines": labelOf() gives "Edge lines", classOf() gives "EdgeLinesEffect".
std::string labelOf(std::string key) {
  std::ranges::replace(key, '_', ' ');
  key[0] = static_cast<char>(key[0] - 'a' + 'A');
  return key;
}
std::string classOf(const std::string& key) {
  std::string name;
  bool begins = true;
  for (const char c : key) {
    const bool small = c >= 'a' && c <= 'z';
    if (c != '_') name += begins && small ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return name + "Effect";
}

std::string filled(std::string text, const NewEffectOptions& options) {
  const std::pair<const char*, std::string> words[] = {
      {"@KEY@", options.key},
      {"@LABEL@", labelOf(options.key)},
      {"@CLASS@", classOf(options.key)},
      {"@ENDING@", options.language == "c" ? "c" : "cpp"}};
  for (const auto& [mark, word] : words) {
    const std::string_view what = mark;
    for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += word.size()) {
      text.replace(at, what.size(), word);
    }
  }
  return text;
}

// Whether CMake finds this program's package without CMAKE_PREFIX_PATH: under /usr, /usr/local, or
// a prefix with its bin folder in PATH.
bool isFoundByCMake(const fs::path& prefix) {
  if (prefix == "/usr" || prefix == "/usr/local") return true;
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable != nullptr ? variable : "";
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(':'), rest.size());
    std::error_code failed;
    if (fs::weakly_canonical(rest.substr(0, end), failed) == prefix / "bin") return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

void newEffect(const NewEffectOptions& options) {
  checkKey(options.key);
  const fs::path folder = options.folder.empty() ? options.key : options.folder;
  checkFolder(folder);
  std::error_code failed;
  const bool isNew = fs::create_directories(folder, failed);
  if (failed) {
    throw Error(ErrorId::kFileUnwritable, "{}: {}", folder.string(), failed.message());
  }
  const bool c = options.language == "c";
  const std::pair<std::string, const char*> files[] = {
      {"CMakeLists.txt", kProjectCMakeLists},
      {"CMakePresets.json", kProjectCMakePresets},
      {options.key + (c ? ".c" : ".cpp"), c ? kProjectC : kProjectCpp},
      {options.key + ".comp", kProjectShader},
      {"README.md", kProjectReadme}};
  try {
    for (const auto& [name, text] : files) {
      writeFileAtomically(folder / name, filled(text, options));
    }
  } catch (const Error&) {
    // checkFolder() would refuse an incomplete project at the next try.
    for (const auto& [name, text] : files) fs::remove(folder / name, failed);
    if (isNew) fs::remove(folder, failed);
    throw;
  }
  for (const auto& [name, text] : files) fmt::print("wrote {}\n", (folder / name).string());
  const fs::path prefix = libraryFolder().parent_path().parent_path();
  const std::string where =
      isFoundByCMake(prefix) ? "" : "CMAKE_PREFIX_PATH=" + shellQuoted(prefix.string()) + " ";
  fmt::print("to build and test it, run: cd {} && {}cmake --workflow --preset effect\n",
             shellQuoted(folder.string()), where);
}

}  // namespace

void addNewEffect(CLI::App& program) {
  auto options = std::make_shared<NewEffectOptions>();
  CLI::App* command = program.add_subcommand(
      "new-effect", "Create the project of a new effect, ready to build, run and test");
  command->add_option("name", options->key, "Key of the effect: a-z, 0-9 and _")->required();
  command->add_option("folder", options->folder,
                      "Folder of the project, empty or new; default: a new folder named after the "
                      "effect");
  command->add_option("--language", options->language, "Language of the effect")
      ->check(CLI::IsMember({"c++", "c"}))
      ->capture_default_str();
  command->callback([options] { newEffect(*options); });
}

}  // namespace grisaille::app
