// SPDX-License-Identifier: MIT
// A Vulkan instance, device and queue; creates images, buffers and shaders.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace example {

// Throws std::runtime_error unless `result` is VK_SUCCESS. what: the failed call, for the message.
void check(VkResult result, const char* what);

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};

struct Image {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageAspectFlags aspect = 0;
};

class Context {
 public:
  // validate: enables the validation layer if it is installed, prints its messages to stderr and
  // counts them.
  explicit Context(bool validate);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  Buffer makeBuffer(VkDeviceSize bytes, VkBufferUsageFlags usage);  // mapped
  // The view shows the first layer.
  Image makeImage(VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage,
                  uint32_t layers = 1);
  VkShaderModule makeShader(std::span<const uint32_t> code);
  void destroy(Buffer& buffer);
  void destroy(Image& image);

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;
  int complaints = 0;  // messages of the validation layer

 private:
  void makeInstance(bool validate);
  void makeDevice();
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags);

  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

// Changes the layout of all layers of an image. A full barrier: later commands wait for all earlier
// ones and see their writes.
void transition(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                VkImageLayout before, VkImageLayout after);

}  // namespace example
