// SPDX-License-Identifier: MIT
// Checks of options' values, whose messages and help tell a range in few digits.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>

namespace grisaille::app {

// Finite numbers from `least` to `most`.
CLI::Validator numberFrom(double least, double most);

// Whole numbers from `least` to `most`.
CLI::Validator wholeNumberFrom(uint32_t least, uint32_t most);

// Numbers over 0. `infinite`: whether "inf" is one of them.
enum class Infinite : uint8_t { kRefused, kTaken };
CLI::Validator positiveNumber(Infinite infinite = Infinite::kRefused);

// Makes an empty value of any option of the command a mistake: a script's variable that is unset
// must not stand for a default. The empty list of --effects is a choice and stays one.
void refuseEmptyValues(CLI::App& command);

}  // namespace grisaille::app
