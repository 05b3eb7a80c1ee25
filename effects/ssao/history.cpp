// SPDX-License-Identifier: MIT
#include "history.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "dispatch.h"
#include "parameters.h"
#include "shaders/ssao_accumulate.h"
#include "shaders/ssao_reach.h"
#include "shaders/ssao_spread.h"

namespace grisaille::ssao {
namespace {

// shaders/ssao/accumulate.comp, std140.
struct AccumulateBlock {
  glm::mat4 then_from_view;
  glm::vec4 then_view_from_pixel;
  glm::vec4 then_pixel_from_view;
  glm::vec4 then_from_pixel;
  glm::vec2 then_size;
  float then_scale;
  float most;
  float tolerance;
  float margin;
};
GRISAILLE_CHECK_BLOCK_ssao_accumulate_Settings(AccumulateBlock);

// shaders/ssao/reach.comp, std140.
struct ReachBlock {
  float radius;
};
GRISAILLE_CHECK_BLOCK_ssao_reach_Settings(ReachBlock);

// Pixels per side of a tile in shaders/ssao/reach.comp.
constexpr uint32_t kTile = 16;

// Plane tolerance of the history rejection, in view depths; orthographic: in picture heights.
constexpr double kSameSurface = 0.01f;
// Largest difference between the history and the frame near surfaces that move. Without a denoiser
// as wide as the noise pattern, a frame is too noisy to judge the history by.
constexpr float kMargin = 0.03f;
constexpr uint32_t kPattern = 5;  // texels

// Transform from the view space of `from` to that of `to`. In double precision: the cameras may be
// far from the world's origin.
glm::dmat4 between(const grisaille_view& from, const grisaille_view& to) {
  const glm::dmat3 turn = glm::transpose(glm::make_mat3(to.world_from_view));
  glm::dmat4 matrix(turn * glm::make_mat3(from.world_from_view));
  matrix[3] = glm::dvec4(turn * (glm::make_vec3(from.position) - glm::make_vec3(to.position)), 1);
  return matrix;
}

}  // namespace

History::History(plugin::Host host)
    : host_(host),
      accumulate_(host, "accumulate", grisaille_shader_ssao_accumulate),
      reach_(host, "reach", grisaille_shader_ssao_reach),
      spread_(host, "spread", grisaille_shader_ssao_spread),
      clamped_(host.sampler({.label = "clamped"})) {}

void History::keepOnly(const Values& values) {
  if (values != values_) forget();
  values_ = values;
}

void History::forget() {
  then_ = {};
  spare_ = {};
  frames_ = 0;
}

grisaille_texture History::reachOf(const plugin::Frame& frame, grisaille_texture motion) {
  const uint32_t width = plugin::groupsFor(frame.width() + 2 * frame.guard(), kTile);
  const uint32_t height = plugin::groupsFor(frame.height() + 2 * frame.guard(), kTile);
  const auto tiles = [&](const char* label) {
    return frame.transient(
        {.label = label, .format = GRISAILLE_FORMAT_R32F, .width = width, .height = height});
  };
  const grisaille_texture reach = tiles("reach"), rows = tiles("reach along rows");
  const ReachBlock settings = {.radius = frame.value<float>(kRadius)};
  const grisaille_binding bindings[] = {
      plugin::uniform(0, frame.viewBlock()), plugin::uniform(1, frame.uniform(settings)),
      plugin::texture(0, motion, clamped_),
      plugin::texture(1, frame.attachment(GRISAILLE_VIEW_DEPTH), clamped_),
      plugin::image(0, reach)};
  dispatch(frame, reach_.get({}), bindings, width, height);
  const auto spread = [&](bool column, grisaille_texture from, grisaille_texture to) {
    const grisaille_binding spreads[] = {plugin::texture(0, from, clamped_), plugin::image(0, to)};
    dispatch(frame, spread_.get({plugin::specialize(0, column)}), spreads, width, height);
  };
  spread(false, reach, rows);
  spread(true, rows, reach);
  return reach;
}

grisaille_texture History::accumulate(const plugin::Frame& frame, uint32_t scale, uint32_t most,
                                      grisaille_texture denoised) {
  Seen now = std::move(spare_);
  spare_ = {};
  const uint32_t width = plugin::groupsFor(frame.width(), scale);
  const uint32_t height = plugin::groupsFor(frame.height(), scale);
  const auto fit = [&](Seen& seen) {
    if (seen.mean && seen.width == width && seen.height == height) return;
    seen.mean = host_.texture({.label = "mean visibility",
                               .format = GRISAILLE_FORMAT_RGBA32F,
                               .width = width,
                               .height = height});
    seen.width = width;
    seen.height = height;
  };
  fit(now);
  // The second frame's, now: later frames allocate nothing.
  Seen next = frames_ > 0 ? Seen() : std::move(then_);
  if (frames_ == 0) fit(next);
  now.scale = scale;
  now.size = {frame.width(), frame.height()};
  now.view = frame.view();

  const Seen& then = frames_ > 0 ? then_ : now;
  const glm::dvec2 pixel = glm::make_vec2(then.view.view_from_pixel);
  const glm::dvec2 offset = glm::make_vec2(then.view.view_from_pixel + 2);
  const double tall = now.view.orthographic != 0 ? -now.view.view_from_pixel[1] * now.size.y : 1;
  const double zoom = then.size.y / now.size.y;
  const AccumulateBlock settings = {
      .then_from_view = glm::mat4(between(now.view, then.view)),
      .then_view_from_pixel = glm::vec4(glm::dvec4(pixel, offset)),
      .then_pixel_from_view = glm::vec4(glm::dvec4(1.0 / pixel, -offset / pixel)),
      .then_from_pixel =
          glm::vec4(glm::dvec4(glm::dvec2(zoom), then.size / 2.0 - now.size / 2.0 * zoom)),
      .then_size = glm::vec2(then.width, then.height),
      .then_scale = static_cast<float>(then.scale),
      .most = frames_ > 0 ? static_cast<float>(most) : 0.0f,
      .tolerance = static_cast<float>(1 / (kSameSurface * tall)),
      .margin = frame.value<uint32_t>(kBlurSize) >= kPattern * scale ? kMargin : 1.0f};
  const grisaille_texture motion = frame.attachment(GRISAILLE_MOTION);
  const bool moves = motion.id != 0;
  grisaille_texture reach = denoised;
  if (moves) frame.pass("movement", [&] { reach = reachOf(frame, motion); });
  frame.pass("accumulate", [&] {
    const grisaille_binding bindings[] = {
        plugin::uniform(0, frame.viewBlock()),
        plugin::uniform(1, frame.uniform(settings)),
        plugin::texture(0, denoised, clamped_),
        plugin::texture(1, frame.attachment(GRISAILLE_NORMAL), clamped_),
        plugin::texture(2, frames_ > 0 ? grisaille_texture(then_.mean) : denoised, clamped_),
        plugin::texture(3, moves ? motion : denoised, clamped_),
        plugin::texture(4, reach, clamped_),
        plugin::image(0, now.mean)};
    dispatch(frame,
             accumulate_.get(
                 {cameraKind(frame), plugin::specialize(0, scale), plugin::specialize(1, moves)}),
             bindings, width, height);
  });
  spare_ = frames_ > 0 ? std::move(then_) : std::move(next);
  then_ = std::move(now);
  ++frames_;
  return then_.mean;
}

}  // namespace grisaille::ssao
