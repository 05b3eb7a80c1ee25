// SPDX-License-Identifier: MIT
// Inputs of `grisaille apply` other than pixels. One line each for the file's name, the frames, the
// requested channels and the existing channels; then the floats of the matrices.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/apply/channels.h"
#include "app/options/sequence.h"
#include "core/scene/camera_matrices.h"
#include "tests/fuzz/fuzz.h"

namespace grisaille::fuzz {
namespace {

void checkNames(const std::string& name, const std::string& frames) {
  accepted({ErrorId::kSequence}, [&] {
    const app::FileName file(name);
    require(file.numbered() || file.at(7) == name);
    require(!file.numbered() || file.at(7) != file.at(8));
    file.at(1234567890);
  });
  accepted({ErrorId::kUsage}, [&] {
    const std::vector<int> numbers = app::parseFrames(frames);
    require(!numbers.empty() && numbers.front() >= 0);
    for (size_t i = 1; i < numbers.size(); ++i) require(numbers[i] > numbers[i - 1]);
  });
}

// Only short sequences: the longest one takes a millisecond.
void checkTimes(const std::string& text) {
  accepted({ErrorId::kUsage}, [&] {
    const std::vector<double> times = app::parseTimes(text);
    require(!times.empty() && times.front() >= 0);
    for (size_t i = 1; i < times.size(); ++i) require(times[i] >= times[i - 1]);
  });
}

void checkChannels(const std::string& wanted, std::string_view names) {
  image::Picture picture;
  while (!names.empty()) picture.channels.emplace_back(cut(names, ','));
  if (picture.channels.empty()) picture.channels.emplace_back("Z");
  const size_t count = picture.channels.size();
  picture.image = {.width = 2,
                   .height = 1,
                   .channels = static_cast<uint32_t>(count),
                   .pixels = std::vector<float>(2 * count, 1)};
  const auto wellFormed = [](const image::Image& image, uint32_t channels) {
    require(image.channels == channels && image.pixels.size() == size_t{2} * channels);
  };
  accepted({ErrorId::kPictureChannels},
           [&] { wellFormed(app::depthChannel(picture, wanted, "input"), 1); });
  accepted({ErrorId::kPictureChannels},
           [&] { wellFormed(app::normalChannels(picture, wanted, "input"), 3); });
  accepted({ErrorId::kPictureChannels},
           [&] { wellFormed(app::colourChannels(picture, "input"), 3); });
}

void checkMatrices(std::string_view bytes) {
  image::ViewMatrices matrices;
  for (auto* matrix : {&matrices.worldToCamera, &matrices.worldToNdc}) {
    for (float& value : *matrix) {
      const size_t size = std::min(bytes.size(), sizeof value);
      if (size > 0) std::memcpy(&value, bytes.data(), size);
      bytes.remove_prefix(size);
    }
  }
  accepted({ErrorId::kPictureMatrices}, [&] {
    const scene::Camera camera = scene::cameraOf(matrices, 16, 9, "input");
    scene::validate(camera);
    const glm::dmat3 axes = scene::worldFromView(camera);
    for (int i = 0; i < 9; ++i) require(std::isfinite(axes[i / 3][i % 3]));
  });
}

}  // namespace
}  // namespace grisaille::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  std::string_view rest = fuzz::textOf(data, size);
  const std::string name(fuzz::cut(rest, '\n')), frames(fuzz::cut(rest, '\n'));
  const std::string wanted(fuzz::cut(rest, '\n'));
  const std::string_view channels = fuzz::cut(rest, '\n');
  fuzz::checkNames(name, frames);
  fuzz::checkTimes(frames);
  fuzz::checkChannels(wanted, channels);
  fuzz::checkMatrices(rest);
  return 0;
}
