// SPDX-License-Identifier: MIT
#pragma once

namespace grisaille::app {

// From then on, a crash inside of a plugin's function ends the program with a line that names both,
// and then as it would have ended: by its signal, and with a core dump where there are any.
void nameCrashes();

}  // namespace grisaille::app
