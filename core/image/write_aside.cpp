// SPDX-License-Identifier: MIT
#include "core/image/write_aside.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace grisaille::image {

void writeAside(const std::string& path,
                const std::function<void(const std::string& part)>& writer) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code)) {
    throw Error(ErrorId::kFileUnwritable, "{}: is a folder", path);
  }
  const std::string part =
      fmt::format("{}.{}.part{}", path, getpid(), std::filesystem::path(path).extension().string());
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

}  // namespace grisaille::image
