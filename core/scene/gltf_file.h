// SPDX-License-Identifier: MIT
// The file side of glTF: bytes from disk, checked far enough that tinygltf can parse them safely.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
struct Image;
}  // namespace tinygltf

namespace grisaille::scene {

// Bounds on what one file may make us allocate.
constexpr uint64_t kMaxVertices = uint64_t{1} << 26;
constexpr uint64_t kMaxIndices = uint64_t{1} << 28;
constexpr uint64_t kMaxInstances = uint64_t{1} << 22;
// Of one accessor that has no bytes in the file, which are zeros.
constexpr uint64_t kMaxZeroElements = uint64_t{1} << 22;

// Parses .gltf or .glb. Images are left where they are: see imageBytes(). Throws kSceneUnreadable,
// kSceneInvalid, kSceneExtension, kSceneTooLarge.
void readModel(const std::string& path, tinygltf::Model& model);

// The encoded bytes of an image that readModel() met, wherever it is held. `path` is the glTF
// file's. Throws kSceneInvalid, kSceneImage.
std::vector<std::byte> imageBytes(const std::string& path, const tinygltf::Model& model, int image);

}  // namespace grisaille::scene
