// SPDX-License-Identifier: MIT
#include "app/viewer/tune_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/viewer/command_line.h"
#include "core/base/error.h"

namespace grisaille::app::viewer {
using nlohmann::json;
namespace {

// The JSON objects of all complete lines, the newest last.
std::vector<json> objectsOf(const std::string& written) {
  std::vector<json> objects;
  for (size_t from = 0; from < written.size();) {
    const size_t end = written.find('\n', from);
    if (end == std::string::npos) break;
    json line = json::parse(written.begin() + static_cast<ptrdiff_t>(from),
                            written.begin() + static_cast<ptrdiff_t>(end), nullptr, false);
    if (line.is_object()) objects.push_back(std::move(line));
    from = end + 1;
  }
  return objects;
}

// The last line that is not empty.
std::string lastLine(const std::string& written) {
  const size_t end = written.find_last_not_of("\r\n");
  if (end == std::string::npos) return "";
  const size_t before = written.find_last_of("\r\n", end);
  const size_t from = before == std::string::npos ? 0 : before + 1;
  return written.substr(from, end + 1 - from);
}

// "RMSE 0.1010 at 41.234 ms, 57 evaluations; on unseen cameras 0.1120"
std::string resultOf(const json& found) {
  std::string text =
      fmt::format("RMSE {:.4f} at {:.3f} ms, {} evaluations", found.at("rmse").get<double>(),
                  found.at("milliseconds").get<double>(), found.at("evaluations").get<uint64_t>());
  const json& unseen = found.at("unseen_rmse");
  return unseen.is_null() ? text
                          : text + fmt::format("; on unseen cameras {:.4f}", unseen.get<double>());
}

}  // namespace

std::vector<std::string> tuneArguments(const TuneCommand& command) {
  std::vector<std::string> arguments = {"tune"};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.insert(arguments.end(), {option, value});
  };
  // Before --effects and --vary, which would take the path as another value.
  if (!command.scene.empty()) arguments.push_back(plainPath(command.scene));
  arguments.insert(arguments.end(), command.pose.begin(), command.pose.end());
  add("--camera", scene::cameraJson(command.camera));
  add("--size", fmt::format("{}x{}", command.size.x, command.size.y));
  if (!command.backend.empty()) add("--backend", command.backend);
  if (!command.device.empty()) add("--device", command.device);
  for (const std::string& path : command.pluginPaths) add("--plugin-path", plainPath(path));
  addEffects(*command.effects, arguments);
  add("--output", command.output);
  add("--radius", fmt::format("{}", command.radius));
  add("--samples", fmt::format("{}", command.samples));
  if (command.maxError > 0) add("--max-error", fmt::format("{}", command.maxError));
  if (command.budget > 0) add("--budget-ms", fmt::format("{}", command.budget));
  add("--evaluations", fmt::format("{}", command.evaluations));
  std::string vary;
  for (const effect::ParameterName& name : command.vary) {
    vary += (vary.empty() ? "" : ",") + name.text();
  }
  add("--vary", vary);
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

void TuneRun::start(const TuneCommand& command) {
  if (child_) return;
  std::vector<std::string> words = program_;
  const std::vector<std::string> arguments = tuneArguments(command);
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.emplace_back("--json");
  cancelled_ = false;
  child_ = std::make_unique<Child>(std::move(words));
}

TuneRun::State TuneRun::state() const {
  if (!child_) return {};
  if (cancelled_) return {0, "cancelling"};
  const std::vector<json> told = objectsOf(child_->out());
  if (told.empty()) return {0, "starting"};
  const json& last = told.back();
  const std::string name = last.value("progress", "");
  const std::string doing = name == "tune" || name.empty() ? "" : "tracing " + name + ": ";
  return {last.value("share", 0.0), doing + last.value("text", "")};
}

void TuneRun::cancel() {
  if (!child_) return;
  cancelled_ = true;
  child_->end();
}

std::optional<TuneRun::Outcome> TuneRun::take() {
  if (!child_ || child_->running()) return std::nullopt;
  const Outcome outcome = outcomeOf(*child_);
  child_.reset();
  return outcome;
}

TuneRun::Outcome TuneRun::outcomeOf(const Child& ended) const {
  if (cancelled_) return {.values = {}, .text = "cancelled", .warning = {}};
  if (ended.status() != 0) {
    const std::string why =
        ended.status() < 0 ? "a signal ended it" : "it failed without a message";
    const std::string told = lastLine(ended.err());
    return {.values = {}, .text = told.empty() ? why : told, .warning = {}};
  }
  const std::vector<json> told = objectsOf(ended.out());
  if (told.empty() || !told.back().contains("setting")) {
    return {.values = {}, .text = "it printed no result", .warning = {}};
  }
  try {
    const json& found = told.back();
    Outcome outcome{.values = std::vector<effect::ParameterValue>(),
                    .text = resultOf(found),
                    .warning = found.value("warning", "")};
    for (const auto& [name, value] : found.at("setting").items()) {
      outcome.values->push_back(
          {.name = effect::parseParameterName(name), .value = value.get<double>()});
    }
    return outcome;
  } catch (const json::exception& error) {
    return {.values = {}, .text = error.what(), .warning = {}};
  }
}

}  // namespace grisaille::app::viewer
