// SPDX-License-Identifier: MIT
// Reads typed arrays from glTF accessors. Every range is checked before a read or an allocation.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace grisaille::scene {

// All functions throw kSceneInvalid and name the element that is out of range or not finite.
// Those that return vectors also throw kSceneTooLarge.

std::span<const unsigned char> viewBytes(const tinygltf::Model& model, int bufferView);

// The element count that the accessor declares. It is not checked against the buffer.
uint64_t accessorCount(const tinygltf::Model& model, int accessor);

// Components of 8 or 16 bits become floats; those of normalized accessors are divided by the
// largest value of their type.
std::vector<glm::vec3> readVec3(const tinygltf::Model& model, int accessor);
std::vector<glm::vec2> readVec2(const tinygltf::Model& model, int accessor);

std::vector<glm::vec4> readVec4(const tinygltf::Model& model, int accessor);
std::vector<float> readScalars(const tinygltf::Model& model, int accessor);

// Floats only.
std::vector<glm::dmat4> readMat4(const tinygltf::Model& model, int accessor);

// Unsigned components of 8 or 16 bits.
std::vector<glm::uvec4> readJoints(const tinygltf::Model& model, int accessor);

// Whether the accessor's type is VEC3, rather than VEC4.
bool isVec3(const tinygltf::Model& model, int accessor);

std::vector<uint32_t> readIndices(const tinygltf::Model& model, int accessor);

}  // namespace grisaille::scene
