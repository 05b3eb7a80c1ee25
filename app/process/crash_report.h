// SPDX-License-Identifier: MIT
#pragma once

namespace grisaille::app {

// Installs the crash handler. If a plugin's function crashes, the handler prints a line with the
// names of the effect and the function. The program then ends as without a handler: by the signal,
// with a core dump if the system writes them.
void nameCrashes();

}  // namespace grisaille::app
