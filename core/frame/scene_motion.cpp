// SPDX-License-Identifier: MIT
#include "core/frame/scene_motion.h"

#include <algorithm>
#include <array>

#include "core/frame/draw_data.h"
#include "core/scene/rig.h"
#include "shaders/camera_motion_frag.h"
#include "shaders/motion_frag.h"
#include "shaders/motion_vert.h"
#include "shaders/whole_picture_vert.h"

namespace grisaille::frame {
namespace {

// shaders/scene/camera_motion.frag, std140.
struct ThenBlock {
  glm::mat4 then_from_view;
  glm::vec4 then_pixel_from_view;
  float known;
  float camera_moved;
  float then_orthographic;
};
GRISAILLE_CHECK_BLOCK_camera_motion_frag_Then(ThenBlock);

// shaders/scene/motion_draw.glsl, std140.
struct MotionBlock {
  glm::mat4 clip_from_object;
  glm::mat4 then_clip_from_object;
  glm::vec4 depth_from_object;
  glm::vec4 then_depth_from_object;
  glm::vec2 pixels_from_clip;
};
GRISAILLE_CHECK_BLOCK_motion_vert_MotionBlock(MotionBlock);

// View depth of an object's point p is dot(row, (p, 1)).
glm::dvec4 depthRow(const scene::View& view, const glm::dmat4& cameraFromObject) {
  return glm::transpose(cameraFromObject) * glm::dvec4(-view.worldFromView[2], 0);
}

template <typename Visit>
void forEachRun(const scene::Scene& scene, Visit&& visit) {
  if (!scene.rig) return;
  for (const scene::DeformedNode& node : scene.rig->deformed) {
    for (const scene::DeformedRun& run : node.runs) visit(run);
  }
}

}  // namespace

SceneMotion::~SceneMotion() {
  device_.destroy(camera_);
  device_.destroy(moved_);
  device_.destroy(nearest_);
  device_.destroy(thenPositions_);
}

void SceneMotion::remember() {
  if (then_ && then_->poses == scene_.poses) return;
  if (!then_) then_.emplace();
  then_->poses = scene_.poses;
  then_->transforms.clear();
  for (const scene::Instance& instance : scene_.instances) {
    then_->transforms.push_back(instance.worldFromObject);
  }
  then_->deformed.clear();
  forEachRun(scene_, [&](const scene::DeformedRun& run) {
    const auto first = scene_.positions.begin() + run.firstVertex;
    then_->deformed.insert(then_->deformed.end(), first, first + run.vertexCount);
  });
}

void SceneMotion::makePipelines() {
  if (camera_) return;
  constexpr std::array<uint32_t, 2> kStrides = {sizeof(glm::vec3), sizeof(glm::vec3)};
  constexpr std::array<gpu::VertexAttribute, 2> kAttributes = {
      {{.location = 0, .stream = 0}, {.location = 1, .stream = 1}}};
  constexpr std::array kFormats = {gpu::Format::kRgba16Float};
  nearest_ = device_.createSampler({.label = "nearest depth"});
  moved_ = device_.createGraphicsPipeline({.label = "motion",
                                           .vertex = &grisaille_shader_motion_vert,
                                           .fragment = &grisaille_shader_motion_frag,
                                           .streamStrides = kStrides,
                                           .attributes = kAttributes,
                                           .colorFormats = kFormats});
  camera_ = device_.createGraphicsPipeline({.label = "camera motion",
                                            .vertex = &grisaille_shader_whole_picture_vert,
                                            .fragment = &grisaille_shader_camera_motion_frag,
                                            .colorFormats = kFormats});
}

void SceneMotion::record(gpu::Commands& commands, const scene::View& view,
                         gpu::BufferRange viewBlock, gpu::Texture depth, const MotionTarget& to,
                         std::string_view passes) {
  makePipelines();
  commands.beginPass(std::string(passes) + "motion");
  recordCamera(commands, view, viewBlock, depth, to);
  if (to.then && then_ && then_->poses != scene_.poses) {
    recordMoved(commands, view, depth, to);
  }
  commands.endPass();
}

void SceneMotion::recordCamera(gpu::Commands& commands, const scene::View& view,
                               gpu::BufferRange viewBlock, gpu::Texture depth,
                               const MotionTarget& to) {
  const scene::View& then = to.then ? *to.then : view;
  // In pixels of the picture inside the attachment.
  const glm::dvec2 origin = -then.offset / then.scale - to.guard;
  const ThenBlock block = {.then_from_view = glm::mat4(scene::thenFromView(then, view)),
                           .then_pixel_from_view = glm::vec4(glm::dvec4(1.0 / then.scale, origin)),
                           .known = to.then ? 1.0f : 0.0f,
                           .camera_moved = then == view ? 0.0f : 1.0f,
                           .then_orthographic = then.orthographic ? 1.0f : 0.0f};
  const std::array bindings = {
      gpu::uniformBinding(0, viewBlock),
      gpu::uniformBinding(1, commands.uniform(std::as_bytes(std::span(&block, 1)))),
      gpu::textureBinding(0, {.texture = depth}, nearest_)};
  const std::array draws = {gpu::Draw{.pipeline = camera_, .bindings = bindings, .count = 3}};
  const std::array colours = {
      gpu::ColorTarget{.view = {.texture = to.texture}, .load = gpu::Load::kDiscard}};
  commands.render({.colors = colours, .draws = draws});
}

// Uploads the earlier positions of the runs that moved. Returns for each vertex run of the rig
// whether it moved.
std::vector<bool> SceneMotion::uploadDeformed(gpu::Commands& commands) {
  std::vector<bool> moved;
  size_t at = 0;
  forEachRun(scene_, [&](const scene::DeformedRun& run) {
    const std::span before = std::span(then_->deformed).subspan(at, run.vertexCount);
    const std::span now = std::span(scene_.positions).subspan(run.firstVertex, run.vertexCount);
    at += run.vertexCount;
    moved.push_back(!std::ranges::equal(before, now));
    if (!moved.back()) return;
    if (!thenPositions_) {
      thenPositions_ = device_.createBuffer({.label = "previous positions",
                                             .size = scene_.positions.size() * sizeof(glm::vec3),
                                             .usage = gpu::BufferUsage::kVertex});
    }
    commands.upload(thenPositions_, run.firstVertex * sizeof(glm::vec3), std::as_bytes(before));
  });
  return moved;
}

void SceneMotion::recordMoved(gpu::Commands& commands, const scene::View& view, gpu::Texture depth,
                              const MotionTarget& to) {
  const std::vector<bool> deformed = uploadDeformed(commands);
  // Whether the vertices of a primitive moved: those of a deformed one belong to one run.
  const auto isDeformed = [&](const scene::Primitive& primitive) {
    const uint32_t vertex = scene_.indices[primitive.firstIndex];
    bool found = false;
    size_t k = 0;
    forEachRun(scene_, [&](const scene::DeformedRun& run) {
      found |= deformed[k++] && vertex - run.firstVertex < run.vertexCount;
    });
    return found;
  };
  const gpu::Buffer positions = resources_.positions(commands);
  const gpu::Buffer indices = resources_.indices(commands);
  const std::vector<scene::Bounds>& bounds = resources_.primitiveBounds();
  const glm::dmat4 clipFromCamera = frame::clipFromCamera(view);
  const glm::dmat4 thenClipFromCamera = frame::clipFromCamera(*to.then);

  std::vector<gpu::Draw> draws;
  std::vector<std::array<gpu::Binding, 2>> bindings;
  std::vector<std::array<gpu::BufferRange, 2>> streams;
  bindings.reserve(scene_.instances.size());
  streams.reserve(scene_.instances.size());
  for (size_t i = 0; i < scene_.instances.size(); ++i) {
    const scene::Instance& instance = scene_.instances[i];
    const scene::Primitive& primitive = scene_.primitives[instance.primitive];
    const glm::dmat4& before = then_->transforms[i];
    const bool bends = primitive.indexCount > 0 && isDeformed(primitive);
    if (!bends && before == instance.worldFromObject) continue;
    const glm::dmat4 fromObject = cameraFromObject(instance.worldFromObject, view.eye);
    const glm::dmat4 thenFromObject = cameraFromObject(before, to.then->eye);
    const glm::dmat4 clipFromObject = clipFromCamera * fromObject;
    if (!mayBeSeen(bounds[instance.primitive], clipFromObject)) continue;
    const scene::Material& material = scene_.materials[primitive.material];
    const MotionBlock block = {
        .clip_from_object = glm::mat4(clipFromObject),
        .then_clip_from_object = glm::mat4(thenClipFromCamera * thenFromObject),
        .depth_from_object = glm::vec4(depthRow(view, fromObject)),
        .then_depth_from_object = glm::vec4(depthRow(*to.then, thenFromObject)),
        .pixels_from_clip = glm::vec2(view.size) * glm::vec2(0.5f, -0.5f)};
    auto& stream = streams.emplace_back();
    stream[0].buffer = positions;
    stream[1].buffer = bends ? thenPositions_ : positions;
    auto& binding = bindings.emplace_back();
    binding[0] = gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(&block, 1))));
    binding[1] = gpu::textureBinding(0, {.texture = depth}, nearest_);
    draws.push_back({.pipeline = moved_,
                     .bindings = binding,
                     .vertexStreams = stream,
                     .indices = {.buffer = indices},
                     .count = primitive.indexCount,
                     .first = primitive.firstIndex,
                     .cull = cullOf(material, instance.worldFromObject)});
  }
  if (draws.empty()) return;
  const std::array colours = {
      gpu::ColorTarget{.view = {.texture = to.texture}, .load = gpu::Load::kLoad}};
  commands.render({.colors = colours, .draws = draws});
}

}  // namespace grisaille::frame
