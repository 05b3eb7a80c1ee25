// SPDX-License-Identifier: MIT
#include "core/base/regular_file.h"

#include <cerrno>
#include <cstring>

namespace grisaille {
namespace {

namespace fs = std::filesystem;

const char* nameOf(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
      return "a named pipe";
    case fs::file_type::character:
    case fs::file_type::block:
      return "a device";
    case fs::file_type::socket:
      return "a socket";
    default:
      return "of no known kind";
  }
}

[[noreturn]] void refuse(ErrorId id, const fs::path& path, const std::string& why) {
  throw Error(id, "{}: {}", path.string(), why);
}

}  // namespace

std::string whyNotRegular(const fs::path& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (fs::is_regular_file(status)) return "";
  if (failed) return failed.message();
  return fmt::format("it is {}; only regular files are read", nameOf(status.type()));
}

void requireRegularFile(const fs::path& path, ErrorId id) {
  const std::string why = whyNotRegular(path);
  if (!why.empty()) refuse(id, path, why);
}

std::ifstream openRegularFile(const fs::path& path, ErrorId id) {
  requireRegularFile(path, id);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(id, path, errno != 0 ? std::strerror(errno) : "it cannot be opened");
  return file;
}

std::optional<std::ifstream> openRegularFileIfThere(const fs::path& path, ErrorId id) {
  std::error_code failed;
  if (!fs::exists(path, failed)) return std::nullopt;
  return openRegularFile(path, id);
}

std::string readRegularFile(const fs::path& path, ErrorId id, uintmax_t mostBytes) {
  std::ifstream file = openRegularFile(path, id);
  std::error_code failed;
  const uintmax_t bytes = fs::file_size(path, failed);
  if (failed) refuse(id, path, failed.message());
  if (bytes > mostBytes) refuse(id, path, fmt::format("it is over {} bytes", mostBytes));
  std::string content(bytes, '\0');
  file.read(content.data(), static_cast<std::streamsize>(bytes));
  content.resize(static_cast<size_t>(file.gcount()));
  if (file.bad()) refuse(id, path, "it cannot be read");
  return content;
}

}  // namespace grisaille
