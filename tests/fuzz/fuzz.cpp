// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace grisaille::fuzz {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    // In memory if possible: a fuzzer writes thousands of files per second.
    std::error_code none;
    const fs::path shared("/dev/shm");
    std::string name = (fs::is_directory(shared, none) ? shared : fs::temp_directory_path()) /
                       "grisaille_fuzz_XXXXXX";
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot create a folder for files");
    path_ = name;
  }
  ~Folder() {
    std::error_code failed;
    fs::remove_all(path_, failed);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

[[noreturn]] void fail(Place where, const std::string& what) {
  throw std::logic_error(fmt::format("{}:{}: {}", where.file, where.line, what));
}

}  // namespace

void require(bool holds, Place where) {
  if (!holds) fail(where, "what must hold of every input does not");
}

void requireOwn(const Error& error, std::initializer_list<ErrorId> allowed, Place where) {
  const std::string_view line = error.what();
  if (std::ranges::find(allowed, error.id()) == allowed.end()) {
    fail(where, fmt::format("this error is not one of its own: {}", line));
  }
  if (line.find('\n') != std::string_view::npos) fail(where, "an error is over one line");
}

std::string_view textOf(const uint8_t* data, size_t size) {
  return size == 0 ? std::string_view()
                   : std::string_view(reinterpret_cast<const char*>(data), size);
}

std::string_view cut(std::string_view& rest, char end) {
  const size_t at = std::min(rest.find(end), rest.size());
  const std::string_view first = rest.substr(0, at);
  rest.remove_prefix(std::min(at + 1, rest.size()));
  return first;
}

std::string scratchFile(const std::string& name, std::string_view content) {
  static const Folder folder;
  std::string path = folder.path() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(content.data(), static_cast<std::streamsize>(content.size()));
  return path;
}

}  // namespace grisaille::fuzz
