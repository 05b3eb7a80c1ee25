// SPDX-License-Identifier: MIT
#include "core/frame/scene_resources.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "core/frame/draw_data.h"
#include "core/image/image.h"
#include "core/scene/rig.h"
#include "shaders/geometry_variants.h"

namespace grisaille::frame {
namespace {

// shaders/scene/draw.glsl, std140.
struct DrawBlock {
  glm::mat4 clip_from_object;
  glm::mat4 normal_from_object;
  glm::vec4 base_color;
  float alpha_cutoff = 0;
  float front_sign = 1;
  float chord_scale = 1;
  float padding = 0;
  glm::mat4 camera_from_object;
  glm::vec4 sight;
};
GRISAILLE_CHECK_BLOCK_geometry_vert_01100_DrawBlock(DrawBlock);

// Bytes of the block that shaders without facet normals read.
constexpr size_t kBlockWithoutFacet = offsetof(DrawBlock, camera_from_object);

gpu::Address address(scene::Wrap wrap) {
  switch (wrap) {
    case scene::Wrap::kRepeat:
      return gpu::Address::kRepeat;
    case scene::Wrap::kClamp:
      return gpu::Address::kClamp;
    case scene::Wrap::kMirror:
      return gpu::Address::kMirror;
  }
  return gpu::Address::kRepeat;
}

}  // namespace

SceneResources::SceneResources(gpu::Device& device, const scene::Scene& scene,
                               trace::SceneMatter* matter)
    : device_(device),
      scene_(scene),
      ownMatter_(scene),
      matter_(matter != nullptr ? *matter : ownMatter_),
      textures_(scene.textures.size()),
      primitiveBounds_(scene::primitiveBounds(scene)),
      boundsPoses_(scene.poses) {}

SceneResources::~SceneResources() {
  for (const gpu::Buffer buffer :
       {positions_.buffer, normals_.buffer, thickness_, texCoords_, colours_, indices_}) {
    device_.destroy(buffer);
  }
  if (farSides_) device_.destroy(farSides_->indices);
  for (const gpu::GraphicsPipeline pipeline : pipelines_) device_.destroy(pipeline);
  for (const DeviceTexture& texture : textures_) {
    device_.destroy(texture.alpha);
    device_.destroy(texture.colour);
  }
  for (const gpu::Sampler sampler : samplers_) device_.destroy(sampler);
  device_.destroy(nearest_);
  device_.destroy(white_);
}

gpu::Buffer SceneResources::vertexBuffer(gpu::Commands& commands, gpu::Buffer& buffer,
                                         const char* label, std::span<const std::byte> bytes,
                                         gpu::BufferUsage usage) {
  if (!buffer) {
    buffer = device_.createBuffer({.label = label, .size = bytes.size(), .usage = usage});
    commands.upload(buffer, 0, bytes);
  }
  return buffer;
}

gpu::Buffer SceneResources::posed(gpu::Commands& commands, PosedVertices& vertices,
                                  const char* label, const std::vector<glm::vec3>& values) {
  const std::span all(values);
  if (!vertices.buffer) {
    vertexBuffer(commands, vertices.buffer, label, std::as_bytes(all), gpu::BufferUsage::kVertex);
  } else if (vertices.poses != scene_.poses && scene_.rig) {
    for (const scene::DeformedNode& node : scene_.rig->deformed) {
      for (const scene::DeformedRun& run : node.runs) {
        commands.upload(vertices.buffer, run.firstVertex * sizeof(glm::vec3),
                        std::as_bytes(all.subspan(run.firstVertex, run.vertexCount)));
      }
    }
  }
  vertices.poses = scene_.poses;
  return vertices.buffer;
}

gpu::Buffer SceneResources::positions(gpu::Commands& commands) {
  return posed(commands, positions_, "positions", scene_.positions);
}

gpu::Buffer SceneResources::indices(gpu::Commands& commands) {
  return vertexBuffer(commands, indices_, "indices", std::as_bytes(std::span(scene_.indices)),
                      gpu::BufferUsage::kIndex);
}

gpu::Buffer SceneResources::thickness(gpu::Commands& commands) {
  if (!thickness_) {
    const std::vector<float> values = scene::vertexThickness(scene_, matter_.get());
    vertexBuffer(commands, thickness_, "thickness", std::as_bytes(std::span(values)),
                 gpu::BufferUsage::kVertex);
  }
  return thickness_;
}

float SceneResources::chordScale(uint32_t primitive, const glm::dmat3& linear) {
  return static_cast<float>(scene::chordScale(matter_.get().areas[primitive], linear));
}

const SceneResources::FarSides& SceneResources::farSides(gpu::Commands& commands) {
  if (farSides_) return *farSides_;
  const auto twoSided = [&](const scene::Primitive& primitive) {
    const scene::Material& material = scene_.materials[primitive.material];
    return material.doubleSided && !material.masked;
  };
  const std::vector<bool>& buried = matter_.buried();
  std::vector<uint32_t> ordered = scene_.indices, others;
  std::vector<FarSides::Run> runs;
  for (const scene::Primitive& primitive : scene_.primitives) {
    const bool sorted = twoSided(primitive);
    const auto begin = ordered.begin() + primitive.firstIndex;
    auto to = begin;
    others.clear();
    for (auto from = begin; from != begin + primitive.indexCount; from += 3) {
      const size_t triangle = static_cast<size_t>(from - ordered.begin()) / 3;
      if (buried[triangle]) continue;
      if (sorted && matter_.get().bodies[triangle]) {
        to = std::copy(from, from + 3, to);
      } else {
        others.insert(others.end(), from, from + 3);
      }
    }
    std::ranges::copy(others, to);
    runs.push_back({.bodies = static_cast<uint32_t>(to - begin),
                    .others = static_cast<uint32_t>(others.size())});
  }
  farSides_.emplace().runs = std::move(runs);
  if (ordered != scene_.indices) {
    vertexBuffer(commands, farSides_->indices, "indices of far sides",
                 std::as_bytes(std::span(ordered)), gpu::BufferUsage::kIndex);
  }
  return *farSides_;
}

const std::vector<scene::Bounds>& SceneResources::primitiveBounds() {
  if (boundsPoses_ != scene_.poses && scene_.rig && !scene_.rig->deformed.empty()) {
    primitiveBounds_ = scene::primitiveBounds(scene_);
  }
  boundsPoses_ = scene_.poses;
  return primitiveBounds_;
}

gpu::GraphicsPipeline SceneResources::pipeline(Variant variant) {
  gpu::GraphicsPipeline& pipeline = pipelines_[variant.fragment()];
  if (pipeline) return pipeline;
  constexpr uint32_t kStrides[] = {sizeof(glm::vec3), sizeof(glm::vec3), sizeof(glm::vec2)};
  std::vector<uint32_t> strides = {kStrides[0]};
  std::vector<gpu::VertexAttribute> attributes = {{.location = 0, .stream = 0}};
  std::vector<gpu::Format> colors;
  if (variant.normal) {
    attributes.push_back({.location = 1, .stream = static_cast<uint32_t>(strides.size())});
    strides.push_back(kStrides[1]);
    colors.push_back(gpu::Format::kRgba16Float);
  }
  if (variant.uv()) {
    attributes.push_back({.location = 2,
                          .stream = static_cast<uint32_t>(strides.size()),
                          .format = gpu::AttributeFormat::kFloat2});
    strides.push_back(kStrides[2]);
  }
  if (variant.colour) {
    attributes.push_back({.location = 3,
                          .stream = static_cast<uint32_t>(strides.size()),
                          .format = gpu::AttributeFormat::kFloat4});
    strides.push_back(sizeof(glm::vec4));
  }
  if (variant.thickness) {
    attributes.push_back({.location = 4,
                          .stream = static_cast<uint32_t>(strides.size()),
                          .format = gpu::AttributeFormat::kFloat1});
    strides.push_back(sizeof(float));
  }
  if (variant.base) colors.push_back(gpu::Format::kRgba8Srgb);
  if (variant.facet) colors.push_back(gpu::Format::kRgba16Float);
  if (variant.thickness) colors.push_back(gpu::Format::kR32Float);
  pipeline = device_.createGraphicsPipeline({.label = "geometry",
                                             .vertex = kGeometryVertex[variant.vertex()],
                                             .fragment = kGeometryFragment[variant.fragment()],
                                             .constants = {},
                                             .streamStrides = strides,
                                             .attributes = attributes,
                                             .colorFormats = colors,
                                             .depthFormat = gpu::Format::kD32Float});
  return pipeline;
}

gpu::Texture SceneResources::texture(gpu::Commands& commands, const scene::Material& material,
                                     bool base) {
  if (material.baseColorTexture < 0) {
    if (!white_) {
      white_ = device_.createTexture({.label = "white",
                                      .format = gpu::Format::kRgba8Unorm,
                                      .width = 1,
                                      .height = 1,
                                      .usage = gpu::TextureUsage::kSampled});
      constexpr uint32_t kWhite = 0xffffffffu;
      commands.upload(white_, 0, 0, std::as_bytes(std::span(&kWhite, 1)));
    }
    return white_;
  }
  const scene::Texture& source = scene_.textures[static_cast<size_t>(material.baseColorTexture)];
  DeviceTexture& texture = textures_[static_cast<size_t>(material.baseColorTexture)];
  gpu::Texture& wanted = base ? texture.colour : texture.alpha;
  if (wanted) return wanted;
  gpu::TextureDesc desc{.label = source.name, .usage = gpu::TextureUsage::kSampled};
  if (base) {
    const image::Image8 image = scene::texelsOf(source);
    const std::vector<std::vector<uint8_t>> levels = mipChain(image);
    desc.format = gpu::Format::kRgba8Srgb;
    desc.width = image.width;
    desc.height = image.height;
    desc.mips = static_cast<uint32_t>(levels.size());
    wanted = device_.createTexture(desc);
    for (uint32_t mip = 0; mip < levels.size(); ++mip) {
      commands.upload(wanted, mip, 0, std::as_bytes(std::span(levels[mip])));
    }
  } else {
    const image::Alpha8 alpha = scene::alphaOf(source);
    desc.format = gpu::Format::kR8Unorm;
    desc.width = alpha.width;
    desc.height = alpha.height;
    wanted = device_.createTexture(desc);
    commands.upload(wanted, 0, 0, std::as_bytes(std::span(alpha.pixels)));
  }
  return wanted;
}

gpu::Sampler SceneResources::sampler(const scene::Material& material, bool base) {
  scene::Wrap u = scene::Wrap::kRepeat, v = scene::Wrap::kRepeat;
  if (material.baseColorTexture >= 0) {
    u = scene_.textures[static_cast<size_t>(material.baseColorTexture)].wrapU;
    v = scene_.textures[static_cast<size_t>(material.baseColorTexture)].wrapV;
  }
  // A mask is read from one level, but drivers' anisotropic filters may read other levels.
  // Without a texture, coordinates may be equal everywhere, where Mesa 25's llvmpipe filters to 0.
  const bool anisotropic = base && !material.masked && material.baseColorTexture >= 0;
  gpu::Sampler& sampler = samplers_[static_cast<size_t>(u) * 9 + static_cast<size_t>(v) * 3 +
                                    (anisotropic ? 2
                                     : base      ? 1
                                                 : 0)];
  if (!sampler) {
    sampler =
        device_.createSampler({.label = "base colour",
                               .filter = gpu::Filter::kLinear,
                               .mipFilter = base ? gpu::Filter::kLinear : gpu::Filter::kNearest,
                               .addressU = address(u),
                               .addressV = address(v),
                               .maxAnisotropy = anisotropic ? 8.0f : 1.0f});
  }
  return sampler;
}

void SceneResources::draw(gpu::Commands& commands, const scene::View& view,
                          const SceneTargets& targets) {
  const bool normal{targets.normal}, base{targets.baseColour}, facet{targets.facetNormal};
  const bool thick{targets.thickness};
  const bool behind{targets.front};
  const bool farSidesOnly = behind && targets.sides == SceneSides::kFar;
  if (behind && !nearest_) nearest_ = device_.createSampler({.label = "nearest"});
  const auto bytes = [](const auto& values) { return std::as_bytes(std::span(values)); };
  const auto vertex = gpu::BufferUsage::kVertex;
  const gpu::Buffer positions = this->positions(commands);
  indices(commands);
  const FarSides* far = behind ? &farSides(commands) : nullptr;
  const gpu::Buffer normals =
      normal ? posed(commands, normals_, "normals", scene_.normals) : gpu::Buffer{};
  const gpu::Buffer thickness = thick ? this->thickness(commands) : gpu::Buffer{};
  const std::vector<scene::Bounds>& bounds = primitiveBounds();

  const glm::dmat4 clipFromCamera = frame::clipFromCamera(view);
  const glm::vec4 sight =
      view.orthographic ? glm::vec4(-view.worldFromView[2], 0) : glm::vec4(0, 0, 0, 1);

  // Draws point into bindings and streams until render() returns: reserve, so that they never move.
  std::vector<gpu::Draw> draws;
  std::vector<std::array<gpu::Binding, 3>> bindings;
  std::vector<std::array<gpu::BufferRange, 5>> streams;
  bindings.reserve(scene_.instances.size());
  streams.reserve(scene_.instances.size());
  for (const scene::Instance& instance : scene_.instances) {
    const scene::Primitive& primitive = scene_.primitives[instance.primitive];
    const scene::Material& material = scene_.materials[primitive.material];
    const glm::dmat4 cameraFromObject = frame::cameraFromObject(instance.worldFromObject, view.eye);
    const glm::dmat4 clipFromObject = clipFromCamera * cameraFromObject;
    if (!mayBeSeen(bounds[instance.primitive], clipFromObject)) continue;

    const glm::dmat3 linear(cameraFromObject);
    const bool mirrors = glm::determinant(linear) < 0;
    const DrawBlock block{.clip_from_object = glm::mat4(clipFromObject),
                          .normal_from_object = glm::mat4(normalTransform(linear)),
                          .base_color = material.baseColor,
                          .alpha_cutoff = material.alphaCutoff,
                          .front_sign = mirrors ? -1.0f : 1.0f,
                          .chord_scale = thick ? chordScale(instance.primitive, linear) : 0,
                          .camera_from_object = glm::mat4(cameraFromObject),
                          .sight = sight};
    const auto blockBytes = std::as_bytes(std::span(&block, 1));
    const Variant variant{.facet = facet,
                          .normal = normal,
                          .base = base,
                          .mask = material.masked,
                          .colour = primitive.coloured && (base || material.masked),
                          .thickness = thick,
                          .behind = behind ? 1 + static_cast<uint32_t>(targets.sides) : 0};

    auto& stream = streams.emplace_back();
    size_t streamCount = 0;
    stream[streamCount++].buffer = positions;
    if (normal) stream[streamCount++].buffer = normals;
    auto& binding = bindings.emplace_back();
    size_t bindingCount = 0;
    binding[bindingCount++] = gpu::uniformBinding(
        0, commands.uniform(facet ? blockBytes : blockBytes.first(kBlockWithoutFacet)));
    if (variant.uv()) {
      stream[streamCount++].buffer = vertexBuffer(commands, texCoords_, "texture coordinates",
                                                  bytes(scene_.texCoords), vertex);
      binding[bindingCount++] = gpu::textureBinding(
          0, {.texture = texture(commands, material, base)}, sampler(material, base));
    }
    if (variant.colour) {
      stream[streamCount++].buffer =
          vertexBuffer(commands, colours_, "colours", bytes(scene_.colours), vertex);
    }
    if (thick) stream[streamCount++].buffer = thickness;
    if (behind) {
      binding[bindingCount++] = gpu::textureBinding(1, {.texture = targets.front}, nearest_);
    }
    const auto add = [&](uint32_t first, uint32_t count, bool bothSides) {
      if (count == 0) return;
      draws.push_back({.pipeline = pipeline(variant),
                       .bindings = std::span(binding).first(bindingCount),
                       .vertexStreams = std::span(stream).first(streamCount),
                       .indices = {.buffer = far && far->indices ? far->indices : indices_},
                       .count = count,
                       .first = first,
                       .cull = bothSides                 ? gpu::Cull::kNone
                               : mirrors != farSidesOnly ? gpu::Cull::kFront
                                                         : gpu::Cull::kBack});
    };
    const FarSides::Run run = far ? far->runs[instance.primitive]
                                  : FarSides::Run{.bodies = 0, .others = primitive.indexCount};
    add(primitive.firstIndex, run.bodies, false);
    add(primitive.firstIndex + run.bodies, run.others, material.doubleSided);
  }

  std::vector<gpu::ColorTarget> colors;
  if (normal) colors.push_back({.view = {.texture = targets.normal}});
  if (base) colors.push_back({.view = {.texture = targets.baseColour}});
  if (facet) colors.push_back({.view = {.texture = targets.facetNormal}});
  if (thick) colors.push_back({.view = {.texture = targets.thickness}});
  commands.render(
      {.colors = colors, .depth = {.view = {.texture = targets.depth}}, .draws = draws});
}

}  // namespace grisaille::frame
