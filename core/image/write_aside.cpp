// SPDX-License-Identifier: MIT
#include "core/image/write_aside.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace grisaille::image {
namespace {

std::string partOf(const std::string& path) {
  return fmt::format("{}.{}.part", path, getpid());
}

}  // namespace

void writeAside(const std::string& path,
                const std::function<void(const std::string& part)>& writer) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    throw Error(ErrorId::kFileUnwritable, "{}: is a folder", path);
  }
  const std::string part = partOf(path);
  try {
    writer(part);
    std::filesystem::rename(part, path, code);
    if (code) throw Error(ErrorId::kFileUnwritable, "{}: {}", path, code.message());
  } catch (...) {
    std::filesystem::remove(part, code);
    throw;
  }
}

void writeFileAside(const std::string& path, std::string_view content) {
  writeAside(path, [&](const std::string& part) {
    errno = 0;
    std::ofstream file(part, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file) throw Error(ErrorId::kFileUnwritable, "{}: {}", path, std::strerror(errno));
  });
}

void requireWritable(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    throw Error(ErrorId::kFileUnwritable, "{}: is a folder", path);
  }
  const std::string part = partOf(path);
  errno = 0;
  const bool opened = std::ofstream(part, std::ios::binary).is_open();
  const int why = errno;
  std::filesystem::remove(part, code);
  if (!opened) throw Error(ErrorId::kFileUnwritable, "{}: {}", path, std::strerror(why));
}

void requireWritableFolder(const std::string& folder) {
  std::error_code code;
  const bool made = std::filesystem::create_directories(folder, code);
  if (code) throw Error(ErrorId::kFileUnwritable, "{}: {}", folder, code.message());
  requireWritable((std::filesystem::path(folder) / "grisaille").string());
  if (made) std::filesystem::remove(folder, code);  // who only asked leaves nothing
}

}  // namespace grisaille::image
