// SPDX-License-Identifier: MIT
#include "app/viewer/tune_run.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/viewer/command_line.h"
#include "core/base/error.h"

namespace grisaille::app::viewer {
namespace fs = std::filesystem;
namespace {

// What stands on a terminal's lines after all that was written: a carriage return begins a line
// anew. Empty ones are left out.
std::vector<std::string> linesOf(const std::string& written) {
  constexpr std::string_view kErase = "\x1b[K";
  std::vector<std::string> lines;
  for (size_t from = 0; from < written.size();) {
    const size_t end = std::min(written.find('\n', from), written.size());
    std::string line = written.substr(from, end - from);
    line.erase(0, line.rfind('\r') + 1);
    while (line.find(kErase) != std::string::npos) line.erase(line.find(kErase), kErase.size());
    if (!line.empty()) lines.push_back(line);
    from = end + 1;
  }
  return lines;
}

// Of the first line that has it.
std::string between(const std::vector<std::string>& lines, const std::string& before,
                    const std::string& after) {
  for (const std::string& line : lines) {
    const size_t at = line.find(before);
    if (at == std::string::npos) continue;
    const size_t from = at + before.size();
    return line.substr(from, after.empty() ? std::string::npos : line.find(after, from) - from);
  }
  return "";
}

// "RMSE 0.1010 at 41.234 ms, 57 evaluations; on unseen cameras 0.1120"
std::string resultOf(const std::vector<std::string>& lines) {
  std::string text = "RMSE " + between(lines, "RMSE ", " (");
  for (const std::string& line : lines) {
    const size_t at = line.find(" evaluations: ");
    if (at != std::string::npos) text += ", " + line.substr(0, at) + " evaluations";
  }
  const std::string unseen = between(lines, "validated on cameras not tuned on: RMSE ", "");
  return unseen.empty() ? text : text + "; on unseen cameras " + unseen;
}

}  // namespace

std::vector<std::string> tuneArguments(const TuneCommand& command) {
  std::vector<std::string> arguments = {"tune"};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  // Before --effects and --vary, which would take it for one more.
  if (!command.scene.empty()) arguments.push_back(plainPath(command.scene));
  add("--camera", scene::cameraJson(command.camera));
  add("--size", fmt::format("{}x{}", command.size.x, command.size.y));
  if (!command.backend.empty()) add("--backend", command.backend);
  if (!command.device.empty()) add("--device", command.device);
  for (const std::string& path : command.pluginPaths) add("--plugin-path", plainPath(path));
  addEffects(*command.effects, command.vary, arguments);
  add("--output", command.output);
  add("--radius", fmt::format("{}", command.radius));
  add("--samples", fmt::format("{}", command.samples));
  if (command.maxError > 0) add("--max-error", fmt::format("{}", command.maxError));
  if (command.budget > 0) add("--budget-ms", fmt::format("{}", command.budget));
  add("--evaluations", fmt::format("{}", command.evaluations));
  add("--vary", fmt::format("{}", fmt::join(command.vary, ",")));
  return arguments;
}

glm::uvec2 tuneSize(glm::uvec2 view) {
  constexpr double kPixels = 640 * 360;
  const double pixels = std::max(double{1}, static_cast<double>(view.x) * view.y);
  const double scale = std::min(1.0, std::sqrt(kPixels / pixels));
  const auto side = [&](uint32_t whole) {
    return std::max(1u, static_cast<uint32_t>(std::lround(whole * scale)));
  };
  return {side(view.x), side(view.y)};
}

TuneRun::~TuneRun() {
  forget();
}

// Also removes the folder, in which the child may have left a part of a file.
void TuneRun::forget() {
  child_.reset();
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
  folder_.clear();
}

void TuneRun::start(const TuneCommand& command) {
  if (child_) return;
  std::string folder = (fs::temp_directory_path() / "grisaille-tune-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    throw Error(ErrorId::kFileUnwritable, "{}: {}", folder, std::strerror(errno));
  }
  folder_ = folder;
  std::vector<std::string> words = program_;
  const std::vector<std::string> arguments = tuneArguments(command);
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.insert(words.end(), {"--progress", "--out", (folder_ / "found.toml").string()});
  vary_ = command.vary;
  cancelled_ = false;
  try {
    child_ = std::make_unique<Child>(std::move(words));
  } catch (...) {
    forget();
    throw;
  }
}

// "tune [####....]  42 % 34 evaluations, RMSE 0.1034, 5 s left"; before that, by the camera,
// "truth 1 of 1 [##......]  25 % 64 of 256 samples a pixel, 7 s left".
TuneRun::State TuneRun::state() const {
  if (!child_) return {};
  if (cancelled_) return {0, "is being cancelled"};
  const std::vector<std::string> lines = linesOf(child_->err());
  if (lines.empty()) return {0, "starts"};
  const std::string& line = lines.back();
  const size_t open = line.find(" ["), bracket = line.find(']'), percent = line.find(" % ");
  if (open > bracket || percent == std::string::npos) return {0, line};
  const std::string name = line.substr(0, open);
  const std::string doing = name == "tune" ? "" : "tracing " + name + ": ";
  return {std::strtod(line.c_str() + bracket + 1, nullptr) / 100, doing + line.substr(percent + 3)};
}

void TuneRun::cancel() {
  if (!child_) return;
  cancelled_ = true;
  child_->end();
}

std::optional<TuneRun::Outcome> TuneRun::take() {
  if (!child_ || child_->running()) return std::nullopt;
  const Outcome outcome = outcomeOf(*child_);
  forget();
  return outcome;
}

TuneRun::Outcome TuneRun::outcomeOf(const Child& ended) const {
  if (cancelled_) return {.values = {}, .text = "cancelled", .warning = {}};
  const std::vector<std::string> told = linesOf(ended.err());
  if (ended.status() != 0) {
    const std::string why = ended.status() < 0 ? "a signal ended it" : "it failed without a word";
    return {.values = {}, .text = told.empty() ? why : told.back(), .warning = {}};
  }
  Outcome outcome;
  for (const std::string& line : told) {
    if (line.starts_with("warning: ")) outcome.warning = line;
  }
  try {
    const Settings found = readSettings((folder_ / "found.toml").string());
    outcome.values.emplace();
    for (const Settings::Value& value : found.values) {
      if (std::ranges::find(vary_, value.effect + "." + value.key) == vary_.end()) continue;
      outcome.values->push_back({value.effect, value.key, value.text, ""});
    }
    outcome.text = resultOf(linesOf(ended.out()));
  } catch (const Error& error) {
    outcome = {.values = {}, .text = error.what(), .warning = {}};
  }
  return outcome;
}

}  // namespace grisaille::app::viewer
