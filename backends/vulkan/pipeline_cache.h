// SPDX-License-Identifier: MIT
// What the driver made of shaders, kept on disk for the next run: one file for each device and
// driver version in $XDG_CACHE_HOME/grisaille or ~/.cache/grisaille. A file that cannot be read,
// written or trusted is as good as none.
#pragma once

#include <filesystem>

#include "backends/vulkan/context.h"

namespace grisaille::vulkan {

// Whether there is a file: another program's folders are not ours to write in.
enum class CacheFile { kOwn, kNone };

class PipelineCache {
 public:
  PipelineCache(Context& context, CacheFile file);
  ~PipelineCache();  // writes the file if its contents changed
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache handle() const { return cache_; }

 private:
  void save() const;

  Context& context_;
  std::filesystem::path path_;  // empty: there is no place for it
  size_t loadedHash_ = 0;       // of the driver's data as it was read
  VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace grisaille::vulkan
