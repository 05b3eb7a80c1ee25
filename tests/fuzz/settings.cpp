// SPDX-License-Identifier: MIT
// A settings file and, after a zero byte, assignments as for --set, one per line. Checked against
// the table of one of the program's effects.
#include "app/settings/settings.h"

#include <algorithm>
#include <tuple>

#include "core/effect/registry.h"
#include "tests/fuzz/check_values.h"

namespace grisaille::fuzz {
namespace {

const std::initializer_list<ErrorId> kOfValues = {
    ErrorId::kParameterUnknown, ErrorId::kParameterType, ErrorId::kParameterRange,
    ErrorId::kEffectUnknown,    ErrorId::kEffectTwice,   ErrorId::kUsage};

// Requires that written settings read back unchanged.
void requireRoundTrip(app::Settings settings) {
  const std::string path = scratchFile("written.toml", app::settingsToml(settings));
  app::Settings again = app::readSettings(path);
  require(again.effects == settings.effects && again.surface == settings.surface &&
          again.background == settings.background);
  const auto content = [](const app::Settings::Value& value) {
    return std::tie(value.name, value.text);
  };
  std::ranges::sort(settings.values, {}, content);
  std::ranges::sort(again.values, {}, content);
  require(std::ranges::equal(settings.values, again.values, {}, content, content));
}

void apply(const effect::Registry& registry, const app::Settings& settings,
           std::string_view assignments) {
  const std::vector<std::string> usual = {"ssao"};
  effect::Selection selection(registry, settings.effects.value_or(usual));
  accepted(kOfValues, [&] { app::applySettings(settings, selection); });
  while (!assignments.empty()) {
    const std::string assignment(cut(assignments, '\n'));
    accepted(kOfValues, [&] { selection.set(effect::parseAssignment(assignment)); });
  }
  for (const effect::Selection::Entry& entry : selection.entries()) requireSound(entry.values);
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  static const effect::Registry& registry = []() -> const effect::Registry& {
    static effect::Registry effects;
    effects.load(EFFECTS_FOLDER "/ssao.so");
    return effects;
  }();
  std::string_view assignments = fuzz::textOf(data, size);
  const std::string path = fuzz::scratchFile("a.toml", fuzz::cut(assignments, '\0'));
  app::Settings settings;
  const bool good = fuzz::accepted({ErrorId::kSettingsUnreadable, ErrorId::kSettingsInvalid},
                                   [&] { settings = app::readSettings(path); });
  if (good) fuzz::requireRoundTrip(settings);
  fuzz::accepted(fuzz::kOfValues, [&] { fuzz::apply(registry, settings, assignments); });
  return 0;
}
