// SPDX-License-Identifier: MIT
// Validators of option values. Their messages and help texts print a range in few digits.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>

namespace grisaille::app {

// Finite numbers from `least` to `most`.
CLI::Validator numberFrom(double least, double most);

// Whole numbers from `least` to `most`.
CLI::Validator wholeNumberFrom(uint32_t least, uint32_t most);

// Numbers over 0. `infinite`: whether "inf" is allowed.
enum class Infinite : uint8_t { kRefused, kTaken };
CLI::Validator positiveNumber(Infinite infinite = Infinite::kRefused);

// Finite numbers of 0 or more.
CLI::Validator zeroOrMore();

// Adds --background, which sets `text`.
CLI::Option* addBackground(CLI::App& command, std::string& text);

// Makes every option of the command refuse an empty value, so that an unset variable of a script
// does not select a default. --effects still accepts an empty list.
void refuseEmptyValues(CLI::App& command);

}  // namespace grisaille::app
