// SPDX-License-Identifier: MIT
// Allocates and writes the descriptor sets of one frame.
#pragma once

#include <span>
#include <vector>

#include "backends/vulkan/resources.h"

namespace grisaille::vulkan {

// Sets live until reset(). Adds pools as needed, each twice as large as the previous one.
class DescriptorPools {
 public:
  explicit DescriptorPools(Context& context) : context_(context) {}
  ~DescriptorPools();
  DescriptorPools(const DescriptorPools&) = delete;
  DescriptorPools& operator=(const DescriptorPools&) = delete;

  VkDescriptorSet allocate(VkDescriptorSetLayout layout);

  // Adds pools until there are as many as in `other`: the sets of an equal frame then fit.
  void prepareLike(const DescriptorPools& other) {
    while (pools_.size() < other.pools_.size()) addPool();
  }

  // Frees all sets. The device must have finished with them.
  void reset();

 private:
  void addPool();

  Context& context_;
  std::vector<VkDescriptorPool> pools_;
  size_t current_ = 0;
};

// The pipeline and bindings of one draw or dispatch.
struct BoundCall {
  const PipelineObject* pipeline = nullptr;
  std::span<const gpu::Binding> bindings;
};

// The textures that `calls` read both through a sampler and through an image, at the same
// subresource. `calls` share their barriers. All sampled views of these textures need the GENERAL
// layout.
std::vector<gpu::Texture> readBothWays(Resources& resources, std::span<const BoundCall> calls);

// Allocates a set and writes the bindings of every slot. `general`: the textures that
// readBothWays() returns. Throws kBindingMissing, kBindingRange, kStaleHandle.
VkDescriptorSet writeSet(Context& context, Resources& resources, DescriptorPools& pools,
                         const BoundCall& call, std::span<const gpu::Texture> general);

}  // namespace grisaille::vulkan
