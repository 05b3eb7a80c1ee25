// SPDX-License-Identifier: MIT
#include "tests/examples/built.h"

#include <cmath>
#include <map>
#include <stdexcept>

namespace grisaille::tests {

namespace {

const TemporaryFolder& folder() {
  static const TemporaryFolder kFolder;
  return kFolder;
}

// Runs a shell command in the folder.
void runHere(const std::string& command) {
  const Outcome outcome = runShell(command, folder().path());
  if (outcome.status != 0) throw std::runtime_error(outcome.out + outcome.err);
}

}  // namespace

const std::string& installedPrefix() {
  static const std::string kPrefix = [] {
    runHere(CMAKE " --install " BUILD_FOLDER " --prefix prefix");
    return folder() / "prefix";
  }();
  return kPrefix;
}

const std::string& builtExample(const std::string& name) {
  static std::map<std::string, std::string> plugins;
  std::string& plugin = plugins[name];
  if (plugin.empty()) {
    runHere("cp -r " SOURCE_FOLDER "/examples/" + name + " . && " CMAKE " -G Ninja -S " + name +
            " -B built_" + name + " -DCMAKE_PREFIX_PATH=" + installedPrefix() +
            " && " CMAKE " --build built_" + name);
    plugin = folder() / ("built_" + name + "/lib/grisaille/effects");
  }
  return plugin;
}

image::Image8 squares(const std::array<Colour, 4>& colours) {
  image::Image8 picture{.width = 64, .height = 64, .pixels = {}};
  for (size_t y = 0; y < 64; ++y) {
    for (size_t x = 0; x < 64; ++x) {
      const Colour& colour = colours[y / 32 * 2 + x / 32];
      picture.pixels.insert(picture.pixels.end(), colour.begin(), colour.end());
    }
  }
  return picture;
}

void writePng(const image::Image8& picture, const TemporaryFolder& folder,
              const std::string& name) {
  const std::vector<std::byte> bytes = image::encodePng(picture);
  folder.write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

float linear(uint8_t srgb) {
  const float c = static_cast<float>(srgb) / 255;
  return c > 0.04045f ? std::pow((c + 0.055f) / 1.055f, 2.4f) : c / 12.92f;
}

}  // namespace grisaille::tests
