// SPDX-License-Identifier: MIT
#include "backends/vulkan/descriptors.h"

#include <algorithm>
#include <array>

#include "backends/vulkan/barriers.h"

namespace grisaille::vulkan {
namespace {

constexpr uint32_t kFirstSets = 64;
constexpr uint32_t kClasses = 4;

const gpu::Binding& find(const BoundCall& call, const grisaille_shader_slot& slot) {
  for (const gpu::Binding& binding : call.bindings) {
    if (binding.slotClass == slot.slot_class && binding.slot == slot.slot) return binding;
  }
  throw Error(ErrorId::kBindingMissing, "nothing is bound to {}", slot.name);
}

bool overlap(const gpu::TextureView& a, const gpu::TextureView& b) {
  return a.texture == b.texture && a.mip < b.mip + b.mipCount && b.mip < a.mip + a.mipCount &&
         a.layer < b.layer + b.layerCount && b.layer < a.layer + a.layerCount;
}

// Calls visit(view) for every bound view of a class.
template <typename Visit>
void forViews(Resources& resources, std::span<const BoundCall> calls, uint32_t slotClass,
              Visit&& visit) {
  for (const BoundCall& call : calls) {
    for (const grisaille_shader_slot* slot : call.pipeline->slots) {
      if (slot->slot_class == slotClass) visit(resources.resolve(find(call, *slot).view));
    }
  }
}

VkDescriptorImageInfo imageInfo(Resources& resources, const gpu::Binding& binding,
                                const grisaille_shader_slot& slot,
                                std::span<const gpu::Texture> general) {
  const gpu::TextureView view = resources.resolve(binding.view);
  if (slot.arrayed == 0 && view.layerCount != 1) {
    throw Error(ErrorId::kBindingRange, "{} takes one layer, not {}", slot.name, view.layerCount);
  }
  VkDescriptorImageInfo info{};
  info.imageView = resources.viewOf(
      view, slot.arrayed != 0 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
  info.imageLayout = layoutOf(gpu::Access::kStorageRead);
  if (slot.slot_class == GRISAILLE_SLOT_TEXTURE) {
    info.sampler = resources.get(binding.sampler);
    const bool both = std::find(general.begin(), general.end(), view.texture) != general.end();
    if (!both) info.imageLayout = layoutOf(gpu::Access::kSampled);
  }
  return info;
}

}  // namespace

DescriptorPools::~DescriptorPools() {
  for (const VkDescriptorPool pool : pools_) {
    context_.vk.vkDestroyDescriptorPool(context_.device, pool, context_.callbacks);
  }
}

void DescriptorPools::addPool() {
  const uint32_t sets = kFirstSets << std::min<size_t>(pools_.size(), 8);
  std::array<VkDescriptorPoolSize, kClasses> sizes{};
  // Each class has at least GRISAILLE_SLOTS_PER_CLASS descriptors: any set fits into an empty pool.
  for (uint32_t i = 0; i < kClasses; ++i) sizes[i] = {descriptorType(i), sets * 4};
  static_assert(kFirstSets * 4 >= GRISAILLE_SLOTS_PER_CLASS);
  VkDescriptorPoolCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
  info.maxSets = sets;
  info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  pools_.reserve(pools_.size() + 1);
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(context_.vk.vkCreateDescriptorPool(context_.device, &info, context_.callbacks, &pool),
        "vkCreateDescriptorPool");
  pools_.push_back(pool);
}

VkDescriptorSet DescriptorPools::allocate(VkDescriptorSetLayout layout) {
  VkDescriptorSet set = VK_NULL_HANDLE;
  for (;; ++current_) {
    const bool fresh = current_ == pools_.size();
    if (fresh) addPool();
    VkDescriptorSetAllocateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    info.descriptorPool = pools_[current_];
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    const VkResult result = context_.vk.vkAllocateDescriptorSets(context_.device, &info, &set);
    const bool full = result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
    if (full && !fresh) continue;
    check(result, "vkAllocateDescriptorSets");
    return set;
  }
}

void DescriptorPools::reset() {
  for (const VkDescriptorPool pool : pools_) {
    check(context_.vk.vkResetDescriptorPool(context_.device, pool, 0), "vkResetDescriptorPool");
  }
  current_ = 0;
}

// Most calls bind no image, and very few match: the search allocates nothing unless it finds one.
std::vector<gpu::Texture> readBothWays(Resources& resources, std::span<const BoundCall> calls) {
  std::vector<gpu::Texture> found;
  forViews(resources, calls, GRISAILLE_SLOT_IMAGE, [&](const gpu::TextureView& image) {
    forViews(resources, calls, GRISAILLE_SLOT_TEXTURE, [&](const gpu::TextureView& sampled) {
      if (overlap(image, sampled)) found.push_back(sampled.texture);
    });
  });
  return found;
}

VkDescriptorSet writeSet(Context& context, Resources& resources, DescriptorPools& pools,
                         const BoundCall& call, std::span<const gpu::Texture> general) {
  const std::vector<const grisaille_shader_slot*>& slots = call.pipeline->slots;
  std::array<VkDescriptorBufferInfo, kClasses * GRISAILLE_SLOTS_PER_CLASS> buffers{};
  std::array<VkDescriptorImageInfo, kClasses * GRISAILLE_SLOTS_PER_CLASS> images{};
  std::array<VkWriteDescriptorSet, kClasses * GRISAILLE_SLOTS_PER_CLASS> writes{};
  for (size_t i = 0; i < slots.size(); ++i) {
    const grisaille_shader_slot& slot = *slots[i];
    const gpu::Binding& binding = find(call, slot);
    VkWriteDescriptorSet& write = writes[i];
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstBinding = bindingNumber(slot.slot_class, slot.slot);
    write.descriptorCount = 1;
    write.descriptorType = descriptorType(slot.slot_class);
    if (slot.slot_class <= GRISAILLE_SLOT_STORAGE) {
      const gpu::BufferRange range = resources.resolve(binding.buffer);
      buffers[i] = {resources.get(range.buffer).buffer, range.offset, range.size};
      write.pBufferInfo = &buffers[i];
    } else {
      images[i] = imageInfo(resources, binding, slot, general);
      write.pImageInfo = &images[i];
    }
  }
  const VkDescriptorSet set = pools.allocate(call.pipeline->setLayout);
  for (size_t i = 0; i < slots.size(); ++i) writes[i].dstSet = set;
  context.vk.vkUpdateDescriptorSets(context.device, static_cast<uint32_t>(slots.size()),
                                    writes.data(), 0, nullptr);
  return set;
}

}  // namespace grisaille::vulkan
