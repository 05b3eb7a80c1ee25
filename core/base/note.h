// SPDX-License-Identifier: MIT
// Notes to the user from places that can neither fail nor print.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace grisaille {

// Hands one line to the program, which prints it. The same line is handed over once in a process.
// Without a listener it is lost. Any thread may call it.
void note(std::string_view line);

// Sets the function that prints notes; empty: none. It may be called from any thread, one call at a
// time.
void setNoteListener(std::function<void(const std::string&)> listener);

}  // namespace grisaille
