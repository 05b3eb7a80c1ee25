// SPDX-License-Identifier: MIT
#include "tests/app/apply/odd_pictures.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imageio.h>

#include <stdexcept>

namespace grisaille::tests {

void writeDeepPicture(const std::string& path) {
  OIIO::ImageSpec spec(4, 2, 1, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"Z"};
  spec.deep = true;
  OIIO::DeepData samples(spec);
  for (int64_t pixel = 0; pixel < samples.pixels(); ++pixel) {
    samples.set_samples(pixel, static_cast<int>(pixel % 3));
    for (int sample = 0; sample < samples.samples(pixel); ++sample) {
      samples.set_deep_value(pixel, 0, sample, 1.0f + static_cast<float>(sample));
    }
  }
  const auto output = OIIO::ImageOutput::create("openexr");
  if (!output || !output->open(path, spec) || !output->write_deep_image(samples) ||
      !output->close()) {
    throw std::runtime_error(path + ": " + (output ? output->geterror() : OIIO::geterror()));
  }
}

void writeWithAspect(const image::Image& image, float aspect, const std::string& path) {
  OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                       static_cast<int>(image.channels), OIIO::TypeDesc::FLOAT);
  spec.attribute("PixelAspectRatio", aspect);
  const auto output = OIIO::ImageOutput::create("openexr");
  if (!output || !output->open(path, spec) ||
      !output->write_image(spec.format, image.pixels.data()) || !output->close()) {
    throw std::runtime_error(path + ": " + (output ? output->geterror() : OIIO::geterror()));
  }
}

}  // namespace grisaille::tests
