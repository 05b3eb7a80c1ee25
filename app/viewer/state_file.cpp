// SPDX-License-Identifier: MIT
#include "app/viewer/state_file.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"
#include "core/scene/built_in.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr size_t kMostRecent = 12;
constexpr uint32_t kLargestSide = 16384;
constexpr uintmax_t kLargestFile = 1 << 20;

fs::path home() {
  const char* given = std::getenv("HOME");
  if (given != nullptr && *given == '/') return given;
  const passwd* user = getpwuid(getuid());
  return user != nullptr ? user->pw_dir : "/";
}

// The XDG base directory specification says to ignore relative paths.
fs::path baseFolder(const char* variable, const char* underHome) {
  const char* given = std::getenv(variable);
  const bool absolute = given != nullptr && *given == '/';
  return (absolute ? fs::path(given) : home() / underHome) / "grisaille";
}

[[noreturn]] void refuse(std::string_view why) {
  throw Error(ErrorId::kViewerState, "{}", why);
}

double numberOf(const json& value, const char* key, double least, double most) {
  const double number = value.is_number() ? value.get<double>() : NAN;
  if (!(number >= least && number <= most)) {
    refuse(fmt::format("'{}' is not a number from {} to {}", key, least, most));
  }
  return number;
}

std::string contentOf(const fs::path& file) {
  std::error_code failed;
  const std::string why = whyNotRegular(file);
  if (!why.empty()) refuse(why);
  if (fs::file_size(file, failed) > kLargestFile || failed) refuse("it is larger than 1 MiB");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("it cannot be opened");
  return {std::istreambuf_iterator<char>(stream), {}};
}

ViewerState parse(const std::string& text) {
  ViewerState state;
  const json document = json::parse(text);
  if (!document.is_object()) refuse("it is not a JSON object");
  for (const auto& [key, value] : document.items()) {
    if (key == "recent") {
      state.recent = value.get<std::vector<std::string>>();
      if (state.recent.size() > kMostRecent) state.recent.resize(kMostRecent);
    } else if (key == "width") {
      state.width = static_cast<uint32_t>(numberOf(value, "width", 1, kLargestSide));
    } else if (key == "height") {
      state.height = static_cast<uint32_t>(numberOf(value, "height", 1, kLargestSide));
    } else if (key == "text_scale") {
      state.layout.textScale =
          numberOf(value, "text_scale", PanelLayout::kSmallestText, PanelLayout::kLargestText);
    } else if (key == "panel_width") {
      state.layout.panelWidth =
          numberOf(value, "panel_width", PanelLayout::kNarrowest, PanelLayout::kWidest);
    } else if (key == "light") {
      state.layout.light = value.get<bool>();
    } else if (key == "sections") {
      state.layout.sections = value.get<decltype(state.layout.sections)>();
      if (state.layout.sections.size() > PanelLayout::kMostSections)
        refuse("'sections' has too many members");
    }
  }
  return state;
}

bool isUtf8(const std::string& text) {
  try {
    return !json(text).dump().empty();
  } catch (const json::exception&) {
    return false;
  }
}

}  // namespace

fs::path stateFolder() {
  return baseFolder("XDG_STATE_HOME", ".local/state");
}

fs::path configFolder() {
  return baseFolder("XDG_CONFIG_HOME", ".config");
}

std::string timeStamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &local);
  return text.data();
}

void ViewerState::noteRecent(const std::string& path) {
  if (scene::findBuiltIn(path) != nullptr) return;
  std::error_code failed;
  const std::string whole = fs::absolute(path, failed).lexically_normal().string();
  if (failed) return;  // the current folder does not exist
  std::erase(recent, whole);
  recent.insert(recent.begin(), whole);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

ViewerState loadState(const fs::path& file, std::string& message) {
  message.clear();
  std::error_code failed;
  if (!fs::exists(file, failed) && !failed) return {};
  std::string why;
  try {
    return parse(contentOf(file));
  } catch (const Error& error) {
    why = error.detail();
  } catch (const std::exception& error) {
    why = error.what();
  }
  const fs::path kept = file.string() + ".damaged";
  fs::rename(file, kept, failed);
  message = Error(ErrorId::kViewerState, "{}: {}; {}", file.string(), why,
                  failed ? "it cannot be renamed" : "it is kept as " + kept.string())
                .what();
  return {};
}

void saveState(const ViewerState& state, const fs::path& file) {
  nlohmann::ordered_json document;
  document["recent"] = json::array();
  for (const std::string& path : state.recent) {
    if (isUtf8(path)) document["recent"].push_back(path);
  }
  document["width"] = state.width;
  document["height"] = state.height;
  document["text_scale"] = state.layout.textScale;
  document["panel_width"] = state.layout.panelWidth;
  document["light"] = state.layout.light;
  document["sections"] = state.layout.sections;
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);  // on failure, writing throws
  writeFileAtomically(file.string(), document.dump(2) + "\n");
}

std::vector<SavedSettings> savedSettings(const fs::path& folder) {
  std::vector<SavedSettings> all;
  std::error_code failed;
  for (fs::directory_iterator file(folder / "settings", failed);
       !failed && file != fs::directory_iterator(); file.increment(failed)) {
    const fs::path& path = file->path();
    if (path.extension() == ".toml") all.push_back({.name = path.stem().string(), .path = path});
  }
  std::ranges::sort(all, {}, &SavedSettings::name);
  return all;
}

}  // namespace grisaille::app::viewer
