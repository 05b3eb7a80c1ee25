// SPDX-License-Identifier: MIT
// Keeps the driver's compiled shaders on disk for the next run: one file per device and driver
// version, in $XDG_CACHE_HOME/grisaille or ~/.cache/grisaille. Files that are unreadable or damaged
// are ignored, and so are failures to write.
#pragma once

#include <filesystem>

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

// Whether the cache has a file. Inside another program it has none.
enum class CacheFile { kOwn, kNone };

class PipelineCache {
 public:
  // `foreign`: another program's cache, which is used instead; null: none.
  PipelineCache(Context& context, CacheFile file, VkPipelineCache foreign = VK_NULL_HANDLE);
  ~PipelineCache();  // writes the file if its contents changed
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache handle() const { return foreign_ != VK_NULL_HANDLE ? foreign_ : cache_; }

 private:
  void save() const;

  Context& context_;
  std::filesystem::path path_;  // empty: no file
  size_t loadedHash_ = 0;       // hash of the driver's data after loading
  VkPipelineCache foreign_;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace grisaille::vulkan
