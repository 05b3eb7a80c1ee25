// SPDX-License-Identifier: MIT
// A renderer of one scene: colour, normals and depth, then a pass over the colour that takes the
// share of the sky which each pixel sees.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "context.h"

namespace example {

class Renderer {
 public:
  static constexpr uint32_t kFramesInFlight = 2;

  explicit Renderer(Context& context);
  ~Renderer();  // waits for the device
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Begins a frame, when the one so many before has finished.
  VkCommandBuffer begin(uint64_t number);
  // Depth and normals are in SHADER_READ_ONLY_OPTIMAL afterwards, colour in GENERAL.
  void drawScene(VkCommandBuffer commands);
  // With the share of the sky that is seen, of the size of the picture, in this layout.
  void light(VkCommandBuffer commands, VkImageView visibility, VkImageLayout layout);
  void submit();

  // Waits, then copies a picture of so many bytes a pixel out of this layout, and back into it.
  std::vector<std::byte> read(VkImage image, VkImageAspectFlags aspect, VkImageLayout layout,
                              uint32_t pixelBytes);

  Image depth, normal, colour;  // reversed, infinitely far at 0; world; linear

 private:
  struct Frame {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence done = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
  };
  void makeScenePipeline();
  void makeLightPipeline();
  void makeFrames();

  Context& context_;
  Buffer vertices_;
  uint32_t vertexCount_ = 0;
  VkSampler nearest_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool sets_ = VK_NULL_HANDLE;
  VkPipelineLayout sceneLayout_ = VK_NULL_HANDLE, lightLayout_ = VK_NULL_HANDLE;
  VkPipeline scenePipeline_ = VK_NULL_HANDLE, lightPipeline_ = VK_NULL_HANDLE;
  std::array<Frame, kFramesInFlight> frames_;
  Frame* frame_ = nullptr;
};

}  // namespace example
