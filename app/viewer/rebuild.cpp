// SPDX-License-Identifier: MIT
#include "app/viewer/rebuild.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/regular_file.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

// The important lines of a build's output: the first lines with errors, else the last lines.
std::string gist(const std::string& words) {
  constexpr size_t kLines = 8;
  constexpr const char* kTelling[] = {"error", "Error", "undefined"};
  std::vector<std::string> telling, all;
  for (size_t from = 0; from < words.size();) {
    const size_t end = std::min(words.find('\n', from), words.size());
    const std::string line = words.substr(from, end - from);
    if (!line.empty()) all.push_back(line);
    if (std::ranges::any_of(
            kTelling, [&](const char* word) { return line.find(word) != std::string::npos; })) {
      telling.push_back(line);
    }
    from = end + 1;
  }
  std::vector<std::string>& chosen = telling.empty() ? all : telling;
  const size_t first = telling.empty() && chosen.size() > kLines ? chosen.size() - kLines : 0;
  std::string text;
  for (size_t i = first; i < std::min(chosen.size(), first + kLines); ++i) {
    text += (text.empty() ? "" : "\n") + chosen[i];
  }
  return text.empty() ? "the build failed without a message" : text;
}

}  // namespace

Rebuild::~Rebuild() {
  if (build_) build_->wait();
}

std::optional<Rebuild::Plugin> Rebuild::read(const fs::path& description) {
  if (!whyNotRegular(description).empty()) return std::nullopt;
  std::ifstream file(description);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("build") || !json.contains("target") ||
      !json.contains("watch") || !json["watch"].is_array()) {
    return std::nullopt;
  }
  Plugin plugin;
  plugin.folder = json.value("build", "");
  plugin.target = json.value("target", "");
  for (const nlohmann::json& path : json["watch"]) {
    if (path.is_string()) plugin.watched.emplace_back(path.get<std::string>());
  }
  std::error_code failed;
  if (!fs::is_directory(plugin.folder, failed)) return std::nullopt;
  plugin.times = timesOf(plugin);
  return plugin;
}

Rebuild::Times Rebuild::timesOf(const Plugin& plugin) {
  Times times;
  std::error_code failed;
  const auto note = [&](const fs::path& path) {
    const auto time = fs::last_write_time(path, failed);
    if (!failed) times[path] = time;
  };
  for (const fs::path& path : plugin.watched) {
    if (!fs::is_directory(path, failed)) {
      note(path);
      continue;
    }
    for (fs::directory_iterator file(path, failed); !failed && file != fs::directory_iterator();
         file.increment(failed)) {
      if (file->is_regular_file(failed)) note(file->path());
    }
  }
  return times;
}

void Rebuild::watch(const effect::Registry& registry) {
  std::set<fs::path> descriptions;
  for (const effect::Effect& effect : registry.effects()) {
    descriptions.insert(fs::path(effect.path).replace_extension(".build.json"));
  }
  // A refused plugin's next edit may mend it.
  for (const effect::Refused& refused : registry.refused()) {
    descriptions.insert(fs::path(refused.path).replace_extension(".build.json"));
  }
  const std::vector<Plugin> before = std::exchange(plugins_, {});
  for (const fs::path& description : descriptions) {
    std::error_code failed;
    if (!fs::exists(description, failed)) continue;
    auto plugin = read(description);
    if (!plugin) continue;
    // Keep the old times: look() then sees files that were edited during the build.
    const auto known = std::ranges::find(before, plugin->target, &Plugin::target);
    if (known != before.end()) plugin->times = known->times;
    plugins_.push_back(std::move(*plugin));
  }
}

void Rebuild::look() {
  if (build_) return;
  for (Plugin& plugin : plugins_) {
    Times times = timesOf(plugin);
    if (times == plugin.times) continue;
    plugin.times = std::move(times);
    build_ = std::make_unique<Child>(
        std::vector<std::string>{"cmake", "--build", plugin.folder, "--target", plugin.target});
    building_ = plugin.target;
    return;
  }
}

std::optional<Rebuild::Outcome> Rebuild::take() {
  if (!build_ || build_->running()) return std::nullopt;
  building_.clear();
  const std::unique_ptr<Child> ended = std::exchange(build_, nullptr);
  if (ended->status() == 0) return Outcome{true, ""};
  return Outcome{false, gist(ended->out() + ended->err())};
}

}  // namespace grisaille::app::viewer
