// SPDX-License-Identifier: MIT
#include "backends/vulkan/api.h"

namespace grisaille::vulkan {
namespace {

const char* nameOf(VkResult result) {
  switch (result) {
#define GRISAILLE_CASE(name) \
  case name:                 \
    return #name;
    GRISAILLE_CASE(VK_NOT_READY)
    GRISAILLE_CASE(VK_TIMEOUT)
    GRISAILLE_CASE(VK_INCOMPLETE)
    GRISAILLE_CASE(VK_ERROR_OUT_OF_HOST_MEMORY)
    GRISAILLE_CASE(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    GRISAILLE_CASE(VK_ERROR_INITIALIZATION_FAILED)
    GRISAILLE_CASE(VK_ERROR_DEVICE_LOST)
    GRISAILLE_CASE(VK_ERROR_MEMORY_MAP_FAILED)
    GRISAILLE_CASE(VK_ERROR_LAYER_NOT_PRESENT)
    GRISAILLE_CASE(VK_ERROR_EXTENSION_NOT_PRESENT)
    GRISAILLE_CASE(VK_ERROR_FEATURE_NOT_PRESENT)
    GRISAILLE_CASE(VK_ERROR_INCOMPATIBLE_DRIVER)
    GRISAILLE_CASE(VK_ERROR_TOO_MANY_OBJECTS)
    GRISAILLE_CASE(VK_ERROR_FORMAT_NOT_SUPPORTED)
    GRISAILLE_CASE(VK_ERROR_FRAGMENTED_POOL)
    GRISAILLE_CASE(VK_ERROR_OUT_OF_POOL_MEMORY)
    GRISAILLE_CASE(VK_ERROR_FRAGMENTATION)
    GRISAILLE_CASE(VK_ERROR_INVALID_SHADER_NV)
    GRISAILLE_CASE(VK_ERROR_UNKNOWN)
    GRISAILLE_CASE(VK_ERROR_SURFACE_LOST_KHR)
    GRISAILLE_CASE(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR)
    GRISAILLE_CASE(VK_ERROR_OUT_OF_DATE_KHR)
    GRISAILLE_CASE(VK_SUBOPTIMAL_KHR)
#undef GRISAILLE_CASE
    default:
      return "an unlisted VkResult";
  }
}

ErrorId idOf(VkResult result, ErrorId otherwise) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return ErrorId::kOutOfDeviceMemory;
    case VK_ERROR_DEVICE_LOST:
      return ErrorId::kDeviceLost;
    default:
      return otherwise;
  }
}

}  // namespace

void check(VkResult result, std::string_view what, ErrorId otherwise) {
  if (result == VK_SUCCESS) return;
  throw Error(idOf(result, otherwise), "{} returned {} ({})", what, nameOf(result),
              static_cast<int>(result));
}

}  // namespace grisaille::vulkan
