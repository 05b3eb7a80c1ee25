// SPDX-License-Identifier: MIT
#include "backends/vulkan/timeline.h"

namespace grisaille::vulkan {

Timeline::Timeline(Context& context) : context_(context) {
  VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type, 0};
  check(context_.vk.vkCreateSemaphore(context_.device, &info, nullptr, &semaphore_),
        "vkCreateSemaphore");
}

Timeline::~Timeline() {
  context_.vk.vkDestroySemaphore(context_.device, semaphore_, nullptr);
}

uint64_t Timeline::submit(VkCommandBuffer commands, const ImageSemaphores& image) {
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = commands;
  VkSemaphoreSubmitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  wait.semaphore = image.acquired;
  wait.stageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT;
  VkSemaphoreSubmitInfo signals[2] = {{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO},
                                      {VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO}};
  signals[0].semaphore = semaphore_;
  signals[0].value = submitted_ + 1;
  signals[1].semaphore = image.drawn;
  signals[0].stageMask = signals[1].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkSubmitInfo2 submit{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  submit.waitSemaphoreInfoCount = image.acquired == VK_NULL_HANDLE ? 0 : 1;
  submit.pWaitSemaphoreInfos = &wait;
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &buffer;
  submit.signalSemaphoreInfoCount = image.drawn == VK_NULL_HANDLE ? 1 : 2;
  submit.pSignalSemaphoreInfos = signals;
  check(context_.vk.vkQueueSubmit2(context_.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
  return ++submitted_;
}

uint64_t Timeline::completed() const {
  uint64_t count = 0;
  check(context_.vk.vkGetSemaphoreCounterValue(context_.device, semaphore_, &count),
        "vkGetSemaphoreCounterValue");
  return count;
}

void Timeline::wait(uint64_t count) const {
  if (count == 0) return;
  VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
  info.semaphoreCount = 1;
  info.pSemaphores = &semaphore_;
  info.pValues = &count;
  check(context_.vk.vkWaitSemaphores(context_.device, &info, UINT64_MAX), "vkWaitSemaphores");
}

}  // namespace grisaille::vulkan
