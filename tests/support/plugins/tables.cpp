// SPDX-License-Identifier: MIT
// Effects that only have tables: alpha, beta and gamma, with parameters of every type. -DLATER
// builds a later version of the plugin: gamma is missing, one range is narrower, and a default, an
// entry and a parameter differ.
#include <cstdint>

#include "grisaille/effect.hpp"

namespace {

namespace plugin = grisaille::plugin;

#ifdef LATER
constexpr double kLargest = 10;
constexpr const char* kBoolKey = "soft";
constexpr const char* kKeys[] = {"first", "1e5"};
#else
constexpr double kLargest = 1e300;
constexpr const char* kBoolKey = "hard";
constexpr const char* kKeys[] = {"first", "second", "1e5", "16", "true", "nan", "-0"};
#endif

constexpr grisaille_param_desc kParams[] = {
    plugin::floatParam({.key = "amount",
                        .label = "Amount",
                        .tooltip = "Any number",
                        .hardMin = -kLargest,
                        .hardMax = kLargest,
                        .softMin = 0,
                        .softMax = 1,
                        .defaultValue = 0.5,
                        .step = 0.1}),
    plugin::intParam({.key = "count",
                      .label = "Count",
                      .tooltip = "Any whole number of 32 bits",
                      .hardMin = INT32_MIN,
                      .hardMax = INT32_MAX,
                      .softMin = 0,
                      .softMax = 10,
                      .defaultValue = 3}),
    plugin::boolParam({.key = kBoolKey, .label = "Switch", .tooltip = "Either"}),
    plugin::enumParam({.key = "kind",
                       .label = "Kind",
                       .tooltip = "One of these",
                       .keys = kKeys,
                       .labels = kKeys,
                       .defaultValue = 1})};

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "out", .format = GRISAILLE_FORMAT_R32F, .tooltip = "Never written"})};

struct Idle {
  explicit Idle(plugin::Host) {}
  static uint32_t reads(plugin::Values, uint32_t) noexcept { return 0; }
  void record(const plugin::Frame&) {}
};

constexpr grisaille_effect_desc named(const char* key) {
  return plugin::effect<Idle>({.key = key,
                               .label = "Table",
                               .version = "1.0.0",
                               .tooltip = "Has a table",
                               .params = kParams,
                               .outputs = kOutputs});
}

constexpr auto kAlpha = named("alpha");
constexpr auto kBeta = named("beta");
#ifndef LATER
constexpr auto kGamma = named("gamma");
#endif

}  // namespace

#ifdef LATER
GRISAILLE_EXPORT_PLUGIN(&kBeta, &kAlpha);
#else
GRISAILLE_EXPORT_PLUGIN(&kGamma, &kAlpha, &kBeta);
#endif
