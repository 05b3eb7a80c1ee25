// SPDX-License-Identifier: MIT
// A scene on the device, and the render call that draws it. Normals, texture coordinates, vertex
// colours and textures are uploaded by the first draw that needs them, and take no memory before.
// After scene::pose(), the next draw uploads the vertices that moved.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/gpu/device.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"
#include "core/trace/scene_matter.h"

namespace grisaille::frame {

// The sides of surfaces that a draw behind an earlier depth writes. It leaves out triangles that
// are buried in matter (core/trace/buried.h): none of them begins or ends it.
enum class SceneSides {
  // At or behind that depth, where matter may end: the far sides of closed bodies
  // (core/scene/bodies.h), both sides of other double-sided triangles, and all that face away.
  kFar,
  // Behind that depth, where matter may begin: the near sides of closed bodies, both sides of other
  // double-sided triangles, and all that face the camera.
  kNear
};

// The targets of one draw; all but depth may be null.
struct SceneTargets {
  gpu::Texture depth;             // kD32Float
  gpu::Texture normal = {};       // kRgba16Float
  gpu::Texture baseColour = {};   // kRgba8Srgb
  gpu::Texture facetNormal = {};  // kRgba16Float
  gpu::Texture thickness = {};    // kR32Float; only with a normal
  // kD32Float: the depth of an earlier draw. If not null, the draw writes only depth: of the
  // `sides` behind that depth.
  gpu::Texture front = {};
  SceneSides sides = SceneSides::kFar;
};

class SceneResources {
 public:
  // Device and scene must outlive this. The scene may change only between draws, by scene::pose().
  // matter: that of the scene, must outlive this; null: found by the first draw that needs it
  SceneResources(gpu::Device& device, const scene::Scene& scene,
                 trace::SceneMatter* matter = nullptr);
  ~SceneResources();
  SceneResources(const SceneResources&) = delete;
  SceneResources& operator=(const SceneResources&) = delete;

  // Draws every instance that may be visible. Call it inside a pass.
  void draw(gpu::Commands& commands, const scene::View& view, const SceneTargets& targets);

  // Buffers of the scene's positions, in its present pose, and indices; uploaded if necessary.
  gpu::Buffer positions(gpu::Commands& commands);
  gpu::Buffer indices(gpu::Commands& commands);
  // The box of each primitive in the present pose, in object space.
  const std::vector<scene::Bounds>& primitiveBounds();

 private:
  // The inputs and outputs that a draw needs.
  struct Variant {
    bool facet = false, normal = false, base = false, mask = false;
    bool colour = false;     // of vertices; only with a base or a mask
    bool thickness = false;  // only with a normal
    uint32_t behind = 0;     // BEHIND of shaders/scene/geometry.frag: 0, or 1 + SceneSides

    bool uv() const { return base || mask; }
    // Indices into the lists of shaders/geometry_variants.h.
    size_t vertex() const {
      return (thickness ? 16u : 0u) + (facet ? 8u : 0u) + (normal ? 4u : 0u) + (uv() ? 2u : 0u) +
             (colour ? 1u : 0u);
    }
    size_t fragment() const {
      return (behind > 0 ? 60u + 4u * behind : 0u) + (thickness ? 32u : 0u) + (facet ? 16u : 0u) +
             (normal ? 8u : 0u) + (base ? 4u : 0u) + (mask ? 2u : 0u) + (colour ? 1u : 0u);
    }
  };
  // A scene texture on the device: only its alpha, or its colour with mip levels.
  struct DeviceTexture {
    gpu::Texture alpha, colour;
  };

  // The indices that a draw of far sides reads: of each primitive, first the triangles of
  // double-sided bodies, then the others, without those that are buried in matter.
  struct FarSides {
    struct Run {
      uint32_t bodies, others;  // number of indices of such triangles
    };
    gpu::Buffer indices;    // null: the scene's own
    std::vector<Run> runs;  // one per primitive, from its first index
  };

  // Vertices that scene::pose() writes, as they are in pose number `poses` of the scene.
  struct PosedVertices {
    gpu::Buffer buffer;
    uint64_t poses = 0;
  };

  gpu::Buffer vertexBuffer(gpu::Commands& commands, gpu::Buffer& buffer, const char* label,
                           std::span<const std::byte> bytes, gpu::BufferUsage usage);
  gpu::Buffer posed(gpu::Commands& commands, PosedVertices& vertices, const char* label,
                    const std::vector<glm::vec3>& values);
  gpu::Buffer thickness(gpu::Commands& commands);
  // The factor on that thickness for an instance of a primitive.
  float chordScale(uint32_t primitive, const glm::dmat3& linear);
  const FarSides& farSides(gpu::Commands& commands);
  gpu::GraphicsPipeline pipeline(Variant variant);
  gpu::Texture texture(gpu::Commands& commands, const scene::Material& material, bool base);
  gpu::Sampler sampler(const scene::Material& material, bool base);

  gpu::Device& device_;
  const scene::Scene& scene_;
  trace::SceneMatter ownMatter_;
  trace::SceneMatter& matter_;
  PosedVertices positions_, normals_;
  gpu::Buffer texCoords_, colours_, thickness_, indices_;
  std::optional<FarSides> farSides_;                 // of the first draw with SceneTargets::front
  std::array<gpu::GraphicsPipeline, 72> pipelines_;  // by Variant::fragment()
  std::vector<DeviceTexture> textures_;
  std::array<gpu::Sampler, 27> samplers_;       // wrap u, wrap v, one level | mips | anisotropic
  gpu::Sampler nearest_;                        // for SceneTargets::front
  gpu::Texture white_;                          // for materials without a texture
  std::vector<scene::Bounds> primitiveBounds_;  // object space
  uint64_t boundsPoses_ = 0;                    // the pose that they belong to
};

}  // namespace grisaille::frame
