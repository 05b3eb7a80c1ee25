// SPDX-License-Identifier: MIT
// Decodes compressed geometry inside a parsed glTF file, so that accessors read it like any other.
#pragma once

namespace tinygltf {
class Model;
}  // namespace tinygltf

namespace grisaille::scene {

// EXT_meshopt_compression: gives each compressed buffer view a buffer of its decoded bytes. Throws
// kSceneInvalid, kSceneTooLarge.
void decodeMeshopt(tinygltf::Model& model);

// KHR_draco_mesh_compression: gives each compressed primitive new accessors. Throws kSceneInvalid,
// kSceneTooLarge.
void decodeDraco(tinygltf::Model& model);

}  // namespace grisaille::scene
