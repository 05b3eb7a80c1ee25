// SPDX-License-Identifier: MIT
// Descriptor sets of one frame.
#pragma once

#include <span>
#include <vector>

#include "backends/vulkan/resources.h"

namespace grisaille::vulkan {

// Sets live until reset(). Pools are added as needed, each twice as large as the last.
class DescriptorPools {
 public:
  explicit DescriptorPools(Context& context) : context_(context) {}
  ~DescriptorPools();
  DescriptorPools(const DescriptorPools&) = delete;
  DescriptorPools& operator=(const DescriptorPools&) = delete;

  VkDescriptorSet allocate(VkDescriptorSetLayout layout);

  // The device has finished with all sets.
  void reset();

 private:
  void addPool();

  Context& context_;
  std::vector<VkDescriptorPool> pools_;
  size_t current_ = 0;
};

// What one draw or dispatch binds.
struct BoundCall {
  const PipelineObject* pipeline = nullptr;
  std::span<const gpu::Binding> bindings;
};

// The textures that `calls`, which share their barriers, read through a sampler and through an
// image at the same subresource. All their sampled views are in the GENERAL layout.
std::vector<gpu::Texture> readBothWays(Resources& resources, std::span<const BoundCall> calls);

// A set with the bindings of every slot. Throws kBindingMissing, kBindingRange, kStaleHandle.
VkDescriptorSet writeSet(Context& context, Resources& resources, DescriptorPools& pools,
                         const BoundCall& call, std::span<const gpu::Texture> general);

}  // namespace grisaille::vulkan
