// SPDX-License-Identifier: MIT
#include "app/services/scene_services.h"

#include "core/base/regular_file.h"

namespace grisaille::app {

void printWarning(const std::string& text) {
  fmt::print(stderr, "warning: {}\n", text);
}

void PictureFiles::read(const char* path, grisaille_picture& out) {
  try {
    const std::string bytes = readRegularFile(path, ErrorId::kImageUnreadable);
    picture_ = image::decode(std::as_bytes(std::span(bytes)), oneLine(path));
  } catch (const Error& error) {
    if (warned_.insert(path).second) warn_(error.detail());
    throw;
  }
  out.width = picture_.width;
  out.height = picture_.height;
  out.reserved = 0;
  out.rgba = picture_.pixels.data();
}

}  // namespace grisaille::app
