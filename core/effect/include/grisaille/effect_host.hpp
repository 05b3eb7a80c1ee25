// SPDX-License-Identifier: MIT
/// @file
/// The host's services in C++: errors, owned resources, pipelines. Part of effect.hpp.
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

/// @addtogroup effect_results
/// @{

/// The reason why an effect cannot continue, in one line for the user.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A call that the host refused. The host has recorded the reason; the exception only unwinds.
class HostRefused : public Failure {
 public:
  using Failure::Failure;
};

/// Throws unless a call succeeded.
/// @param result the result of the call
/// @param service the service that the call requests, for the message: "a texture"
/// @throws Failure the host does not offer the service
/// @throws HostRefused the call failed
inline void require(grisaille_result result, const char* service) {
  if (result == GRISAILLE_OK) return;
  if (result == GRISAILLE_UNSUPPORTED) {
    throw Failure(std::string("this host does not offer ") + service);
  }
  throw HostRefused(service);
}

/// @}
/// @addtogroup effect_resources
/// @{

/// Owns one resource of the host and destroys it. It must not outlive the effect's object.
/// @tparam Id the C handle
/// @tparam kDestroy the function of grisaille_host that destroys it
template <typename Id, void (*grisaille_host::*kDestroy)(const grisaille_host*, Id)>
class Owned {
 public:
  Owned() = default;  ///< Owns nothing.
  /// Owns a resource.
  /// @param host the host that created it
  /// @param id the resource
  Owned(const grisaille_host* host, Id id) : host_(host), id_(id) {}
  /// Takes the resource of another owner.
  /// @param other afterwards owns nothing
  Owned(Owned&& other) noexcept
      : host_(std::exchange(other.host_, nullptr)), id_(std::exchange(other.id_, Id{0})) {}
  /// Takes the resource of another owner, and destroys its own.
  /// @param other afterwards owns nothing
  /// @return this
  Owned& operator=(Owned&& other) noexcept {
    Owned taken(std::move(other));
    std::swap(host_, taken.host_);
    std::swap(id_, taken.id_);
    return *this;
  }
  ~Owned() {
    if (id_.id != 0) (host_->*kDestroy)(host_, id_);
  }

  /// @return the C handle, which this owner keeps owning
  operator Id() const { return id_; }
  /// @return whether it owns a resource
  explicit operator bool() const { return id_.id != 0; }

 private:
  const grisaille_host* host_ = nullptr;
  Id id_ = {0};
};

/// Owns a compute pipeline.
using Pipeline = Owned<grisaille_pipeline, &grisaille_host::destroy_pipeline>;
/// Owns a texture.
using Texture = Owned<grisaille_texture, &grisaille_host::destroy_texture>;
/// Owns a buffer.
using Buffer = Owned<grisaille_buffer, &grisaille_host::destroy_buffer>;
/// Owns a sampler.
using Sampler = Owned<grisaille_sampler, &grisaille_host::destroy_sampler>;

/// Describes a 2D texture.
struct TextureSpec {
  const char* label = nullptr;                      ///< for messages and debuggers; may be null
  grisaille_format format = GRISAILLE_FORMAT_R32F;  ///< its format
  uint32_t width = 0;                               ///< texels, 1 to the device's limit
  uint32_t height = 0;                              ///< texels, 1 to the device's limit
  /// grisaille_texture_usage combined
  uint32_t usage = GRISAILLE_TEXTURE_SAMPLED | GRISAILLE_TEXTURE_STORAGE;
  uint32_t mips = 1;    ///< number of levels
  uint32_t layers = 1;  ///< number of layers
};

/// Converts a description of a texture to the struct of the C interface.
/// @param spec describes the texture
/// @return the struct
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

/// Describes a sampler.
struct SamplerSpec {
  const char* label = nullptr;  ///< for messages and debuggers; may be null
  bool linear = false;          ///< true: bilinear within a level; false: nearest
  bool linearMip = false;       ///< true: linear between levels; false: nearest
  bool repeat = false;          ///< true: repeat; false: clamp to the edge
};

/// Returns a specialization constant with its value.
/// @param id constant_id in the shader
/// @param value the value
/// @return the constant, for PipelineCache::get() and Host::computePipeline()
constexpr grisaille_constant specialize(uint32_t id, uint32_t value) {
  return {id, value};
}
/// @copydoc specialize(uint32_t,uint32_t)
constexpr grisaille_constant specialize(uint32_t id, int32_t value) {
  return {id, std::bit_cast<uint32_t>(value)};
}
/// @copydoc specialize(uint32_t,uint32_t)
constexpr grisaille_constant specialize(uint32_t id, float value) {
  return {id, std::bit_cast<uint32_t>(value)};
}
/// @copydoc specialize(uint32_t,uint32_t)
constexpr grisaille_constant specialize(uint32_t id, bool value) {
  return {id, value ? 1u : 0u};
}

/// @}
/// @addtogroup effect_host
/// @{

/// A view of the host for one instance; copy it freely. Every function that returns a resource may
/// throw Failure.
class Host {
 public:
  /// @param host the services that create() gets
  explicit Host(const grisaille_host* host) : host_(host) {}

  /// Creates a compute pipeline.
  /// @param label for messages and debuggers; may be null
  /// @param shader a compute shader; valid while the pipeline lives
  /// @param constants values of specialization constants; the others keep their defaults
  /// @return the pipeline, which the caller owns
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
  /// @copydoc computePipeline()
  Pipeline computePipeline(const char* label, const grisaille_shader& shader,
                           std::initializer_list<grisaille_constant> constants = {}) const {
    return computePipeline(label, shader, std::span(constants.begin(), constants.size()));
  }

  /// Creates a texture. Its contents are undefined.
  /// @param spec describes the texture
  /// @return the texture, which the caller owns
  Texture texture(const TextureSpec& spec) const {
    const grisaille_texture_desc desc = textureDesc(spec);
    grisaille_texture id = {0};
    require(host_->create_texture(host_, &desc, &id), "a texture");
    return {host_, id};
  }

  /// Creates a storage buffer. Its contents are undefined.
  /// @param label for messages and debuggers; may be null
  /// @param bytes size, 1 to the device's limit
  /// @return the buffer, which the caller owns
  Buffer buffer(const char* label, uint64_t bytes) const {
    const grisaille_buffer_desc desc = {.struct_size = sizeof(grisaille_buffer_desc),
                                        .reserved = 0,
                                        .bytes = bytes,
                                        .label = label};
    grisaille_buffer id = {0};
    require(host_->create_buffer(host_, &desc, &id), "a buffer");
    return {host_, id};
  }

  /// Casts rays through the scene. Call it only inside record() and drawAt().
  /// @param rays the rays
  /// @param[out] hits one per ray
  /// @return false if the host does not cast rays
  /// @throws Failure a ray is outside the limits of grisaille_ray
  bool castRays(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) const {
    const grisaille_result result =
        host_->cast_rays(host_, rays.data(), std::min(rays.size(), hits.size()), hits.data());
    if (result == GRISAILLE_UNSUPPORTED) return false;
    require(result, "rays");
    return true;
  }

  /// Draws the first surface that a point sees in each direction. Call it only inside record().
  /// @param view origin, direction and size of the picture
  /// @param[out] depth `size` x `size` values, see grisaille_host::draw_depth
  /// @return false if the host does not draw depth pictures
  /// @throws Failure the view is outside the limits of grisaille_depth_view
  bool drawDepth(const grisaille_depth_view& view, std::span<float> depth) const {
    const grisaille_result result = host_->draw_depth(host_, &view, depth.data());
    if (result == GRISAILLE_UNSUPPORTED) return false;
    require(result, "a depth picture");
    return true;
  }

  /// Decodes a picture file. Call it only inside record().
  /// @param path path of the file
  /// @return the picture, or nullopt if the host does not decode pictures or cannot read the file;
  /// the host warns the user about the file. The pixels are valid until the next readPicture() or
  /// the end of record().
  std::optional<grisaille_picture> readPicture(const char* path) const {
    grisaille_picture picture = {};
    picture.struct_size = sizeof(picture);
    if (host_->read_picture(host_, path, &picture) != GRISAILLE_OK) return std::nullopt;
    return picture;
  }

  /// Creates a sampler.
  /// @param spec describes the sampler
  /// @return the sampler, which the caller owns
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

/// A cache of one shader's pipelines, one per set of specialization constants, created on first
/// use. It keeps the most recently used sets, so that a slider moved back compiles no pipeline
/// again.
class PipelineCache {
 public:
  /// Does not create a pipeline yet.
  /// @param host the host
  /// @param label for messages and debuggers; static; may be null
  /// @param shader a compute shader; static
  /// @param kept number of sets to keep, at least 1
  PipelineCache(Host host, const char* label, const grisaille_shader& shader, size_t kept = 8)
      : host_(host), label_(label), shader_(&shader), kept_(std::max<size_t>(kept, 1)) {}

  /// Returns the pipeline for a set of constants.
  /// @param constants the set; the same constants in another order are a different set
  /// @return the pipeline, which the cache owns; valid until get() is called with `kept` others
  /// @throws Failure the host refuses the pipeline; the cache keeps its pipelines
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
  /// @copydoc get()
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
  std::vector<Entry> entries_;  // most recently used first
};

/// @}

}  // namespace grisaille::plugin

#endif  // GRISAILLE_EFFECT_HOST_HPP
