// SPDX-License-Identifier: MIT
// Dear ImGui on the layer: its context, its font, and its triangles drawn over a picture. ImGui's
// own renderers are not used: each would need its API's headers here, and the one for Vulkan its
// loader.
#pragma once

#include <cstdint>
#include <vector>

#include "core/gpu/device.h"

struct ImDrawData;

namespace grisaille::app::viewer {

constexpr float kSmallestText = 0.5f, kLargestText = 4;  // times the usual size

// Dear ImGui's one context of the process, with the style of this program. One at a time.
class InterfaceContext {
 public:
  InterfaceContext();
  ~InterfaceContext();
  InterfaceContext(const InterfaceContext&) = delete;
  InterfaceContext& operator=(const InterfaceContext&) = delete;

  // Text and all measures that follow it; `scale` is the display's times the user's. Not between
  // ImGui::NewFrame() and ImGui::Render(). True where the font is another now: InterfaceRenderer is
  // to be told by fontChanged().
  bool setScale(float scale);

 private:
  float scale_ = 0;
};

class InterfaceRenderer {
 public:
  // The device outlives this.
  explicit InterfaceRenderer(gpu::Device& device) : device_(device) {}
  ~InterfaceRenderer();
  InterfaceRenderer(const InterfaceRenderer&) = delete;
  InterfaceRenderer& operator=(const InterfaceRenderer&) = delete;

  void fontChanged();

  // Inside a pass: draws over what `target` (kRgba8Unorm, of the window's size) holds.
  void draw(gpu::Commands& commands, const ImDrawData& data, gpu::Texture target, uint32_t width,
            uint32_t height);

 private:
  void uploadFont(gpu::Commands& commands);
  void gather(const ImDrawData& data);
  gpu::Buffer buffer(gpu::Commands& commands, gpu::Buffer& buffer, uint64_t& capacity,
                     const char* label, std::span<const std::byte> bytes, gpu::BufferUsage usage);

  gpu::Device& device_;
  gpu::GraphicsPipeline pipeline_;
  gpu::Sampler sampler_;
  gpu::Texture font_;
  gpu::Buffer vertices_, indices_;
  uint64_t vertexBytes_ = 0, indexBytes_ = 0;  // capacities
  std::vector<std::byte> vertexData_;          // of the frame; kept for their memory
  std::vector<uint32_t> indexData_;
};

}  // namespace grisaille::app::viewer
