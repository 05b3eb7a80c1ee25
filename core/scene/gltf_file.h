// SPDX-License-Identifier: MIT
// Reads glTF files from disk, and checks them before tinygltf parses them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Image;
}  // namespace tinygltf

namespace grisaille::scene {

// Limits on the memory that one file can make the loader allocate.
constexpr uint64_t kMaxVertices = uint64_t{1} << 26;
constexpr uint64_t kMaxIndices = uint64_t{1} << 28;
constexpr uint64_t kMaxInstances = uint64_t{1} << 22;
// Elements of one accessor without a buffer view: they are all zeros.
constexpr uint64_t kMaxZeroElements = uint64_t{1} << 22;
// Vertices of all morph targets, influences of joints, and numbers of all keys of animations.
constexpr uint64_t kMaxMorphed = uint64_t{1} << 26;
constexpr uint64_t kMaxInfluences = uint64_t{1} << 28;
constexpr uint64_t kMaxKeyValues = uint64_t{1} << 26;
// Bytes that compressed meshes and buffer views become.
constexpr uint64_t kMaxDecodedBytes = uint64_t{1} << 31;

// Parses .gltf or .glb, and decodes compressed meshes and buffer views. Does not read images: see
// imageBytes(). Adds to `notes` what it leaves out. Throws kSceneUnreadable, kSceneInvalid,
// kSceneExtension, kSceneTooLarge.
void readModel(const std::string& path, tinygltf::Model& model, std::vector<std::string>& notes);

// Returns the encoded bytes of an image of `model`, from a buffer view, a data URI or an external
// file. `path`: the glTF file. Throws kSceneInvalid, kSceneImage, kSceneTooLarge.
std::vector<std::byte> imageBytes(const std::string& path, const tinygltf::Model& model, int image);

}  // namespace grisaille::scene
