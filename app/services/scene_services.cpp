// SPDX-License-Identifier: MIT
#include "app/services/scene_services.h"

#include "core/base/regular_file.h"

namespace grisaille::app {

void PictureFiles::read(const char* path, grisaille_picture& out) {
  const auto before = failed_.find(path);
  if (before != failed_.end()) throw before->second;
  try {
    const std::string bytes = readRegularFile(path, ErrorId::kImageUnreadable);
    picture_ = image::decode(std::as_bytes(std::span(bytes)), oneLine(path));
  } catch (const Error& error) {
    fmt::print(stderr, "warning: {}\n", error.detail());
    failed_.emplace(path, error);
    throw;
  }
  out.width = picture_.width;
  out.height = picture_.height;
  out.reserved = 0;
  out.rgba = picture_.pixels.data();
}

}  // namespace grisaille::app
