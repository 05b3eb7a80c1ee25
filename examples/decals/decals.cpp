// SPDX-License-Identifier: MIT
// Decals: pictures that users place on surfaces. decals.comp blends them.
#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/ext/vector_float1.hpp>
#include <glm/glm.hpp>
#include <glm/gtc/color_space.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <string>
#include <vector>

#include "shaders/decals.h"
#include "tables.h"

namespace decals {

struct Box {  // same as in decals.comp
  glm::mat3x4 axes;
  float opacity, layer, cosine, per_fade;
};

// Resamples a picture to size x size texels, each the mean of n x n samples. Half floats: linear
// light, premultiplied alpha.
std::vector<uint64_t> texelsOf(const grisaille_picture& picture, uint64_t size) {
  float linear[256];
  for (int i = 0; i < 256; ++i) linear[i] = glm::convertSRGBToLinear(glm::vec1(float(i) / 255)).x;
  const uint64_t n = (std::max(picture.width, picture.height) + size - 1) / size;
  std::vector<uint64_t> texels;
  for (uint64_t i = 0; i < size * size; ++i) {
    glm::vec4 sum(0);
    for (uint64_t s = 0; s < n * n; ++s) {
      const uint64_t x = (2 * (i % size * n + s % n) + 1) * picture.width / (2 * n * size);
      const uint64_t y = (2 * (i / size * n + s / n) + 1) * picture.height / (2 * n * size);
      const uint8_t* c = picture.rgba + 4 * (y * picture.width + x);
      sum += glm::vec4(linear[c[0]], linear[c[1]], linear[c[2]], 1) * float(c[3]);
    }
    texels.push_back(glm::packHalf4x16(sum / float(255 * n * n)));
  }
  return texels;
}

class Effect {
 public:
  explicit Effect(plugin::Host host)
      : host_(host),
        blend_(host, "decals", grisaille_shader_decals),
        nearest_(host.sampler({.label = "nearest"})),
        smooth_(host.sampler({.label = "smooth", .linear = true, .linearMip = true})) {}

  static uint32_t reads(plugin::Values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH) | GRISAILLE_READS(GRISAILLE_FACET_NORMAL);
  }

  void record(const plugin::Frame& frame) {
    const std::span<const Decal> decals = frame.objects<Decal>();
    loadPictures(frame, decals);
    std::map<std::pair<double, double>, Box> boxes;  // the topmost first
    for (const Decal& d : decals) {
      const glm::vec2 layer = layers_.at(d.picture);
      // Relative to the camera: floats lack digits far from the world's origin.
      const glm::dvec3 place = glm::make_vec3(d.position) - glm::make_vec3(frame.view().position);
      // The picture's up is up in the world; on floors and ceilings it is -z.
      const glm::dvec3 out = glm::make_vec3(d.direction);
      const glm::dvec3 up = std::abs(out.y) > 0.99 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
      const glm::dvec3 side = glm::normalize(glm::cross(up, out)), top = glm::cross(out, side);
      const double c = std::cos(d.angle), s = std::sin(d.angle);
      const auto row = [&](const glm::dvec3& axis, double length) {
        return glm::dvec4(axis, -glm::dot(axis, place)) / length;
      };
      boxes[{-d.order, -double(boxes.size())}] = {
          .axes = glm::dmat3x4(row(c * side + s * top, d.size),
                               row(c * top - s * side, d.height > 0 ? d.height : d.size * layer.y),
                               row(out, d.depth)),
          .opacity = float(d.opacity) * frame.value<float>(kOpacity),
          .layer = layer.x,
          .cosine = std::cos(frame.value<float>(kMaxAngle)),
          .per_fade = 1 / std::max(frame.value<float>(kFade), 1e-6f)};
    }
    std::vector<Box> sorted;
    for (const auto& [order, box] : boxes) sorted.push_back(box);
    if (sorted.empty()) sorted.emplace_back();  // a buffer cannot be empty
    const uint64_t bytes = sorted.size() * sizeof(Box);
    if (bytes > room_) buffer_ = host_.buffer("decals", room_ = 2 * bytes);
    frame.uploadBuffer(buffer_, 0, sorted);
    frame.pass("decals", [&] {
      frame.dispatch(
          blend_.get({plugin::specialize(0, !decals.empty())}),
          {plugin::uniform(0, frame.viewBlock()), plugin::storage(0, {buffer_, 0, 0, bytes}),
           plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), nearest_),
           plugin::texture(1, frame.attachment(GRISAILLE_FACET_NORMAL), nearest_),
           plugin::texture(2, pictures_, smooth_), plugin::image(0, frame.output(0))},
          plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
    });
  }

 private:
  // Reads all pictures again if a path is new.
  void loadPictures(const plugin::Frame& frame, std::span<const Decal> decals) {
    std::map<std::string, glm::vec2> layers = {{"", {}}};
    for (const Decal& decal : decals) layers[decal.picture] = {};
    if (std::ranges::all_of(layers, [&](auto& one) { return layers_.contains(one.first); })) return;
    const auto count = uint32_t(layers.size());
    // About 128 MiB at most, and a third more for the mips.
    const uint32_t side = std::min(1024u, std::bit_floor(4096 / uint32_t(std::sqrt(count))));
    plugin::Texture texture =
        host_.texture({"pictures", GRISAILLE_FORMAT_RGBA16F, side, side, GRISAILLE_TEXTURE_SAMPLED,
                       uint32_t(std::bit_width(side)), count});
    uint32_t index = 0;
    for (auto& [path, layer] : layers) {
      static constexpr uint8_t kMissing[] = {204, 0, 204, 255, 0, 0, 0, 255};
      grisaille_picture picture = {.width = 2, .height = 1, .rgba = kMissing};
      if (!path.empty()) picture = host_.readPicture(path.c_str()).value_or(picture);
      for (uint32_t mip = 0; side >> mip != 0; ++mip) {
        frame.uploadTexture(texture, texelsOf(picture, side >> mip), mip, index);
      }
      layer = {index++, float(picture.height) / float(picture.width)};
    }
    pictures_ = std::move(texture);
    layers_ = std::move(layers);
  }

  plugin::Host host_;
  plugin::PipelineCache blend_;
  plugin::Sampler nearest_, smooth_;
  plugin::Texture pictures_;
  std::map<std::string, glm::vec2> layers_;  // by path: layer, height / width
  plugin::Buffer buffer_;
  uint64_t room_ = 0;  // bytes of the buffer
};

constexpr auto kEffect = plugin::effect<Effect>({.key = "decals",
                                                 .label = "Decals",
                                                 .version = "1.0.0",
                                                 .tooltip = "Pictures projected into boxes",
                                                 .params = kParams,
                                                 .outputs = kOutputs,
                                                 .objects = &kDecals});

}  // namespace decals

GRISAILLE_EXPORT_PLUGIN(&decals::kEffect);
