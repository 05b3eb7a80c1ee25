// SPDX-License-Identifier: MIT
// Runs a target over the files of a folder, in the order of their names: the main() of a target
// without a fuzzer.
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
  // Told before it is run: it may end the process.
  std::cerr << file.filename().string() << std::endl;
  std::ifstream stream(file, std::ios::binary);
  // A copy of exactly this size, so that a sanitizer sees what is read beyond it.
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
    std::cerr << "give a folder of inputs\n";
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
