// SPDX-License-Identifier: MIT
#include "backends/vulkan/frame.h"

namespace grisaille::vulkan {

CommandBuffer::CommandBuffer(Context& context) : context_(context) {
  const VolkDeviceTable& vk = context.vk;
  VkCommandPoolCreateInfo info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  info.queueFamilyIndex = context.queueFamily;
  check(vk.vkCreateCommandPool(context.device, &info, nullptr, &pool_), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocation.commandPool = pool_;
  allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocation.commandBufferCount = 1;
  const VkResult result = vk.vkAllocateCommandBuffers(context.device, &allocation, &commands_);
  if (result != VK_SUCCESS) vk.vkDestroyCommandPool(context.device, pool_, nullptr);
  check(result, "vkAllocateCommandBuffers");
}

CommandBuffer::~CommandBuffer() {
  context_.vk.vkDestroyCommandPool(context_.device, pool_, nullptr);
}

void CommandBuffer::begin() {
  check(context_.vk.vkResetCommandPool(context_.device, pool_, 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(context_.vk.vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
}

uint64_t CommandBuffer::submit(Timeline& timeline, const ImageSemaphores& image) {
  check(context_.vk.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
  return timeline.submit(commands_, image);
}

}  // namespace grisaille::vulkan
