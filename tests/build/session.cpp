// SPDX-License-Identifier: MIT
#include "tests/build/session.h"

#include <sstream>

#include "tests/program/run.h"

namespace grisaille::tests {

std::string sessionOf(const std::filesystem::path& manual) {
  constexpr const char* kEnd = "END_OF_BLOCK";
  std::istringstream text(readFile(manual));
  std::string script = "set -e\n";
  bool inside = false, taken = false, file = false;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("```", 0) != 0) {
      if (inside && taken) script += line + "\n";
      continue;
    }
    if (inside) {
      if (file) script += std::string(kEnd) + "\n";
      inside = false;
      continue;
    }
    inside = true;
    const size_t space = line.find(' ');
    file = space != std::string::npos;
    taken = file || line == "```sh";
    if (!file) continue;
    const std::string name = line.substr(space + 1);
    script += line.rfind("```diff", 0) == 0 ? "patch --silent " + name + " <<'"
                                            : "cat > " + name + " <<'";
    script += std::string(kEnd) + "'\n";
  }
  return script;
}

}  // namespace grisaille::tests
