// SPDX-License-Identifier: MIT
#include "app/options/option_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "app/settings/background.h"

namespace grisaille::app {
namespace {

// Accepts the texts that CLI11 later converts to a number.
std::optional<double> numberOf(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (text.empty() || end != text.c_str() + text.size()) return std::nullopt;
  return number;
}

// `shown`: the range in the help. `kind`: for the message, e.g. "a number over 0". `allowed` must
// return false for NaN.
template <typename Allowed>
CLI::Validator checkOf(const std::string& shown, const std::string& kind, Allowed allowed) {
  return {[kind, allowed](const std::string& text) {
            const std::optional<double> number = numberOf(text);
            if (number && allowed(*number)) return std::string();
            return fmt::format("'{}' is not {}", text, kind);
          },
          shown};
}

}  // namespace

CLI::Validator numberFrom(double least, double most) {
  const std::string range = fmt::format("{:g} to {:g}", least, most);
  return checkOf(range, "a number from " + range,
                 [=](double number) { return number >= least && number <= most; });
}

CLI::Validator wholeNumberFrom(uint32_t least, uint32_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return checkOf(range, "a whole number from " + range, [=](double number) {
    return number >= least && number <= most && number == std::floor(number);
  });
}

CLI::Validator positiveNumber(Infinite infinite) {
  const bool taken = infinite == Infinite::kTaken;
  return checkOf("over 0", taken ? "a number over 0 or inf" : "a number over 0",
                 [=](double number) { return number > 0 && (taken || std::isfinite(number)); });
}

CLI::Validator zeroOrMore() {
  return checkOf("0 or more", "a number of 0 or more",
                 [](double number) { return number >= 0 && std::isfinite(number); });
}

CLI::Option* addBackground(CLI::App& command, std::string& text) {
  const auto check = [](const std::string& given) {
    return backgroundOf(given) ? std::string()
                               : fmt::format(
                                     "'{}' is neither a colour as in #808080 nor "
                                     "transparent",
                                     given);
  };
  return command
      .add_option("--background", text,
                  "Colour of color where there is no surface; transparent: none, with the "
                  "surfaces in an alpha channel")
      ->type_name("#rrggbb|transparent")
      ->check(CLI::Validator(check, ""));
}

void refuseEmptyValues(CLI::App& command) {
  const auto check = [](const std::string& text) {
    return std::string(text.empty() ? "the value is empty; give one or leave the option out" : "");
  };
  for (CLI::Option* option : command.get_options()) {
    const bool takesValues = option->get_items_expected_max() > 0;
    if (takesValues && option->get_name() != "--effects") option->check(CLI::Validator(check, ""));
  }
}

}  // namespace grisaille::app
