// SPDX-License-Identifier: MIT
#include "backends/vulkan/pipeline_cache.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <string>

#include "core/base/regular_file.h"

namespace grisaille::vulkan {
namespace {

namespace fs = std::filesystem;

// The file holds this preamble, then the driver's data. The hash detects damage, because a driver
// may crash on damaged data.
struct Preamble {
  uint64_t magic = 0x3165686361637267;  // "grcache1"
  uint64_t bytes = 0;                   // of the data
  uint64_t hash = 0;                    // of the data
};

size_t hashOf(const std::string& data) {
  return std::hash<std::string>{}(data);
}

fs::path folder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && cache[0] == '/') return fs::path(cache) / "grisaille";
  const char* home = std::getenv("HOME");
  if (home != nullptr && home[0] == '/') return fs::path(home) / ".cache" / "grisaille";
  return {};
}

fs::path fileOf(const VkPhysicalDeviceProperties& properties) {
  const fs::path beside = folder();
  if (beside.empty()) return {};
  std::string name = "vulkan-";
  for (const uint8_t byte : properties.pipelineCacheUUID) name += fmt::format("{:02x}", byte);
  return beside / fmt::format("{}-{:08x}.cache", name, properties.driverVersion);
}

bool madeFor(const VkPhysicalDeviceProperties& properties, const std::string& data) {
  VkPipelineCacheHeaderVersionOne header{};
  if (data.size() < sizeof(header)) return false;
  std::memcpy(&header, data.data(), sizeof(header));
  return header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
         header.vendorID == properties.vendorID && header.deviceID == properties.deviceID &&
         std::memcmp(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

// Reads the driver's data; "" if the file is incomplete or belongs to another device.
std::string load(const fs::path& path, const VkPhysicalDeviceProperties& properties) {
  if (!whyNotRegular(path).empty()) return "";
  std::ifstream file(path, std::ios::binary);
  Preamble preamble;
  const Preamble expected;
  if (!file.read(reinterpret_cast<char*>(&preamble), sizeof(preamble))) return "";
  std::error_code failed;
  const uint64_t size = fs::file_size(path, failed);
  if (failed || preamble.magic != expected.magic || size - sizeof(preamble) != preamble.bytes) {
    return "";
  }
  std::string data(preamble.bytes, '\0');
  if (!file.read(data.data(), static_cast<std::streamsize>(data.size()))) return "";
  return hashOf(data) == preamble.hash && madeFor(properties, data) ? data : "";
}

bool write(const fs::path& path, const std::string& data) {
  const Preamble preamble{.bytes = data.size(), .hash = hashOf(data)};
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(&preamble), sizeof(preamble));
  file.write(data.data(), static_cast<std::streamsize>(data.size()));
  file.close();
  return !file.fail();
}

}  // namespace

PipelineCache::PipelineCache(Context& context, CacheFile file, VkPipelineCache foreign)
    : context_(context),
      path_(file == CacheFile::kOwn ? fileOf(context.properties) : ""),
      foreign_(foreign) {
  if (foreign_ != VK_NULL_HANDLE) return;
  const std::string data = path_.empty() ? "" : load(path_, context.properties);
  if (!data.empty()) loadedHash_ = hashOf(data);
  VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  // Data with only a header is useless. SwiftShader would also append another header to it, and the
  // file would grow from run to run.
  if (data.size() > sizeof(VkPipelineCacheHeaderVersionOne)) {
    info.initialDataSize = data.size();
    info.pInitialData = data.data();
  }
  check(context_.vk.vkCreatePipelineCache(context_.device, &info, context_.callbacks, &cache_),
        "vkCreatePipelineCache");
}

PipelineCache::~PipelineCache() {
  try {
    save();
  } catch (const std::exception&) {
    // Without the file, the next run compiles the shaders again.
  }
  context_.vk.vkDestroyPipelineCache(context_.device, cache_, context_.callbacks);
}

void PipelineCache::save() const {
  if (path_.empty()) return;
  const auto get = context_.vk.vkGetPipelineCacheData;
  size_t size = 0;
  if (get(context_.device, cache_, &size, nullptr) != VK_SUCCESS) return;
  std::string data(size, '\0');
  if (get(context_.device, cache_, &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);
  if (hashOf(data) == loadedHash_) return;

  std::error_code failed;
  fs::create_directories(path_.parent_path(), failed);
  fs::path aside = path_;
  aside += fmt::format(".{}.{}", getpid(), static_cast<const void*>(this));
  if (write(aside, data)) fs::rename(aside, path_, failed);
  fs::remove(aside, failed);
}

}  // namespace grisaille::vulkan
