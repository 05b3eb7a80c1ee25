// SPDX-License-Identifier: MIT
// Typed arrays out of glTF accessors. Every range is checked before anything is read or allocated.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace grisaille::scene {

// All of these throw kSceneInvalid, naming what is out of range or not finite.

std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int bufferView);

// Elements that the accessor claims; they need not exist.
uint64_t accessorCount(const tinygltf::Model& model, int accessor);

// Components of 8 or 16 bits become floats, divided where the accessor says normalized.
std::vector<glm::vec3> readVec3(const tinygltf::Model& model, int accessor);
std::vector<glm::vec2> readVec2(const tinygltf::Model& model, int accessor);

std::vector<uint32_t> readIndices(const tinygltf::Model& model, int accessor);

}  // namespace grisaille::scene
