// SPDX-License-Identifier: MIT
// Renders one scene: colour, normals and depth. A second pass multiplies the colour by the ambient
// visibility.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

#include "context.h"

namespace example {

// The projection. Reversed depth: 1 at the near plane, 0 at the far one. Clip space has y down.
glm::mat4 clipFromView();

class Renderer {
 public:
  static constexpr uint32_t kFramesInFlight = 2;

  explicit Renderer(Context& context);
  ~Renderer();  // waits for the device
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Begins frame `number`. Waits until the GPU has finished the frame kFramesInFlight before it.
  VkCommandBuffer begin(uint64_t number);
  // Records the scene. Leaves depth and normals in SHADER_READ_ONLY_OPTIMAL, colour in GENERAL.
  void drawScene(VkCommandBuffer commands);
  // Records colour x visibility. visibility: of the picture's size, in this layout, read from r.
  void light(VkCommandBuffer commands, VkImageView visibility, VkImageLayout layout);
  // Submits the frame that begin() began.
  void submit();

  // Waits for the device, then reads an image of the picture's size back. Restores the layout.
  std::vector<std::byte> read(VkImage image, VkImageAspectFlags aspect, VkImageLayout layout,
                              uint32_t pixelBytes);

  Image depth, normal, colour;  // reversed, 0 at the far plane; world space; linear

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
