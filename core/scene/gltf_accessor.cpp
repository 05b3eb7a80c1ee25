// SPDX-License-Identifier: MIT
#include "core/scene/gltf_accessor.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/base/error.h"
#include "core/scene/gltf_file.h"

namespace grisaille::scene {
namespace {

// `count` elements inside a buffer, `stride` bytes apart, of any alignment.
struct Elements {
  const unsigned char* first = nullptr;
  size_t stride = 0;
  size_t count = 0;
};

const tinygltf::Accessor& accessorAt(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<size_t>(index) >= model.accessors.size()) {
    throw Error(ErrorId::kSceneInvalid, "accessor {} does not exist", index);
  }
  return model.accessors[static_cast<size_t>(index)];
}

// Checks a range of a buffer view and returns it. The stride is the view's; without one, elements
// are packed.
Elements elementsOf(const tinygltf::Model& model, int accessor, int view, uint64_t offset,
                    uint64_t count, size_t elementSize) {
  const std::span<const unsigned char> bytes = viewBytes(model, view);
  const size_t given = model.bufferViews[static_cast<size_t>(view)].byteStride;
  const size_t stride = given == 0 ? elementSize : given;
  const bool fits = stride >= elementSize && count > 0 && offset <= bytes.size() &&
                    bytes.size() - offset >= elementSize &&
                    (bytes.size() - offset - elementSize) / stride >= count - 1;
  if (!fits) {
    throw Error(ErrorId::kSceneInvalid,
                "accessor {}: {} elements of {} bytes do not fit in buffer view {}", accessor,
                count, elementSize, view);
  }
  return {.first = bytes.data() + offset, .stride = stride, .count = static_cast<size_t>(count)};
}

template <typename T>
T load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);  // NOLINT(clang-analyzer-core.NonNullParamChecker)
  return value;
}

template <typename T>
float toFloat(T value, bool normalized) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    const auto number = static_cast<float>(value);
    if (!normalized) return number;
    return std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  }
}

// Calls `f` with a value of the component's C++ type.
template <typename F>
void withType(int accessor, int componentType, F&& f) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return f(int8_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return f(uint8_t{});
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return f(int16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return f(uint16_t{});
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return f(uint32_t{});
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return f(float{});
    default:
      throw Error(ErrorId::kSceneInvalid, "accessor {}: component type {} cannot be used here",
                  accessor, componentType);
  }
}

void requireType(int accessor, bool good) {
  if (!good) {
    throw Error(ErrorId::kSceneInvalid, "accessor {}: its type is not allowed here", accessor);
  }
}

std::vector<uint32_t> readIntegers(int accessor, int componentType, const Elements& elements) {
  std::vector<uint32_t> result(elements.count);
  withType(accessor, componentType, [&]<typename T>(T) {
    requireType(accessor, std::is_unsigned_v<T>);
    for (size_t i = 0; i < elements.count; ++i) {
      // Only unsigned types come here. NOLINTNEXTLINE(bugprone-signed-char-misuse)
      result[i] = static_cast<uint32_t>(load<T>(elements.first + i * elements.stride));
    }
  });
  return result;
}

// The elements of a sparse accessor that are replaced, and their new values.
struct Replacement {
  std::vector<uint32_t> indices;
  Elements values;
};

Replacement replacementOf(const tinygltf::Model& model, int index, size_t elementSize) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  const auto& sparse = accessor.sparse;
  if (!sparse.isSparse) return {};
  if (sparse.count < 1 || static_cast<uint64_t>(sparse.count) > accessor.count) {
    throw Error(ErrorId::kSceneInvalid, "accessor {}: its sparse count is out of range", index);
  }
  const auto count = static_cast<uint64_t>(sparse.count);
  size_t indexSize = 0;
  withType(index, sparse.indices.componentType, [&]<typename T>(T) { indexSize = sizeof(T); });
  const Elements indices =
      elementsOf(model, index, sparse.indices.bufferView,
                 static_cast<uint64_t>(sparse.indices.byteOffset), count, indexSize);
  Replacement result{
      .indices = readIntegers(index, sparse.indices.componentType, indices),
      .values = elementsOf(model, index, sparse.values.bufferView,
                           static_cast<uint64_t>(sparse.values.byteOffset), count, elementSize)};
  for (const uint32_t i : result.indices) {
    if (i >= accessor.count) {
      throw Error(ErrorId::kSceneInvalid,
                  "accessor {}: sparse index {} is out of range for {} elements", index, i,
                  accessor.count);
    }
  }
  return result;
}

// Returns the elements of the dense part. Returns none if the accessor has no buffer view: its
// elements are then zeros.
Elements denseOf(const tinygltf::Model& model, int index, size_t elementSize) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  if (accessor.bufferView != -1) {
    return elementsOf(model, index, accessor.bufferView, accessor.byteOffset, accessor.count,
                      elementSize);
  }
  // No buffer limits this count.
  if (accessor.count > kMaxZeroElements) {
    throw Error(ErrorId::kSceneTooLarge,
                "accessor {}: {} elements without a buffer; the limit is {}", index, accessor.count,
                kMaxZeroElements);
  }
  if (accessor.count == 0) throw Error(ErrorId::kSceneInvalid, "accessor {} is empty", index);
  return {};
}

// Reads floats of `components` per element into the memory that `allocate(count)` returns. Elements
// that the accessor leaves out are zeros.
template <typename Allocate>
void readFloatsInto(const tinygltf::Model& model, int index, size_t components,
                    Allocate&& allocate) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  float* result = nullptr;
  withType(index, accessor.componentType, [&]<typename T>(T) {
    requireType(index, !std::is_same_v<T, uint32_t>);
    const Elements dense = denseOf(model, index, sizeof(T) * components);
    const Replacement sparse = replacementOf(model, index, sizeof(T) * components);
    result = allocate(accessor.count);
    const auto convert = [&](const Elements& from, size_t i, size_t to) {
      const unsigned char* at = from.first + i * from.stride;
      for (size_t c = 0; c < components; ++c) {
        result[to * components + c] = toFloat(load<T>(at + c * sizeof(T)), accessor.normalized);
      }
    };
    for (size_t i = 0; i < dense.count; ++i) convert(dense, i, i);
    for (size_t i = 0; i < sparse.indices.size(); ++i) convert(sparse.values, i, sparse.indices[i]);
  });
  for (size_t i = 0; i < accessor.count * components; ++i) {
    if (std::isfinite(result[i])) continue;
    throw Error(ErrorId::kSceneInvalid, "accessor {}: element {} is not finite", index,
                i / components);
  }
}

template <typename Vec>
std::vector<Vec> readVectors(const tinygltf::Model& model, int index, int type) {
  requireType(index, accessorAt(model, index).type == type);
  std::vector<Vec> result;
  readFloatsInto(model, index, static_cast<size_t>(Vec::length()), [&](size_t count) {
    result.resize(count, Vec(0));
    return &result[0][0];
  });
  return result;
}

std::vector<float> flatten(const tinygltf::Model& model, int index, int type, size_t components) {
  requireType(index, accessorAt(model, index).type == type);
  std::vector<float> result;
  readFloatsInto(model, index, components, [&](size_t count) {
    result.resize(count * components, 0.0f);
    return result.data();
  });
  return result;
}

}  // namespace

std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int bufferView) {
  if (bufferView < 0 || static_cast<size_t>(bufferView) >= model.bufferViews.size()) {
    throw Error(ErrorId::kSceneInvalid, "buffer view {} does not exist", bufferView);
  }
  const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(bufferView)];
  if (view.buffer < 0 || static_cast<size_t>(view.buffer) >= model.buffers.size()) {
    throw Error(ErrorId::kSceneInvalid, "buffer view {}: buffer {} does not exist", bufferView,
                view.buffer);
  }
  const auto& data = model.buffers[static_cast<size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    throw Error(ErrorId::kSceneInvalid,
                "buffer view {}: {} bytes at offset {} exceed its buffer of {}", bufferView,
                view.byteLength, view.byteOffset, data.size());
  }
  return std::span(data).subspan(view.byteOffset, view.byteLength);
}

uint64_t accessorCount(const tinygltf::Model& model, int accessor) {
  return accessorAt(model, accessor).count;
}

std::vector<glm::vec3> readVec3(const tinygltf::Model& model, int accessor) {
  return readVectors<glm::vec3>(model, accessor, TINYGLTF_TYPE_VEC3);
}

std::vector<glm::vec2> readVec2(const tinygltf::Model& model, int accessor) {
  return readVectors<glm::vec2>(model, accessor, TINYGLTF_TYPE_VEC2);
}

std::vector<glm::vec4> readVec4(const tinygltf::Model& model, int accessor) {
  return readVectors<glm::vec4>(model, accessor, TINYGLTF_TYPE_VEC4);
}

std::vector<float> readScalars(const tinygltf::Model& model, int accessor) {
  return flatten(model, accessor, TINYGLTF_TYPE_SCALAR, 1);
}

std::vector<glm::dmat4> readMat4(const tinygltf::Model& model, int accessor) {
  requireType(accessor, accessorAt(model, accessor).componentType == TINYGLTF_COMPONENT_TYPE_FLOAT);
  const std::vector<float> numbers = flatten(model, accessor, TINYGLTF_TYPE_MAT4, 16);
  std::vector<glm::dmat4> result(numbers.size() / 16);
  for (size_t i = 0; i < numbers.size(); ++i) {
    const auto within = static_cast<int>(i % 16);
    result[i / 16][within / 4][within % 4] = numbers[i];
  }
  return result;
}

std::vector<glm::uvec4> readJoints(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  requireType(index, accessor.type == TINYGLTF_TYPE_VEC4 && !accessor.normalized &&
                         (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT));
  // Numbers of 16 bits fit a float.
  const std::vector<glm::vec4> numbers = readVec4(model, index);
  return {numbers.begin(), numbers.end()};
}

bool isVec3(const tinygltf::Model& model, int accessor) {
  return accessorAt(model, accessor).type == TINYGLTF_TYPE_VEC3;
}

std::vector<uint32_t> readIndices(const tinygltf::Model& model, int index) {
  const tinygltf::Accessor& accessor = accessorAt(model, index);
  requireType(index, accessor.type == TINYGLTF_TYPE_SCALAR && !accessor.normalized);
  size_t size = 0;
  withType(index, accessor.componentType, [&]<typename T>(T) { size = sizeof(T); });
  const Elements dense = denseOf(model, index, size);
  const Replacement sparse = replacementOf(model, index, size);
  std::vector<uint32_t> result(accessor.count, 0);
  if (dense.count > 0) result = readIntegers(index, accessor.componentType, dense);
  if (!sparse.indices.empty()) {
    const auto values = readIntegers(index, accessor.componentType, sparse.values);
    for (size_t i = 0; i < values.size(); ++i) result[sparse.indices[i]] = values[i];
  }
  return result;
}

}  // namespace grisaille::scene
