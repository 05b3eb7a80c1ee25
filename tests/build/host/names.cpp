// SPDX-License-Identifier: MIT
// A C++ host with functions of its own that have the names of those inside libgrisaille: the linker
// must find no second definition. Prints the keys of the effects, or the line of the error.
#include <cstdio>
#include <cstring>
#include <grisaille/host.hpp>

namespace grisaille {
class Error {
 public:
  Error(int, const char*);
};
Error::Error(int, const char*) {}
}  // namespace grisaille
extern "C" {
void vkCreateInstance() {}
int volkInitialize() {
  return 42;
}
}

int main() {
  vkCreateInstance();
  try {
    const grisaille::host::Device device = grisaille::host::Device::opengl();
  } catch (const grisaille::host::Failure& failure) {
    std::puts(failure.what());
    return std::strstr(failure.what(), "E5604") != nullptr && volkInitialize() == 42 ? 0 : 1;
  }
  return 1;
}
