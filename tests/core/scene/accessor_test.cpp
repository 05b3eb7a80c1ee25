// SPDX-License-Identifier: MIT
// glTF can store the same numbers in many ways; each must load to the same values.
#include <limits>

#include "tests/core/scene/gltf_builder.h"
#include "tests/support/expect_error.h"

namespace grisaille::scene {
namespace {

// Value of a stored number by the glTF specification.
template <typename T>
float meaning(T stored, bool normalized) {
  if constexpr (std::is_same_v<T, float>) {
    return stored;
  } else {
    if (!normalized) return static_cast<float>(stored);
    const float scaled =
        static_cast<float>(stored) / static_cast<float>(std::numeric_limits<T>::max());
    return scaled < -1 ? -1.0f : scaled;
  }
}

template <typename T>
std::vector<T> extremes() {
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_same_v<T, float>) {
    return {0, 1, -1, 0.25f, -1e6f, 1e6f, 3, 5, 7, 11, 13, 17};
  } else {
    return {Limits::min(), Limits::max(), 0, 1, 2, 3, 5, 7, 11, 13, T(Limits::max() / 2), 100};
  }
}

enum class Storage { kPacked, kStrided, kSparse, kSparseOnZeros };

template <typename T>
class Accessors : public SceneFiles {
 protected:
  // Stores four elements of three numbers with this storage; returns the accessor.
  int store(Gltf& gltf, const std::vector<T>& values, Storage storage, bool normalized) {
    const size_t element = 3 * sizeof(T);
    json entry{{"componentType", Gltf::componentType<T>()},
               {"count", 4},
               {"type", "VEC3"},
               {"normalized", normalized}};
    std::vector<T> dense = values;
    if (storage == Storage::kStrided) {
      const size_t stride = (element + 3) / 4 * 4 + 8;
      std::string spread(3 * stride + element + 4, '\x7f');
      for (size_t i = 0; i < 4; ++i) {
        std::memcpy(&spread[4 + i * stride], &values[i * 3], element);
      }
      entry["bufferView"] = gltf.view(spread.data(), spread.size(), stride);
      entry["byteOffset"] = 4;
    } else if (storage == Storage::kSparseOnZeros) {
      dense.assign(dense.size(), T{});
    } else {
      if (storage == Storage::kSparse) {
        for (size_t i : {3, 4, 5, 9, 10, 11}) dense[i] = T{42};
      }
      entry["bufferView"] = gltf.view(dense.data(), dense.size() * sizeof(T));
    }
    if (storage == Storage::kSparse || storage == Storage::kSparseOnZeros) {
      std::vector<uint16_t> indices;
      std::vector<T> replaced;
      for (uint16_t i = 0; i < 4; ++i) {
        if (storage == Storage::kSparse && i % 2 == 0) continue;
        indices.push_back(i);
        replaced.insert(replaced.end(), values.begin() + i * 3, values.begin() + i * 3 + 3);
      }
      entry["sparse"] = {
          {"count", indices.size()},
          {"indices",
           {{"bufferView", gltf.view(indices.data(), indices.size() * 2)},
            {"componentType", 5123}}},
          {"values", {{"bufferView", gltf.view(replaced.data(), replaced.size() * sizeof(T))}}}};
    }
    gltf.document["accessors"].push_back(entry);
    return static_cast<int>(gltf.document["accessors"].size()) - 1;
  }
};

using ComponentTypes = ::testing::Types<float, int8_t, uint8_t, int16_t, uint16_t>;
TYPED_TEST_SUITE(Accessors, ComponentTypes);

TYPED_TEST(Accessors, StorageDoesNotMatter) {
  const std::vector<TypeParam> values = extremes<TypeParam>();
  for (const bool normalized : {false, true}) {
    if (normalized && std::is_same_v<TypeParam, float>) continue;
    for (const Storage storage :
         {Storage::kPacked, Storage::kStrided, Storage::kSparse, Storage::kSparseOnZeros}) {
      Gltf gltf;
      const int positions = this->store(gltf, values, storage, normalized);
      const int indices = gltf.accessor<uint8_t>({0, 1, 2, 1, 2, 3}, 1);
      const int normals = gltf.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
      gltf.primitive() = {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                          {"indices", indices}};
      gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
      const Scene scene = loadGltf(this->put("a.glb", gltf.bytes()));
      ASSERT_EQ(scene.positions.size(), 4u);
      for (int i = 0; i < 12; ++i) {
        EXPECT_EQ(scene.positions[static_cast<size_t>(i / 3)][i % 3],
                  meaning(values[static_cast<size_t>(i)], normalized))
            << i << " normalized " << normalized << " storage " << static_cast<int>(storage);
      }
    }
  }
}

template <typename T>
class Indices : public SceneFiles {};
using IndexTypes = ::testing::Types<uint8_t, uint16_t, uint32_t>;
TYPED_TEST_SUITE(Indices, IndexTypes);

TYPED_TEST(Indices, EveryTypeReads) {
  Gltf gltf = Gltf::triangle();
  gltf.primitive()["indices"] = gltf.accessor<TypeParam>({2, 0, 1, 1, 2, 0}, 1);
  const Scene scene = loadGltf(this->put("a.glb", gltf.bytes()));
  EXPECT_EQ(scene.indices, (std::vector<uint32_t>{2, 0, 1, 1, 2, 0}));
}

TYPED_TEST(Indices, OutOfRangeIsRefused) {
  Gltf gltf = Gltf::triangle();
  gltf.primitive()["indices"] = gltf.accessor<TypeParam>({0, 1, 3}, 1);
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(this->put("a.glb", gltf.bytes())));
  gltf.primitive()["indices"] =
      gltf.accessor<TypeParam>({0, 1, std::numeric_limits<TypeParam>::max()}, 1);
  EXPECT_ERROR(ErrorId::kSceneInvalid, loadGltf(this->put("a.glb", gltf.bytes())));
}

TYPED_TEST(Indices, SparseReplaces) {
  Gltf gltf = Gltf::triangle();
  const int indices = gltf.accessor<TypeParam>({0, 1, 1}, 1);
  const std::vector<uint8_t> where{2};
  const std::vector<TypeParam> what{2};
  gltf.document["accessors"][static_cast<size_t>(indices)]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", gltf.view(where.data(), 1)}, {"componentType", 5121}}},
      {"values", {{"bufferView", gltf.view(what.data(), sizeof(TypeParam))}}}};
  gltf.primitive()["indices"] = indices;
  const Scene scene = loadGltf(this->put("a.glb", gltf.bytes()));
  EXPECT_EQ(scene.indices, (std::vector<uint32_t>{0, 1, 2}));
}

using AccessorFiles = SceneFiles;

TEST_F(AccessorFiles, RangesAreChecked) {
  const auto refused = [&](const char* list, size_t index, const char* key, const json& value,
                           ErrorId id = ErrorId::kSceneInvalid) {
    Gltf gltf = Gltf::triangle();
    gltf.document[list][index][key] = value;
    SCOPED_TRACE(std::string(list) + "." + key + " = " + value.dump());
    EXPECT_ERROR(id, loadGltf(put("a.glb", gltf.bytes())));
  };
  // The buffer holds 72 bytes; the first view covers 36 of them.
  for (const uint64_t bad : {uint64_t{40}, uint64_t{1} << 31, uint64_t{1} << 32, uint64_t{1} << 62,
                             ~uint64_t{0} - 35, ~uint64_t{0}}) {
    refused("bufferViews", 0, "byteOffset", bad);
    refused("bufferViews", 0, "byteLength", bad + 33 < bad ? bad : bad + 33);
    refused("accessors", 0, "byteOffset", bad);
  }
  for (const uint64_t bad : {uint64_t{0}, uint64_t{4}, uint64_t{1000}, uint64_t{1} << 24}) {
    refused("accessors", 0, "count", bad);
  }
  for (const uint64_t bad : {uint64_t{1} << 32, uint64_t{1} << 62, ~uint64_t{0}}) {
    refused("accessors", 0, "count", bad, ErrorId::kSceneTooLarge);
  }
  for (const json& bad : {json(2), json(-2), json(1 << 30)}) {
    refused("accessors", 0, "bufferView", bad);
    refused("bufferViews", 0, "buffer", bad);
  }
  for (const json& bad : {json(5124), json(5125), json(5130), json(0), json(-1), json("float")}) {
    refused("accessors", 0, "componentType", bad);
  }
  for (const char* bad : {"VEC2", "VEC4", "MAT4", "SCALAR", "VEC9", ""}) {
    refused("accessors", 0, "type", bad);
  }
  for (const json& bad : {json(-4), json(4.5), json("4"), json(nullptr)}) {
    for (const char* key : {"byteOffset", "byteLength", "byteStride"}) {
      refused("bufferViews", 0, key, bad);
    }
    refused("accessors", 0, "byteOffset", bad);
    refused("accessors", 0, "count", bad);
  }
  refused("bufferViews", 0, "byteStride", 8);
  refused("bufferViews", 0, "byteStride", 16);
}

TEST_F(AccessorFiles, SparseRangesAreChecked) {
  const auto refused = [&](const json& sparse, uint64_t count, ErrorId id) {
    Gltf gltf = Gltf::triangle();
    json& accessor = gltf.document["accessors"][0];
    accessor.erase("bufferView");
    accessor["count"] = count;
    gltf.document["accessors"][1].erase("bufferView");
    gltf.document["accessors"][1]["count"] = count;
    if (!sparse.is_null()) accessor["sparse"] = sparse;
    SCOPED_TRACE(sparse.dump());
    EXPECT_ERROR(id, loadGltf(put("a.glb", gltf.bytes())));
  };
  const auto sparse = [](json count, int view, int64_t offset, int type) -> json {
    return {{"count", count},
            {"indices", {{"bufferView", view}, {"byteOffset", offset}, {"componentType", type}}},
            {"values", {{"bufferView", 1}}}};
  };
  refused(nullptr, uint64_t{1} << 40, ErrorId::kSceneTooLarge);
  refused(sparse(1, 0, 0, 5125), uint64_t{1} << 40, ErrorId::kSceneTooLarge);
  refused(sparse(4, 0, 0, 5121), 3, ErrorId::kSceneInvalid);
  refused(sparse(0, 0, 0, 5121), 3, ErrorId::kSceneInvalid);
  refused(sparse(-1, 0, 0, 5121), 3, ErrorId::kSceneInvalid);
  refused(sparse(1, 7, 0, 5121), 3, ErrorId::kSceneInvalid);
  refused(sparse(1, 0, -4, 5121), 3, ErrorId::kSceneInvalid);
  refused(sparse(1, 0, 36, 5121), 3, ErrorId::kSceneInvalid);
  refused(sparse(1, 0, 0, 5126), 3, ErrorId::kSceneInvalid);
  refused(sparse(1, 0, 12, 5125), 3, ErrorId::kSceneInvalid);  // the bits of 1.0f as an index
}

TEST_F(AccessorFiles, NumbersThatAreNotFiniteAreRefused) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (const size_t accessor : {0, 1}) {
      Gltf gltf = Gltf::triangle();
      std::memcpy(&gltf.binary[accessor * 36 + 20], &bad, 4);
      try {
        loadGltf(put("a.glb", gltf.bytes()));
        ADD_FAILURE();
      } catch (const Error& error) {
        EXPECT_EQ(error.id(), ErrorId::kSceneInvalid);
        EXPECT_NE(error.detail().find("accessor " + std::to_string(accessor)), std::string::npos);
      }
    }
  }
}

}  // namespace
}  // namespace grisaille::scene
