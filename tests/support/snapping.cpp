// SPDX-License-Identifier: MIT
#include "tests/support/snapping.h"

#include <cmath>
#include <cstring>

#include "shaders/snap_vert.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 32, kRows = 256;  // pixels of the render target
constexpr double kLeft = 8.5, kLong = 12;     // pixels: each quad begins near the centre of pixel 8
constexpr double kDepthPixels = 64;           // depth is x / kDepthPixels

// Distance from the pixel centre to the left edge of a row's quad, pixels.
double offsetOf(uint32_t row) {
  return (row + 0.5) / 4096;
}

// One quad per row. The left edge moves right from row to row; depth rises along x.
std::vector<float> quads() {
  std::vector<float> positions;
  for (uint32_t row = 0; row < kRows; ++row) {
    const double left = kLeft + offsetOf(row), right = left + kLong;
    const auto add = [&](double x, uint32_t y) {
      positions.push_back(static_cast<float>(x / kWidth * 2 - 1));
      positions.push_back(static_cast<float>(1 - 2.0 * y / kRows));
      positions.push_back(static_cast<float>(x / kDepthPixels));
    };
    add(left, row + 1), add(right, row + 1), add(right, row);
    add(left, row + 1), add(right, row), add(left, row);
  }
  return positions;
}

std::vector<float> draw(gpu::Device& device) {
  const std::vector<float> positions = quads();
  const gpu::Buffer buffer = device.createBuffer({.label = "snapping",
                                                  .size = positions.size() * sizeof(float),
                                                  .usage = gpu::BufferUsage::kVertex});
  const gpu::Texture depth =
      device.createTexture({.label = "snapping",
                            .format = gpu::Format::kD32Float,
                            .width = kWidth,
                            .height = kRows,
                            .usage = gpu::TextureUsage::kTarget | gpu::TextureUsage::kSampled});
  const uint32_t strides[] = {12};
  const gpu::VertexAttribute attributes[] = {{.location = 0}};
  const gpu::GraphicsPipeline pipeline =
      device.createGraphicsPipeline({.label = "snapping",
                                     .vertex = &grisaille_shader_snap_vert,
                                     .streamStrides = strides,
                                     .attributes = attributes,
                                     .depthFormat = gpu::Format::kD32Float});
  const gpu::BufferRange streams[] = {{.buffer = buffer}};
  const gpu::Draw draws[] = {{.pipeline = pipeline,
                              .vertexStreams = streams,
                              .count = static_cast<uint32_t>(positions.size() / 3)}};
  gpu::Commands& commands = device.begin();
  commands.upload(buffer, 0, std::as_bytes(std::span(positions)));
  commands.beginPass("snapping");
  commands.render({.depth = {.view = {.texture = depth}}, .draws = draws});
  commands.endPass();
  device.submit();
  const std::vector<std::byte> bytes = device.read(depth);
  std::vector<float> depths(bytes.size() / sizeof(float));
  std::memcpy(depths.data(), bytes.data(), bytes.size());
  device.destroy(buffer);
  device.destroy(depth);
  device.destroy(pipeline);
  return depths;
}

}  // namespace

Snapping measureSnapping(gpu::Device& device) {
  const std::vector<float> depths = draw(device);
  // Find the first row with an edge that snaps to the right of the centre of pixel 8.
  uint32_t row = 0;
  while (row < kRows && depths[row * kWidth + 8] > 0) ++row;
  Snapping snapping;
  snapping.bits = static_cast<int>(std::lround(std::log2(0.5 / (row / 4096.0 + 1e-6))));
  for (uint32_t y = 0; y < kRows; ++y) {
    for (uint32_t x = 10; x < 18; ++x) {
      const double shift = depths[y * kWidth + x] * kDepthPixels - (x + 0.5);
      snapping.depthShift = std::max(snapping.depthShift, std::abs(shift));
    }
  }
  return snapping;
}

}  // namespace grisaille::tests
