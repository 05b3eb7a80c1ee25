// SPDX-License-Identifier: MIT
#include "app/report/machine.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

namespace grisaille::app {

std::string machineName() {
  std::string processor = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    processor = line.substr(line.find(':') + 2);
    break;
  }
  utsname system{};
  uname(&system);
  return fmt::format("{} x{}, {} {}", processor, std::thread::hardware_concurrency(),
                     system.sysname, system.release);
}

}  // namespace grisaille::app
