// SPDX-License-Identifier: MIT
// A scene in memory: triangles, materials, textures, instances. World axes are right-handed with +y
// up; lengths are metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"
#include "core/scene/bounds.h"
#include "core/scene/camera.h"

namespace grisaille::scene {

enum class Wrap : uint8_t { kRepeat, kClamp, kMirror };

// As a file holds it, to be decoded only by who needs it; or its texels, so that the built-in scene
// needs no codec.
struct Texture {
  std::string name;                // for messages
  std::vector<std::byte> encoded;  // PNG or JPEG
  image::Image8 texels;            // where it has any, in place of `encoded`
  Wrap wrapU = Wrap::kRepeat;
  Wrap wrapV = Wrap::kRepeat;
};

// Throws as image::decode().
image::Image8 texelsOf(const Texture& texture);

struct Material {
  std::string name;
  glm::vec4 baseColor = glm::vec4(1);  // linear; multiplies the texture
  int baseColorTexture = -1;           // index into Scene::textures, -1: none
  bool masked = false;                 // texels with alpha under the cutoff are holes
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  // else back faces are not drawn
};

// A run of Scene::indices with one material.
struct Primitive {
  uint32_t firstIndex = 0;
  uint32_t indexCount = 0;  // a multiple of 3
  uint32_t material = 0;
};

struct Instance {
  uint32_t primitive = 0;
  glm::dmat4 worldFromObject = glm::dmat4(1);
};

// Vertex arrays are of equal length. Indices count from the arrays' start. Counter-clockwise
// triangles face the viewer, unless the instance's transform mirrors.
struct Scene {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;    // unit
  std::vector<glm::vec2> texCoords;  // (0, 0) is the image's top left corner
  std::vector<uint32_t> indices;
  std::vector<Primitive> primitives;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Instance> instances;
  Bounds bounds;                 // of all instances, world
  std::optional<Camera> camera;  // the one that the scene was made for
};

// Sets scene.bounds from its instances.
void computeBounds(Scene& scene);

// Triangles of all instances.
uint64_t triangleCount(const Scene& scene);

// Reads glTF 2.0, .gltf or .glb: the default scene, else the first, else all nodes. Blended
// materials become masks with a cutoff of 0.5; points and lines are left out; skins, morph targets
// and animations are not applied. Only base colour images are read. `progress` is told the share
// that is done, 0 to 1, ascending. Throws kScene* errors; never partial results.
Scene loadGltf(const std::string& path, const std::function<void(double)>& progress = {});

// Writes the scene as one .glb, aside and then renamed; textures that are texels become PNGs.
// Throws kFileUnwritable, kSceneEmpty, kSceneTooLarge, kNoCodecs.
void writeGlb(const Scene& scene, const std::string& path);

// The built-in scene: an atrium of columns, arches, vases, steps, a hanging cloth and foliage cards
// with an alpha mask, at least 50,000 triangles. The same on every machine, to the bit.
Scene makeAtrium();

// The scene that a user names: the file at `path`, read as loadGltf() reads it, or the atrium where
// `path` is empty.
Scene loadScene(const std::string& path, const std::function<void(double)>& progress = {});

// The camera of a user who names none: the scene's own, or else one that sees all of it.
Camera defaultCamera(const Scene& scene);

}  // namespace grisaille::scene
