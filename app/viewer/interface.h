// SPDX-License-Identifier: MIT
// Dear ImGui on the rendering layer: its context, its font, and a renderer that draws its triangles
// over a picture. ImGui's own renderers are not used: each needs the headers of its API, and the
// Vulkan renderer needs the loader.
#pragma once

#include <imgui/imgui.h>

#include <cstdint>
#include <vector>

#include "core/gpu/device.h"

namespace grisaille::app::viewer {

constexpr float kSmallestText = 0.5f, kLargestText = 4;  // times the default size

// A colour as text on the theme's background: darker on the light one.
ImVec4 readable(ImVec4 colour);
// The colour of error messages.
ImVec4 errorColour();

// Creates and owns Dear ImGui's context, in this program's style. At most one per process.
class InterfaceContext {
 public:
  InterfaceContext();
  ~InterfaceContext();
  InterfaceContext(const InterfaceContext&) = delete;
  InterfaceContext& operator=(const InterfaceContext&) = delete;

  // Scales the text and all sizes that depend on it; `scale` is the display's scale times the
  // user's. Do not call between ImGui::NewFrame() and ImGui::Render(). True if the font changed:
  // then call InterfaceRenderer::fontChanged().
  bool setScale(float scale);
  // The light theme, or the dark one. The same call limits.
  void setLight(bool light);

 private:
  float scale_ = 0;
  bool light_ = false;
};

// Pictures that the interface shows, as one texture.
struct InterfacePictures {
  uint32_t width = 0, height = 0;  // pixels
  std::vector<std::byte> texels;   // RGBA, 8 bits, sRGB encoded, top row first
  uint64_t revision = 0;           // changes with the texels
};

// The texture of the pictures, for ImDrawList::AddImage().
ImTextureID picturesTexture();

class InterfaceRenderer {
 public:
  // The device must outlive this.
  explicit InterfaceRenderer(gpu::Device& device) : device_(device) {}
  ~InterfaceRenderer();
  InterfaceRenderer(const InterfaceRenderer&) = delete;
  InterfaceRenderer& operator=(const InterfaceRenderer&) = delete;

  void fontChanged();

  // Draws over the content of `target` (kRgba8Unorm, `width` x `height` pixels: the window's size).
  // Call inside a pass. `pictures`: what picturesTexture() stands for; null: nothing.
  void draw(gpu::Commands& commands, const ImDrawData& data, gpu::Texture target, uint32_t width,
            uint32_t height, const InterfacePictures* pictures = nullptr);

 private:
  void uploadFont(gpu::Commands& commands);
  void uploadPictures(gpu::Commands& commands, const InterfacePictures& pictures);
  gpu::GraphicsPipeline makePipeline(bool pictures);
  void gather(const ImDrawData& data);
  gpu::Buffer buffer(gpu::Commands& commands, gpu::Buffer& buffer, uint64_t& capacity,
                     const char* label, std::span<const std::byte> bytes, gpu::BufferUsage usage);

  gpu::Device& device_;
  gpu::GraphicsPipeline pipeline_, picturesPipeline_;
  gpu::Sampler sampler_;
  gpu::Texture font_, pictures_;
  uint64_t picturesRevision_ = 0;
  gpu::Buffer vertices_, indices_;
  uint64_t vertexBytes_ = 0, indexBytes_ = 0;  // capacities
  std::vector<std::byte> vertexData_;          // of the frame; reused, to keep their memory
  std::vector<uint32_t> indexData_;
};

}  // namespace grisaille::app::viewer
