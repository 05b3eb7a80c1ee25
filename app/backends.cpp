// SPDX-License-Identifier: MIT
// grisaille backends: lists the backends, and the devices that --device can choose from.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "backends/backends.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

void listBackends(bool asJson) {
  nlohmann::ordered_json json = nlohmann::json::array();
  std::string text;
  for (const backends::Backend& backend : backends::all()) {
    nlohmann::ordered_json entry = {{"backend", backend.name},
                                    {"devices", nlohmann::json::array()}};
    text += fmt::format("{}\n", backend.name);
    try {
      size_t number = 0;
      for (const gpu::ListedDevice& device : backend.list()) {
        entry["devices"].push_back({{"number", number},
                                    {"name", device.name},
                                    {"driver", device.driver},
                                    {"software", device.software}});
        text += fmt::format("  {}  {} ({}){}\n", number++, device.name, device.driver,
                            device.software ? ", software" : "");
      }
    } catch (const Error& error) {
      entry["refused"] = error.what();
      text += fmt::format("  refused: {}\n", error.what());
    }
    json.push_back(std::move(entry));
  }
  std::fputs((asJson ? json.dump(2) + "\n" : text).c_str(), stdout);
}

}  // namespace

void addBackends(CLI::App& program) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = program.add_subcommand("backends", "List the backends and their devices");
  command->add_flag("--json", *json, "Print JSON");
  command->callback([json] { listBackends(*json); });
}

}  // namespace grisaille::app
