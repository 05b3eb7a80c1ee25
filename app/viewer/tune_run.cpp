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

TuneRun::State TuneRun::state() const {
  const ChildRun::State now = run_.state();
  const bool tunes = now.name == "tune" || now.name.empty();
  return {now.done, (tunes ? "" : "tracing " + now.name + ": ") + now.text};
}

std::optional<TuneRun::Outcome> TuneRun::take() {
  const auto ended = run_.take();
  if (!ended) return std::nullopt;
  if (!ended->failure.empty()) return Outcome{.values = {}, .text = ended->failure, .warning = {}};
  try {
    const json found = json::parse(ended->last, nullptr, false);
    if (!found.is_object() || !found.contains("setting")) {
      return Outcome{.values = {}, .text = "it printed no result", .warning = {}};
    }
    Outcome outcome{.values = std::vector<effect::ParameterValue>(),
                    .text = resultOf(found),
                    .warning = found.value("warning", "")};
    for (const auto& [name, value] : found.at("setting").items()) {
      outcome.values->push_back(
          {.name = effect::parseParameterName(name), .value = value.get<double>()});
    }
    return outcome;
  } catch (const json::exception& error) {
    return Outcome{.values = {}, .text = error.what(), .warning = {}};
  }
}

}  // namespace grisaille::app::viewer
