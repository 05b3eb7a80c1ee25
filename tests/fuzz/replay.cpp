// SPDX-License-Identifier: MIT
// The main() of a target without a fuzzer: runs the target on the files of a folder, in order of
// their names.
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include "tests/fuzz/fuzz.h"

namespace {

namespace fs = std::filesystem;

bool runs(const fs::path& file) {
  // Print the name first: the input may end the process.
  std::cerr << file.filename().string() << std::endl;
  std::ifstream stream(file, std::ios::binary);
  // An exact-size copy, so that a sanitizer detects reads beyond its end.
  const std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(stream), {}};
  try {
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    return true;
  } catch (const std::exception& error) {
    std::cerr << "  " << error.what() << std::endl;
    return false;
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::cerr << "pass a folder of inputs\n";
    return 2;
  }
  std::vector<fs::path> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(arguments[1], failed)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  size_t faults = 0;
  for (const fs::path& file : files) faults += runs(file) ? 0 : 1;
  std::cerr << faults << " faults in " << files.size() << " inputs\n";
  return faults == 0 && !files.empty() ? 0 : 1;
}
