// SPDX-License-Identifier: MIT
// The host's services in C++: errors, owned resources, pipelines. Part of effect.hpp.
#ifndef GRISAILLE_EFFECT_HOST_HPP
#define GRISAILLE_EFFECT_HOST_HPP

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "grisaille/effect.h"

namespace grisaille::plugin {

// --- Errors --------------------------------------------------------------------------------------

// Why an effect cannot go on, in one line for the user.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A call that the host refused. The host has noted why; this only ends the work.
class HostRefused : public Failure {
 public:
  using Failure::Failure;
};

// Throws unless `result` is GRISAILLE_OK. `service` names what was asked for.
inline void require(grisaille_result result, const char* service) {
  if (result == GRISAILLE_OK) return;
  if (result == GRISAILLE_UNSUPPORTED) {
    throw Failure(std::string("this host does not offer ") + service);
  }
  throw HostRefused(service);
}

// --- Resources -----------------------------------------------------------------------------------

// Owns one resource of the host and destroys it. Must not outlive the effect's object. Converts to
// the C handle, which it keeps owning.
template <typename Id, void (*grisaille_host::*kDestroy)(const grisaille_host*, Id)>
class Owned {
 public:
  Owned() = default;  // owns nothing
  Owned(const grisaille_host* host, Id id) : host_(host), id_(id) {}
  Owned(Owned&& other) noexcept
      : host_(std::exchange(other.host_, nullptr)), id_(std::exchange(other.id_, Id{0})) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(host_, other.host_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~Owned() {
    if (id_.id != 0) (host_->*kDestroy)(host_, id_);
  }

  operator Id() const { return id_; }
  explicit operator bool() const { return id_.id != 0; }

 private:
  const grisaille_host* host_ = nullptr;
  Id id_ = {0};
};

using Pipeline = Owned<grisaille_pipeline, &grisaille_host::destroy_pipeline>;
using Texture = Owned<grisaille_texture, &grisaille_host::destroy_texture>;
using Buffer = Owned<grisaille_buffer, &grisaille_host::destroy_buffer>;
using Sampler = Owned<grisaille_sampler, &grisaille_host::destroy_sampler>;

struct TextureSpec {
  const char* label = nullptr;
  grisaille_format format = GRISAILLE_FORMAT_R32F;
  uint32_t width = 0;  // texels
  uint32_t height = 0;
  uint32_t usage = GRISAILLE_TEXTURE_SAMPLED | GRISAILLE_TEXTURE_STORAGE;
  uint32_t mips = 1;
  uint32_t layers = 1;
};

constexpr grisaille_texture_desc textureDesc(const TextureSpec& spec) {
  return {.struct_size = sizeof(grisaille_texture_desc),
          .format = static_cast<uint32_t>(spec.format),
          .usage = spec.usage,
          .width = spec.width,
          .height = spec.height,
          .mips = spec.mips,
          .layers = spec.layers,
          .label = spec.label};
}

struct SamplerSpec {
  const char* label = nullptr;
  bool linear = false;     // within a level
  bool linearMip = false;  // between levels
  bool repeat = false;     // else clamped to the edge
};

// The value of a specialization constant.
constexpr grisaille_constant specialize(uint32_t id, uint32_t value) {
  return {id, value};
}
constexpr grisaille_constant specialize(uint32_t id, int32_t value) {
  return {id, std::bit_cast<uint32_t>(value)};
}
constexpr grisaille_constant specialize(uint32_t id, float value) {
  return {id, std::bit_cast<uint32_t>(value)};
}
constexpr grisaille_constant specialize(uint32_t id, bool value) {
  return {id, value ? 1u : 0u};
}

// The host as seen by one instance; a view, free to copy. Every function throws Failure.
class Host {
 public:
  explicit Host(const grisaille_host* host) : host_(host) {}

  Pipeline computePipeline(const char* label, const grisaille_shader& shader,
                           std::span<const grisaille_constant> constants) const {
    const grisaille_pipeline_desc desc = {.struct_size = sizeof(grisaille_pipeline_desc),
                                          .constant_count = static_cast<uint32_t>(constants.size()),
                                          .label = label,
                                          .shader = &shader,
                                          .constants = constants.data()};
    grisaille_pipeline id = {0};
    require(host_->create_pipeline(host_, &desc, &id), "a compute pipeline");
    return {host_, id};
  }
  Pipeline computePipeline(const char* label, const grisaille_shader& shader,
                           std::initializer_list<grisaille_constant> constants = {}) const {
    return computePipeline(label, shader, std::span(constants.begin(), constants.size()));
  }

  Texture texture(const TextureSpec& spec) const {
    const grisaille_texture_desc desc = textureDesc(spec);
    grisaille_texture id = {0};
    require(host_->create_texture(host_, &desc, &id), "a texture");
    return {host_, id};
  }

  // A storage buffer.
  Buffer buffer(const char* label, uint64_t bytes) const {
    const grisaille_buffer_desc desc = {.struct_size = sizeof(grisaille_buffer_desc),
                                        .reserved = 0,
                                        .bytes = bytes,
                                        .label = label};
    grisaille_buffer id = {0};
    require(host_->create_buffer(host_, &desc, &id), "a buffer");
    return {host_, id};
  }

  // What each ray hits; false where the host casts none. Only inside record(). As many hits as
  // rays.
  bool castRays(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) const {
    const grisaille_result result =
        host_->cast_rays(host_, rays.data(), std::min(rays.size(), hits.size()), hits.data());
    if (result == GRISAILLE_UNSUPPORTED) return false;
    require(result, "rays");
    return true;
  }

  // Decodes a picture file; nothing where this host decodes none or cannot read the file, of which
  // it warns by itself. Only inside record(). The pixels are valid until the next readPicture() or
  // the end of record().
  std::optional<grisaille_picture> readPicture(const char* path) const {
    grisaille_picture picture = {};
    picture.struct_size = sizeof(picture);
    if (host_->read_picture(host_, path, &picture) != GRISAILLE_OK) return std::nullopt;
    return picture;
  }

  Sampler sampler(const SamplerSpec& spec) const {
    const grisaille_sampler_desc desc = {.struct_size = sizeof(grisaille_sampler_desc),
                                         .linear = spec.linear ? 1u : 0u,
                                         .linear_mip = spec.linearMip ? 1u : 0u,
                                         .repeat = spec.repeat ? 1u : 0u,
                                         .label = spec.label};
    grisaille_sampler id = {0};
    require(host_->create_sampler(host_, &desc, &id), "a sampler");
    return {host_, id};
  }

 private:
  const grisaille_host* host_;
};

// Pipelines of one shader, made on first use of each set of specialization constants. Keeps the
// `kept` sets used last, so that a slider moved to and fro compiles nothing twice.
class PipelineCache {
 public:
  // `label` and `shader` are static. `kept` counts from 1.
  PipelineCache(Host host, const char* label, const grisaille_shader& shader, size_t kept = 8)
      : host_(host), label_(label), shader_(&shader), kept_(std::max<size_t>(kept, 1)) {}

  // The same constants in another order count as another set. The handle is good until `kept` other
  // sets were asked for. Throws Failure, and keeps what it has then.
  grisaille_pipeline get(std::span<const grisaille_constant> constants) {
    const auto same = [](const grisaille_constant& a, const grisaille_constant& b) {
      return a.id == b.id && a.bits == b.bits;
    };
    auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
      return std::ranges::equal(entry.constants, constants, same);
    });
    if (found == entries_.end()) {
      entries_.push_back({{constants.begin(), constants.end()},
                          host_.computePipeline(label_, *shader_, constants)});
      found = entries_.end() - 1;
    }
    std::rotate(entries_.begin(), found, found + 1);
    if (entries_.size() > kept_) entries_.pop_back();
    return entries_.front().pipeline;
  }
  grisaille_pipeline get(std::initializer_list<grisaille_constant> constants = {}) {
    return get(std::span(constants.begin(), constants.size()));
  }

 private:
  struct Entry {
    std::vector<grisaille_constant> constants;
    Pipeline pipeline;
  };
  Host host_;
  const char* label_;
  const grisaille_shader* shader_;
  size_t kept_;
  std::vector<Entry> entries_;  // the one used last first
};

}  // namespace grisaille::plugin

#endif  // GRISAILLE_EFFECT_HOST_HPP
