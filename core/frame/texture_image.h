// SPDX-License-Identifier: MIT
// Converts a texture's bytes to an image of floats.
#pragma once

#include <span>

#include "core/gpu/types.h"
#include "core/image/image.h"

namespace grisaille::frame {

// `bytes` in the layout of Device::read. Unorm formats become [0, 1], sRGB formats linear light.
image::Image toImage(std::span<const std::byte> bytes, gpu::Format format, uint32_t width,
                     uint32_t height);

// The first `channels` of every pixel.
image::Image firstChannels(const image::Image& image, uint32_t channels);

}  // namespace grisaille::frame
