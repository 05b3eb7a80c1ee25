// SPDX-License-Identifier: MIT
// A scene in memory: triangles, materials, textures, instances. World axes are right-handed with +y
// up; lengths are metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/image/image.h"
#include "core/scene/bounds.h"
#include "core/scene/camera.h"

namespace grisaille::scene {

struct Rig;

enum class Wrap : uint8_t { kRepeat, kClamp, kMirror };

// A texture is either an encoded file, which texelsOf() decodes on demand, or texels. The built-in
// scene holds texels and therefore needs no codec.
struct Texture {
  std::string name;                // for messages
  std::vector<std::byte> encoded;  // PNG, JPEG or WebP
  image::Image8 texels;            // used in place of `encoded` unless empty
  Wrap wrapU = Wrap::kRepeat;
  Wrap wrapV = Wrap::kRepeat;
};

// Returns the texels of a texture; decodes them if necessary. A texture that cannot be decoded is
// one white, opaque texel, and note() says so. Throws kNoCodecs.
image::Image8 texelsOf(const Texture& texture);

// The same for the alpha channel alone, one byte a texel. Needs a quarter of the memory.
image::Alpha8 alphaOf(const Texture& texture);

struct Material {
  std::string name;
  glm::vec4 baseColor = glm::vec4(1);  // linear; multiplies the texture
  int baseColorTexture = -1;           // index into Scene::textures, -1: none
  bool masked = false;                 // texels with alpha below the cutoff are holes
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  // false: back faces are not drawn
};

// A run of Scene::indices with one material.
struct Primitive {
  uint32_t firstIndex = 0;
  uint32_t indexCount = 0;  // a multiple of 3
  uint32_t material = 0;
  bool coloured = false;  // Scene::colours multiply its base colour
};

struct Instance {
  uint32_t primitive = 0;
  glm::dmat4 worldFromObject = glm::dmat4(1);
};

// The vertex arrays have equal lengths, but `colours` may be empty. Indices count from the start of
// the arrays. Counter-clockwise triangles face the viewer, unless the instance's transform mirrors.
struct Scene {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;    // unit
  std::vector<glm::vec2> texCoords;  // (0, 0) is the image's top left corner
  std::vector<glm::vec4> colours;    // linear; empty if no primitive is coloured
  std::vector<uint32_t> indices;
  std::vector<Primitive> primitives;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Instance> instances;
  Bounds bounds;                   // of all instances, in world space
  std::optional<Camera> camera;    // the one that the scene was made for
  std::shared_ptr<const Rig> rig;  // what can move: see rig.h; null: nothing
  uint64_t poses = 0;              // number of calls of pose(); what is made of a pose stores it
  std::vector<std::string> notes;  // what the loader left out or replaced; one line each
};

// The box of each primitive, in object space.
std::vector<Bounds> primitiveBounds(const Scene& scene);

// Sets scene.bounds from its instances.
void computeBounds(Scene& scene);

// The number of triangles of all instances.
uint64_t triangleCount(const Scene& scene);

// Reads glTF 2.0, .gltf or .glb: the default scene, else the first, else all nodes. Skins and morph
// targets are applied; a scene that can move is at rest. Blended materials become masks with a
// cutoff of 0.5. Skips points and lines. Reads only base colour images. Scene::notes says what is
// left out. `progress`: called with the completed fraction, 0 to 1, ascending; may be empty. Throws
// kScene* errors; never returns partial results.
Scene loadGltf(const std::string& path, const std::function<void(double)>& progress = {});

// Writes the scene as one .glb, without its rig: first to a temporary file, which it then renames.
// Textures held as texels become PNGs. Throws kFileUnwritable, kSceneEmpty, kSceneTooLarge.
void writeGlb(const Scene& scene, const std::string& path);

// The built-in scene: an atrium with columns, arches, vases, steps, hanging cloths and alpha-masked
// foliage cards; at least 50,000 triangles. Every machine builds it bit for bit the same.
Scene makeAtrium();

// The scene that a user names: a built-in one (see built_in.h), the atrium where `path` is empty,
// or else the file at `path`, read as loadGltf() reads it. Scene::notes are for the caller to tell.
Scene readScene(const std::string& path, const std::function<void(double)>& progress = {});

// readScene() that hands Scene::notes to note().
Scene loadScene(const std::string& path, const std::function<void(double)>& progress = {});

// The camera of a user who names none: the scene's own, or else framingCamera() for a picture of
// this shape. aspect: width of the picture divided by its height
Camera defaultCamera(const Scene& scene, double aspect);

}  // namespace grisaille::scene
