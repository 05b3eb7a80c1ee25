// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <glm/gtc/packing.hpp>
#include <stdexcept>

#include "examples/vulkan/context.h"
#include "tests/host/vulkan_host.h"

namespace grisaille::tests {
namespace {

struct Kind {
  VkFormat format;
  uint32_t channels;  // numbers of a texel
  VkImageAspectFlags aspects = VK_IMAGE_ASPECT_COLOR_BIT, copied = VK_IMAGE_ASPECT_COLOR_BIT;
};

Kind kindOf(Texels texels) {
  constexpr VkImageAspectFlags kDepth = VK_IMAGE_ASPECT_DEPTH_BIT,
                               kBoth = kDepth | VK_IMAGE_ASPECT_STENCIL_BIT;
  switch (texels) {
    case Texels::kFloat1:
      return {VK_FORMAT_R32_SFLOAT, 1};
    case Texels::kFloat4:
      return {VK_FORMAT_R32G32B32A32_SFLOAT, 4};
    case Texels::kHalf4:
      return {VK_FORMAT_R16G16B16A16_SFLOAT, 4};
    case Texels::kUnorm8x4:
      return {VK_FORMAT_R8G8B8A8_UNORM, 4};
    case Texels::kUnorm16x2:
      return {VK_FORMAT_R16G16_UNORM, 2};
    case Texels::kUnorm10x3:
      return {VK_FORMAT_A2B10G10R10_UNORM_PACK32, 3};
    case Texels::kDepth16:
      return {VK_FORMAT_D16_UNORM, 1, kDepth, kDepth};
    case Texels::kDepth24:
      return {VK_FORMAT_X8_D24_UNORM_PACK32, 1, kDepth, kDepth};
    case Texels::kDepth24Stencil:
      return {VK_FORMAT_D24_UNORM_S8_UINT, 1, kBoth, kDepth};
    case Texels::kDepth32:
      return {VK_FORMAT_D32_SFLOAT, 1, kDepth, kDepth};
    default:
      return {VK_FORMAT_D32_SFLOAT_S8_UINT, 1, kBoth, kDepth};
  }
}

// The texels as a buffer holds them that is copied to an image.
std::vector<std::byte> encoded(Texels texels, uint32_t channels,
                               const std::vector<float>& numbers) {
  std::vector<std::byte> bytes;
  const auto add = [&](auto word) {
    const auto* from = reinterpret_cast<const std::byte*>(&word);
    bytes.insert(bytes.end(), from, from + sizeof(word));
  };
  const auto steps = [](float number, uint32_t most) {
    return static_cast<uint32_t>(std::lround(double{number} * most));
  };
  for (size_t i = 0; i < numbers.size(); i += channels) {
    uint32_t packed = 3u << 30;  // RGB10A2
    for (size_t c = 0; c < channels; ++c) {
      const float number = numbers[i + c];
      switch (texels) {
        case Texels::kHalf4:
          add(glm::packHalf1x16(number));
          break;
        case Texels::kUnorm8x4:
          add(static_cast<uint8_t>(steps(number, 255)));
          break;
        case Texels::kUnorm16x2:
        case Texels::kDepth16:
          add(static_cast<uint16_t>(steps(number, 65535)));
          break;
        case Texels::kUnorm10x3:
          packed |= steps(number, 1023) << 10 * c;
          break;
        case Texels::kDepth24:
        case Texels::kDepth24Stencil:
          add(steps(number, (1u << 24) - 1));
          break;
        default:
          add(number);
      }
    }
    if (texels == Texels::kUnorm10x3) add(packed);
  }
  return bytes;
}

class VulkanHost : public Host {
 public:
  explicit VulkanHost(bool validate) : context_(validate) {
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = context_.family;
    example::check(vkCreateCommandPool(context_.device, &pool, nullptr, &pool_), "a pool");
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool_;
    info.commandBufferCount = 1;
    example::check(vkAllocateCommandBuffers(context_.device, &info, &commands_), "commands");
  }
  ~VulkanHost() override {
    for (example::Image& image : images_) context_.destroy(image);
    vkDestroyCommandPool(context_.device, pool_, nullptr);
  }

  host::VulkanSpec spec() const {
    return {.instance = context_.instance,
            .physicalDevice = context_.physical,
            .device = context_.device,
            .queueFamily = context_.family,
            .framesInFlight = 1};
  }
  host::Device device(const char* effectFolder, uint32_t flags,
                      const grisaille_host_log* log) override {
    host::VulkanSpec with = spec();
    with.effectFolder = effectFolder;
    with.flags = flags;
    with.log = log;
    return host::Device::vulkan(with);
  }

  host::Texture texture(const host::Device& device, Texels texels, uint32_t width, uint32_t height,
                        const std::vector<float>& numbers, uint32_t layers) override;
  bool has(Texels texels) const override {
    VkFormatProperties properties{};
    vkGetPhysicalDeviceFormatProperties(context_.physical, kindOf(texels).format, &properties);
    return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) != 0;
  }
  host::TextureSpec described() const override { return described_; }

  void frame(const std::function<void(void*, uint64_t)>& record) override {
    submit([&] { record(commands_, frame_); });
    ++frame_;
  }
  void drop(const std::function<void(void*, uint64_t)>& record) override {
    begin();
    record(commands_, frame_);
    example::check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
  }
  std::vector<float> read(const grisaille_host_output& output, uint32_t layer) override;
  int complaints() const override { return context_.complaints; }

  VkImageLayout home = VK_IMAGE_LAYOUT_GENERAL;  // layout of new textures

 private:
  void begin() {
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    example::check(vkBeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
  }
  void submit(const std::function<void()>& record) {
    begin();
    record();
    example::check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    example::check(vkQueueSubmit(context_.queue, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
    example::check(vkQueueWaitIdle(context_.queue), "vkQueueWaitIdle");
  }

  example::Context context_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  std::deque<example::Image> images_;
  host::TextureSpec described_;
  uint64_t frame_ = 0;
};

host::Texture VulkanHost::texture(const host::Device& device, Texels texels, uint32_t width,
                                  uint32_t height, const std::vector<float>& numbers,
                                  uint32_t layers) {
  const Kind kind = kindOf(texels);
  const uint32_t count = std::max(layers, 1u);
  VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (kind.copied == VK_IMAGE_ASPECT_DEPTH_BIT)
    usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  const example::Image& image =
      images_.emplace_back(context_.makeImage(kind.format, width, height, usage, count));
  const std::vector<std::byte> bytes = encoded(texels, kind.channels, numbers);
  example::Buffer buffer = context_.makeBuffer(bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  std::memcpy(buffer.mapped, bytes.data(), bytes.size());
  submit([&] {
    const auto turn = [&](VkImageLayout from, VkImageLayout to) {
      example::transition(commands_, image.image, kind.aspects, from, to);
    };
    turn(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {kind.copied, 0, 0, count};
    region.imageExtent = {width, height, 1};
    vkCmdCopyBufferToImage(commands_, buffer.buffer, image.image,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    turn(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, home);
  });
  context_.destroy(buffer);
  described_ = {.image = host::number(image.image),
                .format = static_cast<uint32_t>(kind.format),
                .layout = static_cast<uint32_t>(home),
                .width = width,
                .height = height,
                .layers = count};
  return {device, described_};
}

std::vector<float> VulkanHost::read(const grisaille_host_output& output, uint32_t layer) {
  const bool half = output.native_format == VK_FORMAT_R16_SFLOAT ||
                    output.native_format == VK_FORMAT_R16G16B16A16_SFLOAT;
  if (!half && output.native_format != VK_FORMAT_R32_SFLOAT) {
    throw std::runtime_error("this host reads back only half and single floats");
  }
  const size_t channels = output.native_format == VK_FORMAT_R16G16B16A16_SFLOAT ? 4 : 1;
  std::vector<float> numbers(size_t{output.width} * output.height * channels);
  const size_t bytes = numbers.size() * (half ? sizeof(uint16_t) : sizeof(float));
  example::Buffer buffer = context_.makeBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  const auto image = reinterpret_cast<VkImage>(output.image);
  const auto layout = static_cast<VkImageLayout>(output.layout);
  submit([&] {
    example::transition(commands_, image, VK_IMAGE_ASPECT_COLOR_BIT, layout,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, layer, 1};
    region.imageExtent = {output.width, output.height, 1};
    vkCmdCopyImageToBuffer(commands_, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer, 1,
                           &region);
    example::transition(commands_, image, VK_IMAGE_ASPECT_COLOR_BIT,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
  });
  if (half) {
    std::vector<uint16_t> halves(numbers.size());
    std::memcpy(halves.data(), buffer.mapped, bytes);
    std::ranges::transform(halves, numbers.begin(), glm::unpackHalf1x16);
  } else {
    std::memcpy(numbers.data(), buffer.mapped, bytes);
  }
  context_.destroy(buffer);
  return numbers;
}

}  // namespace

std::unique_ptr<Host> makeVulkanHost(bool validate) {
  return std::make_unique<VulkanHost>(validate);
}

host::VulkanSpec vulkanSpec(const Host& host) {
  return dynamic_cast<const VulkanHost&>(host).spec();
}

MemoryType memoryTypeFor(const host::VulkanSpec& spec,
                         const grisaille_host_memory_request& request) {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(static_cast<VkPhysicalDevice>(spec.physicalDevice),
                                      &properties);
  uint32_t type = 0;
  while ((request.memory_type_bits >> type & 1u) == 0 ||
         (properties.memoryTypes[type].propertyFlags & request.required_flags) !=
             request.required_flags) {
    ++type;
  }
  return {.index = type,
          .mappable = (properties.memoryTypes[type].propertyFlags &
                       VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0};
}

int allocateFor(const host::VulkanSpec& spec, const grisaille_host_memory_request& request,
                grisaille_host_memory& out) {
  const auto device = static_cast<VkDevice>(spec.device);
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = request.size;
  const MemoryType type = memoryTypeFor(spec, request);
  info.memoryTypeIndex = type.index;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  const VkResult made = vkAllocateMemory(device, &info, nullptr, &memory);
  if (made != VK_SUCCESS) return made;
  out.memory = host::number(memory);
  if (!type.mappable) return VK_SUCCESS;
  return vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &out.mapped);
}

void useLayout(Host& host, uint32_t layout) {
  dynamic_cast<VulkanHost&>(host).home = static_cast<VkImageLayout>(layout);
}

}  // namespace grisaille::tests
