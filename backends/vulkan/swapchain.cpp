// SPDX-License-Identifier: MIT
#include "backends/vulkan/swapchain.h"

#include <algorithm>

namespace grisaille::vulkan {
namespace {

// Time to wait for an image: a hidden window may never release one.
constexpr uint64_t kPatience = 500'000'000;  // nanoseconds

// The stages that write a window's images.
constexpr VkPipelineStageFlags2 kWriters =
    VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT;

constexpr VkImageSubresourceRange kWhole = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

VkExtent2D extentOf(const VkSurfaceCapabilitiesKHR& able, VkExtent2D window) {
  if (able.currentExtent.width != UINT32_MAX) return able.currentExtent;
  return {
      std::clamp(window.width, able.minImageExtent.width, able.maxImageExtent.width),
      std::clamp(window.height, able.minImageExtent.height, able.maxImageExtent.height),
  };
}

VkCompositeAlphaFlagBitsKHR compositeAlpha(VkCompositeAlphaFlagsKHR able) {
  for (const VkCompositeAlphaFlagBitsKHR one :
       {VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR, VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR}) {
    if ((able & one) != 0) return one;
  }
  return VK_COMPOSITE_ALPHA_PRE_MULTIPLIED_BIT_KHR;
}

bool lost(VkResult result) {
  return result == VK_ERROR_SURFACE_LOST_KHR;
}

}  // namespace

Swapchain::Swapchain(Context& context, Resources& resources, Timeline& timeline)
    : context_(context),
      resources_(resources),
      timeline_(timeline),
      surface_(*context.surface()),
      copies_{Copy(context), Copy(context)} {}

Swapchain::~Swapchain() {
  clear();
  context_.vk.vkDestroySwapchainKHR(context_.device, swapchain_, nullptr);
}

// Destroys the semaphores and forgets the images. The device must be idle.
void Swapchain::clear() {
  for (const Image& image : images_) {
    context_.vk.vkDestroySemaphore(context_.device, image.drawn, nullptr);
  }
  images_.clear();
  for (Copy& copy : copies_) {
    context_.vk.vkDestroySemaphore(context_.device, copy.acquired, nullptr);
    copy.acquired = VK_NULL_HANDLE;
  }
}

void Swapchain::loseSurface() {
  check(context_.vk.vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
  clear();
  context_.vk.vkDestroySwapchainKHR(context_.device, swapchain_, nullptr);
  swapchain_ = VK_NULL_HANDLE;
  surface_.renew();
}

VkSemaphore Swapchain::makeSemaphore(const char* label) {
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
  VkSemaphore made = VK_NULL_HANDLE;
  check(context_.vk.vkCreateSemaphore(context_.device, &info, nullptr, &made), "vkCreateSemaphore");
  context_.name(VK_OBJECT_TYPE_SEMAPHORE, made, label);
  return made;
}

// Chooses an 8-bit UNORM format: pictures are sRGB encoded already.
VkSurfaceFormatKHR Swapchain::chooseFormat() const {
  const auto list = surface_.functions().formats;
  uint32_t count = 0;
  check(list(context_.physical, surface_.handle(), &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(list(context_.physical, surface_.handle(), &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const VkSurfaceFormatKHR& one : formats) {
    const bool eight =
        one.format == VK_FORMAT_B8G8R8A8_UNORM || one.format == VK_FORMAT_R8G8B8A8_UNORM;
    if (eight && one.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) return one;
  }
  throw Error(ErrorId::kDeviceFailed, "the window's surface has no format of 8 bits per channel");
}

// Creates nothing while the window has no area: returns VK_SUCCESS and leaves `made` unchanged.
VkResult Swapchain::create(VkExtent2D window, VkSwapchainKHR& made) {
  VkSurfaceCapabilitiesKHR able{};
  const VkResult asked =
      surface_.functions().capabilities(context_.physical, surface_.handle(), &able);
  if (asked != VK_SUCCESS) return asked;
  extent_ = extentOf(able, window);
  if (extent_.width == 0 || extent_.height == 0) return VK_SUCCESS;
  if ((able.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) == 0) {
    throw Error(ErrorId::kDeviceFailed, "the window's surface does not allow copies to its images");
  }
  const VkSurfaceFormatKHR format = chooseFormat();
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = surface_.handle();
  info.minImageCount = able.minImageCount + 1;  // one to draw to while the others are presented
  if (able.maxImageCount != 0) {
    info.minImageCount = std::min(info.minImageCount, able.maxImageCount);
  }
  info.imageFormat = format.format;
  info.imageColorSpace = format.colorSpace;
  info.imageExtent = extent_;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.preTransform = able.currentTransform;
  info.compositeAlpha = compositeAlpha(able.supportedCompositeAlpha);
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_;
  return context_.vk.vkCreateSwapchainKHR(context_.device, &info, nullptr, &made);
}

// Recreates the swapchain. Returns false if nothing can be presented now.
bool Swapchain::make(VkExtent2D window) {
  check(context_.vk.vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
  VkSwapchainKHR made = VK_NULL_HANDLE;
  const VkResult result = create(window, made);
  if (lost(result)) {
    loseSurface();
    return false;
  }
  if (result == VK_SUCCESS && made == VK_NULL_HANDLE) return false;
  // Even a failed vkCreateSwapchainKHR() retires the old swapchain.
  clear();
  context_.vk.vkDestroySwapchainKHR(context_.device, swapchain_, nullptr);
  swapchain_ = made;
  check(result, "vkCreateSwapchainKHR");
  window_ = window;
  fill();
  return true;
}

void Swapchain::fill() {
  uint32_t count = 0;
  check(context_.vk.vkGetSwapchainImagesKHR(context_.device, swapchain_, &count, nullptr),
        "vkGetSwapchainImagesKHR");
  std::vector<VkImage> images(count);
  check(context_.vk.vkGetSwapchainImagesKHR(context_.device, swapchain_, &count, images.data()),
        "vkGetSwapchainImagesKHR");
  for (const VkImage image : images) {
    context_.name(VK_OBJECT_TYPE_IMAGE, image, "window");
    images_.push_back({.image = image});
    images_.back().drawn = makeSemaphore("window image drawn");
  }
  for (Copy& copy : copies_) copy.acquired = makeSemaphore("window image acquired");
}

void Swapchain::barrier(VkCommandBuffer commands, VkImageMemoryBarrier2 barrier, VkImage image) {
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = kWhole;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  context_.vk.vkCmdPipelineBarrier2(commands, &info);
}

void Swapchain::record(VkCommandBuffer commands, gpu::Texture picture, VkImage image) {
  const VolkDeviceTable& vk = context_.vk;
  const TextureObject& from = resources_.get(picture);
  resources_.tracker().use(
      {.texture = picture, .mip = 0, .mipCount = 1, .layer = 0, .layerCount = 1},
      gpu::Access::kCopyRead);
  resources_.recordBarriers(commands);

  constexpr VkImageLayout kTo = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  VkImageMemoryBarrier2 between{};
  between.srcStageMask = between.dstStageMask = kWriters;  // the acquired semaphore's stages
  between.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  between.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  between.newLayout = kTo;
  barrier(commands, between, image);
  between.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  between.oldLayout = kTo;
  const uint32_t width = std::min(extent_.width, from.desc.width);
  const uint32_t height = std::min(extent_.height, from.desc.height);
  if (width < extent_.width || height < extent_.height) {
    const VkClearColorValue black{{0, 0, 0, 1}};
    vk.vkCmdClearColorImage(commands, image, kTo, &black, 1, &kWhole);
    barrier(commands, between, image);
  }
  VkImageBlit region{};  // not a copy: the window may have red and blue swapped
  region.srcSubresource = region.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.srcOffsets[1] =
      region.dstOffsets[1] = {static_cast<int32_t>(width), static_cast<int32_t>(height), 1};
  vk.vkCmdBlitImage(commands, from.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, image, kTo, 1,
                    &region, VK_FILTER_NEAREST);
  between.dstStageMask = VK_PIPELINE_STAGE_2_NONE;  // the drawn semaphore orders presentation
  between.dstAccessMask = VK_ACCESS_2_NONE;
  between.newLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  barrier(commands, between, image);
}

// Presents an image. Returns false if the window did not take it.
bool Swapchain::queue(uint32_t index) {
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &images_[index].drawn;
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain_;
  info.pImageIndices = &index;
  const VkResult result = context_.vk.vkQueuePresentKHR(context_.queue, &info);
  stale_ = result != VK_SUCCESS;
  if (result == VK_SUBOPTIMAL_KHR) return true;
  if (result == VK_ERROR_OUT_OF_DATE_KHR) return false;
  if (lost(result)) {
    loseSurface();
    return false;
  }
  check(result, "vkQueuePresentKHR");
  return true;
}

// A failure before presentation leaves stale_ set: the next call recreates the images and their
// semaphores.
bool Swapchain::show(gpu::Texture picture) {
  (void)resources_.get(picture);  // throws kStaleHandle
  const VkExtent2D window = surface_.size();
  if (window.width == 0 || window.height == 0) return false;
  stale_ = stale_ || window.width != window_.width || window.height != window_.height;
  if (stale_ && !make(window)) return false;
  stale_ = true;
  Copy& copy = copies_[shown_ % kInFlight];
  timeline_.wait(copy.done);
  uint32_t index = 0;
  const VkResult acquired = context_.vk.vkAcquireNextImageKHR(
      context_.device, swapchain_, kPatience, copy.acquired, VK_NULL_HANDLE, &index);
  switch (acquired) {
    case VK_SUCCESS:
    case VK_SUBOPTIMAL_KHR:
      break;
    case VK_TIMEOUT:
    case VK_NOT_READY:
      stale_ = false;
      return false;
    case VK_ERROR_OUT_OF_DATE_KHR:
      return false;
    default:
      if (!lost(acquired)) check(acquired, "vkAcquireNextImageKHR");
      loseSurface();
      return false;
  }
  copy.commands.begin();
  record(copy.commands.handle(), picture, images_[index].image);
  copy.done = copy.commands.submit(timeline_, {copy.acquired, images_[index].drawn});
  resources_.commit();
  ++shown_;
  const bool shown = queue(index);
  stale_ = stale_ || acquired == VK_SUBOPTIMAL_KHR;
  return shown;
}

}  // namespace grisaille::vulkan
