// SPDX-License-Identifier: MIT
#include "backends/vulkan/memory.h"

#include <algorithm>
#include <array>

namespace grisaille::vulkan {
namespace {

// Properties that memory of a kind must have, and those that it should have.
VkMemoryPropertyFlags requiredOf(MemoryKind kind) {
  return kind == MemoryKind::kDevice
             ? 0
             : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}
VkMemoryPropertyFlags preferredOf(MemoryKind kind) {
  switch (kind) {
    case MemoryKind::kDevice:
      return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    case MemoryKind::kReadback:
      return VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    default:
      return 0;
  }
}

}  // namespace

void Allocator::open(Device device, MemorySource* source) {
  device_ = std::move(device);
  source_ = source;
}

Memory Allocator::allocate(const Needing& needing, MemoryKind kind) {
  const Memory made = {
      .where = source_ != nullptr ? ofSource(needing, kind) : ofDriver(needing.requirements, kind),
      .size = needing.requirements.size,
      .kind = kind};
  (kind == MemoryKind::kDevice ? use_.deviceBytes : use_.hostBytes) += made.size;
  ++use_.allocations;
  return made;
}

void Allocator::free(const Memory& memory) {
  if (memory.where.memory == 0) return;
  if (source_ != nullptr) {
    source_->release(memory.where);
  } else {
    device_.vk->vkFreeMemory(device_.device, reinterpret_cast<VkDeviceMemory>(memory.where.memory),
                             device_.callbacks);
  }
  (memory.kind == MemoryKind::kDevice ? use_.deviceBytes : use_.hostBytes) -= memory.size;
  --use_.allocations;
}

ForeignMemory Allocator::ofDriver(const VkMemoryRequirements& requirements, MemoryKind kind) {
  const VkPhysicalDeviceMemoryProperties& memory = device_.memory;
  const auto find = [&](VkMemoryPropertyFlags flags) {
    uint32_t type = 0;
    while (type < memory.memoryTypeCount &&
           ((requirements.memoryTypeBits >> type & 1u) == 0 ||
            (memory.memoryTypes[type].propertyFlags & flags) != flags)) {
      ++type;
    }
    return type;
  };
  uint32_t type = find(requiredOf(kind) | preferredOf(kind));
  if (type == memory.memoryTypeCount) type = find(requiredOf(kind));
  if (type == memory.memoryTypeCount) {
    throw Error(ErrorId::kDeviceFailed, "{} has no memory type that fits the resource",
                device_.name);
  }
  const uint64_t heap = memory.memoryHeaps[memory.memoryTypes[type].heapIndex].size;
  if (requirements.size > std::min(heap, device_.maxBytes)) {
    throw Error(ErrorId::kOutOfDeviceMemory, "{} bytes are more than {} allocates at once",
                requirements.size, device_.name);
  }
  if (use_.allocations >= device_.maxAllocations) {
    throw Error(ErrorId::kTooManyResources, "{} allows {} memory allocations", device_.name,
                device_.maxAllocations);
  }
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = type;
  VkDeviceMemory made = VK_NULL_HANDLE;
  check(device_.vk->vkAllocateMemory(device_.device, &info, device_.callbacks, &made),
        "vkAllocateMemory");
  ForeignMemory where = {.memory = reinterpret_cast<uint64_t>(made)};
  if (kind == MemoryKind::kDevice) return where;
  const VkResult mapped =
      device_.vk->vkMapMemory(device_.device, made, 0, VK_WHOLE_SIZE, 0, &where.mapped);
  if (mapped != VK_SUCCESS) device_.vk->vkFreeMemory(device_.device, made, device_.callbacks);
  check(mapped, "vkMapMemory");
  return where;
}

ForeignMemory Allocator::ofSource(const Needing& needing, MemoryKind kind) {
  std::array<char, 64> label = {};
  std::copy_n(needing.label.begin(), std::min(needing.label.size(), label.size() - 1),
              label.begin());
  const ForeignMemoryRequest request = {.size = needing.requirements.size,
                                        .alignment = needing.requirements.alignment,
                                        .typeBits = needing.requirements.memoryTypeBits,
                                        .requiredFlags = requiredOf(kind),
                                        .preferredFlags = preferredOf(kind),
                                        .buffer = reinterpret_cast<uint64_t>(needing.buffer),
                                        .image = reinterpret_cast<uint64_t>(needing.image),
                                        .label = label.data()};
  ForeignMemory where;
  check(static_cast<VkResult>(source_->allocate(request, where)), "the host's memory function");
  const char* wrong = nullptr;
  if (where.memory == 0) wrong = "no VkDeviceMemory";
  if (where.offset % request.alignment != 0) wrong = "an offset that is not aligned";
  if (kind != MemoryKind::kDevice && where.mapped == nullptr) wrong = "memory that is not mapped";
  if (wrong == nullptr) return where;
  if (where.memory != 0) source_->release(where);
  throw Error(ErrorId::kHostValue,
              "the host's memory function returned {} (memory {:#x}, offset {}) for '{}', {} bytes "
              "with an alignment of {}",
              wrong, where.memory, where.offset, label.data(), request.size, request.alignment);
}

}  // namespace grisaille::vulkan
