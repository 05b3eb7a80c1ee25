// SPDX-License-Identifier: MIT
/// @file
/// The C++20 interface of an effect, a layer over effect.h: the author writes a class and a table.
/// Header-only; it needs effect.h and the standard library.
///
/// @code{.cpp}
/// #include "grisaille/effect.hpp"
/// #include "shaders/mist.h"  // made by grisaille_add_effect(mist ... SHADERS mist=mist.comp)
///
/// namespace plugin = grisaille::plugin;
///
/// enum Parameter { kDensity, kSteps };
/// constexpr grisaille_param_desc kParams[] = {
///     plugin::floatParam({.key = "density", .label = "Density", .unit = "",
///                         .tooltip = "Share of light lost over one metre", .hardMin = 0,
///                         .hardMax = 1, .softMin = 0, .softMax = 0.1, .defaultValue = 0.01,
///                         .step = 0.001}),
///     plugin::intParam({.key = "steps", .label = "Steps", .tooltip = "Samples along a ray",
///                       .hardMin = 1, .hardMax = 64, .softMin = 1, .softMax = 16,
///                       .defaultValue = 8})};
/// constexpr grisaille_output_desc kOutputs[] = {
///     plugin::output({.key = "mist", .format = GRISAILLE_FORMAT_R32F,
///                     .role = GRISAILLE_ROLE_VISIBILITY, .tooltip = "1 = clear air"})};
///
/// class Mist {
///  public:
///   explicit Mist(plugin::Host host)
///       : march_(host, "march", grisaille_shader_mist), near_(host.sampler({.label = "n"})) {}
///
///   static uint32_t reads(plugin::Values, uint32_t) noexcept {
///     return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);
///   }
///
///   void record(const plugin::Frame& frame) {
///     const uint32_t steps = frame.value<uint32_t>(kSteps);
///     const grisaille_pipeline march = march_.get({plugin::specialize(0, steps)});
///     const grisaille_range density = frame.uniform(frame.value<float>(kDensity));
///     frame.pass("march", [&] {
///       frame.dispatch(
///           march,
///           {plugin::uniform(0, density), plugin::image(0, frame.output(0)),
///            plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), near_)},
///           plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
///     });
///   }
///
///  private:
///   plugin::PipelineCache march_;
///   plugin::Sampler near_;
/// };
///
/// constexpr auto kMist = plugin::effect<Mist>({.key = "mist", .label = "Mist",
///                                              .version = "1.0.0", .tooltip = "Thin air",
///                                              .params = kParams, .outputs = kOutputs});
/// GRISAILLE_EXPORT_PLUGIN(&kMist);
/// @endcode
///
/// @par Errors
/// A function throws Failure when the host refuses a call. The class may throw Failure or any other
/// exception. The functions behind the C interface catch every exception and report it: an
/// exception ends the frame or the creation, never the program. After a failed record() the host
/// calls record() on the same object again, so leave it in a valid state.
///
/// @par Lifetime
/// The object lives from create to destroy. It may keep a Host in its members: Host is a view that
/// stays valid as long. Frame and Values are views that are valid only during record().
#ifndef GRISAILLE_EFFECT_HPP
#define GRISAILLE_EFFECT_HPP

#include <concepts>
#include <cstddef>
#include <exception>
#include <initializer_list>
#include <ranges>
#include <span>
#include <type_traits>

#include "grisaille/effect.h"
#include "grisaille/effect_host.hpp"
#include "grisaille/effect_table.hpp"

namespace grisaille::plugin {

/// @addtogroup effect_resources
/// @{

/// Binds a part of a buffer to the shader's UNIFORM(slot).
/// @param slot 0 to 15
/// @param range the part of the buffer
/// @return the binding, for Frame::dispatch()
constexpr grisaille_binding uniform(uint32_t slot, grisaille_range range) {
  return {.slot_class = GRISAILLE_SLOT_UNIFORM,
          .slot = slot,
          .range = range,
          .texture = {0},
          .sampler = {0},
          .mip = 0,
          .mip_count = 0};
}
/// Binds a part of a buffer to the shader's STORAGE(slot).
/// @param slot 0 to 15
/// @param range the part of the buffer
/// @return the binding, for Frame::dispatch()
constexpr grisaille_binding storage(uint32_t slot, grisaille_range range) {
  grisaille_binding binding = uniform(slot, range);
  binding.slot_class = GRISAILLE_SLOT_STORAGE;
  return binding;
}
/// Binds a texture and its sampler to the shader's TEXTURE(slot).
/// @param slot 0 to 15
/// @param texture the texture
/// @param sampler the sampler
/// @param mip the first level
/// @param mipCount number of levels; 0: all from `mip` on
/// @return the binding, for Frame::dispatch()
constexpr grisaille_binding texture(uint32_t slot, grisaille_texture texture,
                                    grisaille_sampler sampler, uint32_t mip = 0,
                                    uint32_t mipCount = 0) {
  return {.slot_class = GRISAILLE_SLOT_TEXTURE,
          .slot = slot,
          .range = {},
          .texture = texture,
          .sampler = sampler,
          .mip = mip,
          .mip_count = mipCount};
}
/// Binds one level of a texture to the shader's IMAGE(slot).
/// @param slot 0 to 15
/// @param texture the texture
/// @param mip the level
/// @return the binding, for Frame::dispatch()
constexpr grisaille_binding image(uint32_t slot, grisaille_texture texture, uint32_t mip = 0) {
  return {.slot_class = GRISAILLE_SLOT_IMAGE,
          .slot = slot,
          .range = {},
          .texture = texture,
          .sampler = {0},
          .mip = mip,
          .mip_count = 1};
}
/// Returns the range of a whole buffer, for storage().
/// @param buffer the buffer
/// @return the range
constexpr grisaille_range whole(grisaille_buffer buffer) {
  return {.buffer = buffer, .reserved = 0, .offset = 0, .size = 0};
}

/// Returns the number of workgroups that cover one axis of a picture.
/// @param pixels pixels on the axis
/// @param localSize threads per workgroup on the axis, over 0
/// @return pixels / localSize, rounded up
constexpr uint32_t groupsFor(uint32_t pixels, uint32_t localSize) {
  return pixels / localSize + (pixels % localSize != 0 ? 1u : 0u);
}

/// @}
/// @addtogroup effect_frame
/// @{

/// Returns whether an output is in use.
/// @param bits grisaille_frame::wanted
/// @param output index in the table of outputs, or an enum with the table's order
/// @return whether the output's bit is set
template <typename Index>
constexpr bool wants(uint32_t bits, Index output) {
  return (bits >> static_cast<uint32_t>(output) & 1u) != 0;
}

/// @cond
template <typename T>
std::span<const T> objectsOf(const grisaille_objects* list) {
  if (list == nullptr) return {};
  if (list->stride != sizeof(T)) throw Failure("the objects do not have the size of their type");
  return {static_cast<const T*>(list->objects), static_cast<size_t>(list->count)};
}
inline size_t keptOf(const grisaille_objects* list) {
  return list == nullptr ? 0 : static_cast<size_t>(list->kept);
}
/// @endcond

/// A view of one frame, valid during record(). Every function that returns nothing or creates a
/// resource may throw Failure.
class Frame {
 public:
  /// @param frame the frame that record() gets
  explicit Frame(const grisaille_frame* frame) : frame_(frame) {}

  /// @return pixels of every output, and of every attachment without guard band
  uint32_t width() const { return frame_->width; }
  /// @return pixels; see width()
  uint32_t height() const { return frame_->height; }
  /// @return the guard band: pixels by which attachments extend beyond the picture on each side
  uint32_t guard() const { return frame_->guard; }
  /// @return number of this frame, counted from 0 for each instance
  uint64_t index() const { return frame_->index; }

  /// @return the values of all parameters
  Values values() const { return Values(frame_->values); }
  /// Returns the value of one parameter.
  /// @tparam T see Values::get()
  /// @param parameter index in the table of parameters, or an enum with the table's order
  /// @return the value
  template <typename T, typename Index>
  T value(Index parameter) const {
    return values().get<T>(parameter);
  }

  /// @return the camera
  const grisaille_view& view() const { return *frame_->view; }
  /// @return the uniform buffer for shaders/common/view.glsl
  grisaille_range viewBlock() const { return frame_->view_block; }

  /// Returns an attachment.
  /// @param attachment the attachment
  /// @return the texture; id 0 unless reads() returned the attachment for these values, and for
  ///   motion that the host lacks
  grisaille_texture attachment(grisaille_attachment attachment) const {
    return frame_->attachments[attachment];
  }
  /// Returns a texture that the effect reads by name.
  /// @param input index in the table of inputs, or an enum with the table's order
  /// @return the texture; id 0 if it is missing
  template <typename Index>
  grisaille_texture input(Index input) const {
    return frame_->inputs[static_cast<size_t>(input)];
  }
  /// Returns whether an output is in use.
  /// @param output index in the table of outputs, or an enum with the table's order
  /// @return whether the effect must write it
  template <typename Index>
  bool wanted(Index output) const {
    return wants(frame_->wanted, output);
  }
  /// Returns the texture of an output.
  /// @param output index in the table of outputs, or an enum with the table's order
  /// @return the texture to write; id 0 if the output is not in use
  template <typename Index>
  grisaille_texture output(Index output) const {
    return frame_->outputs[static_cast<size_t>(output)];
  }

  /// Returns the objects that users made, oldest first.
  /// @tparam T the effect's struct, laid out as the table of objects says
  /// @return the objects; empty unless the effect's table declares objects
  /// @throws Failure the size of T differs from the table's object_size
  template <typename T>
  std::span<const T> objects() const {
    return objectsOf<T>(frame_->objects);
  }
  /// @return number of leading objects unchanged since the last record() or drawAt() that did not
  ///   throw
  size_t objectsKept() const { return keptOf(frame_->objects); }
  /// @return seconds that the effect may spend in this frame on work that can wait; may be infinite
  double patience() const { return frame_->patience; }
  /// Reports how many pieces of work wait for a later frame. The host then renders again soon.
  /// @param count number of waiting pieces; 0 (the value without a call): the picture is complete
  void waiting(uint64_t count) const { require(frame_->waiting(frame_, count), "waiting"); }
  /// Reports how many objects a limit leaves no room for. The host tells the user.
  /// @param count number of leading objects without effect; 0 (the value without a call): none
  void givenUp(uint64_t count) const { require(frame_->given_up(frame_, count), "given_up"); }
  /// Reports how many objects are drawn less exactly because of a limit. The host tells the user.
  /// @param count number of these objects; 0 (the value without a call): none
  void coarser(uint64_t count) const { require(frame_->coarser(frame_, count), "coarser"); }

  /// Records a pass: a named, timed group of commands. Passes do not nest.
  /// @param label names the pass
  /// @param work records the commands; if it throws, the pass still ends
  template <std::invocable Work>
  void pass(const char* label, Work&& work) const {
    require(frame_->begin_pass(frame_, label), "passes");
    try {
      work();
    } catch (...) {
      frame_->end_pass(frame_);
      throw;
    }
    require(frame_->end_pass(frame_), "passes");
  }

  /// Records a dispatch, which sees the results of all commands recorded before it. Call it only
  /// inside a pass.
  /// @param pipeline a pipeline of this instance
  /// @param bindings one per slot that the shader uses
  /// @param groupsX workgroups on the first axis
  /// @param groupsY workgroups on the second axis
  /// @param groupsZ workgroups on the third axis
  void dispatch(grisaille_pipeline pipeline, std::span<const grisaille_binding> bindings,
                uint32_t groupsX, uint32_t groupsY, uint32_t groupsZ = 1) const {
    const grisaille_dispatch work = {.struct_size = sizeof(grisaille_dispatch),
                                     .pipeline = pipeline,
                                     .bindings = bindings.data(),
                                     .binding_count = static_cast<uint32_t>(bindings.size()),
                                     .groups = {groupsX, groupsY, groupsZ}};
    require(frame_->dispatch(frame_, &work), "dispatches");
  }
  /// @copydoc dispatch()
  void dispatch(grisaille_pipeline pipeline, std::initializer_list<grisaille_binding> bindings,
                uint32_t groupsX, uint32_t groupsY, uint32_t groupsZ = 1) const {
    dispatch(pipeline, std::span(bindings.begin(), bindings.size()), groupsX, groupsY, groupsZ);
  }

  /// Copies a struct into a uniform buffer for this frame.
  /// @param block the struct, laid out as the shader's std140 block, at most 65536 bytes
  /// @return the part of a buffer that holds the copy
  template <typename Block>
  requires std::is_trivially_copyable_v<Block> grisaille_range uniform(const Block& block)
  const {
    static_assert(sizeof(Block) <= 65536, "a uniform block holds at most 65536 bytes");
    grisaille_range range = {};
    require(frame_->uniform(frame_, &block, sizeof(Block), &range), "uniform blocks");
    return range;
  }

  /// Creates a texture for this frame only. Its contents are undefined.
  /// @param spec describes the texture
  /// @return the texture, which the host owns
  grisaille_texture transient(const TextureSpec& spec) const {
    const grisaille_texture_desc desc = textureDesc(spec);
    grisaille_texture id = {0};
    require(frame_->transient(frame_, &desc, &id), "transient textures");
    return id;
  }

  /// Copies data into a buffer of this instance.
  /// @param buffer the buffer
  /// @param offset bytes from the start of the buffer
  /// @param data a contiguous range that fits into the buffer from `offset` on
  template <std::ranges::contiguous_range Data>
  void uploadBuffer(grisaille_buffer buffer, uint64_t offset, const Data& data) const {
    const auto bytes = std::as_bytes(std::span(data));
    require(frame_->upload_buffer(frame_, buffer, offset, bytes.data(), bytes.size()), "uploads");
  }
  /// Copies texels into one whole mip level of one layer.
  /// @param texture a texture of this instance or of the frame, but not an attachment
  /// @param data a contiguous range of rows, tightly packed, top row first
  /// @param mip the level
  /// @param layer the layer
  template <std::ranges::contiguous_range Data>
  void uploadTexture(grisaille_texture texture, const Data& data, uint32_t mip = 0,
                     uint32_t layer = 0) const {
    const auto bytes = std::as_bytes(std::span(data));
    require(frame_->upload_texture(frame_, texture, mip, layer, bytes.data(), bytes.size()),
            "uploads");
  }

 private:
  const grisaille_frame* frame_;
};

/// @}
/// @addtogroup effect_points
/// @{

/// A view of points of surfaces, valid during drawAt().
class Points {
 public:
  /// @param points the points that drawAt() gets
  explicit Points(const grisaille_points* points) : points_(points) {}

  /// @return the points
  std::span<const grisaille_point> all() const {
    return {points_->points, static_cast<size_t>(points_->count)};
  }
  /// @return one result per point, preset to 0
  std::span<grisaille_drawn> drawn() const {
    return {points_->drawn, static_cast<size_t>(points_->count)};
  }
  /// @return the values of all parameters
  Values values() const { return Values(points_->values); }
  /// @copydoc Frame::value()
  template <typename T, typename Index>
  T value(Index parameter) const {
    return values().get<T>(parameter);
  }
  /// @copydoc Frame::objects()
  template <typename T>
  std::span<const T> objects() const {
    return objectsOf<T>(points_->objects);
  }
  /// @return number of leading objects unchanged since the last record() or drawAt() that did not
  ///   throw
  size_t objectsKept() const { return keptOf(points_->objects); }

 private:
  const grisaille_points* points_;
};

/// @}
/// @addtogroup effect_table
/// @{

/// A class with a function `drawAt(const Points&)`: see grisaille_effect_desc::draw_at.
template <typename E>
concept DrawsAtPoints = requires(E& effect, const Points& points) {
  effect.drawAt(points);
};

/// A class with a static function `guardBand(Values)`: see grisaille_effect_desc::guard_band.
template <typename E>
concept WantsGuardBand = requires(Values values) {
  { E::guardBand(values) }
  noexcept->std::same_as<double>;
};

/// A class that effect() accepts. It has a constructor that takes a Host, a static noexcept
/// function `uint32_t reads(Values, uint32_t wanted)` (see grisaille_effect_desc::reads), and a
/// function `record(const Frame&)` (see grisaille_effect_desc::record). Its destructor does not
/// throw.
template <typename E>
concept EffectClass = std::constructible_from<E, Host> && std::is_nothrow_destructible_v<E> &&
    requires(E& effect, const Frame& frame, Values values, uint32_t wanted) {
  { E::reads(values, wanted) }
  noexcept->std::same_as<uint32_t>;
  effect.record(frame);
};

/// Describes an effect, for effect(). All strings and arrays are static.
struct EffectSpec {
  const char* key = nullptr;                       ///< a key: "ssao"; unique among effects
  const char* label = nullptr;                     ///< name shown to users: "Ambient occlusion"
  const char* version = nullptr;                   ///< "1.0.0"
  const char* tooltip = nullptr;                   ///< one line: what the effect does
  std::span<const grisaille_param_desc> params;    ///< 0 to 256 entries
  std::span<const grisaille_output_desc> outputs;  ///< 1 to 16 entries
  const grisaille_object_desc* objects = nullptr;  ///< objects that users make; null: no objects
  /// whether the effect runs when the user names no effects; only for the program's own effects
  bool runsByDefault = false;
  bool keepsHistory = false;                          ///< see #GRISAILLE_EFFECT_HISTORY
  bool wantsJitter = false;                           ///< see #GRISAILLE_EFFECT_JITTER
  uint32_t needs = 0;                                 ///< see grisaille_effect_desc::needs
  std::span<const grisaille_input_desc> inputs = {};  ///< textures read by name, 0 to 16 entries
};

/// @cond
// The functions of the C interface for one effect class.
template <EffectClass E>
class Boundary {
 public:
  static uint32_t reads(const double* values, uint32_t wanted) noexcept {
    return E::reads(Values(values), wanted);
  }

  static double guardBand(const double* values) noexcept {
    if constexpr (WantsGuardBand<E>) {
      return E::guardBand(Values(values));
    } else {
      return 0;
    }
  }

  static grisaille_result create(const grisaille_host* host, void** out) noexcept {
    return guarded(host, [&] { *out = new Held(host); });
  }

  static grisaille_result record(void* instance, const grisaille_frame* frame) noexcept {
    Held* held = static_cast<Held*>(instance);
    return guarded(held->host, [&] { held->effect.record(Frame(frame)); });
  }

  static grisaille_result drawAt(void* instance, const grisaille_points* points) noexcept requires
      DrawsAtPoints<E> {
    Held* held = static_cast<Held*>(instance);
    return guarded(held->host, [&] { held->effect.drawAt(Points(points)); });
  }
  static constexpr auto drawAtOrNull() -> decltype(grisaille_effect_desc::draw_at) {
    if constexpr (DrawsAtPoints<E>) {
      return drawAt;
    } else {
      return nullptr;
    }
  }

  static void destroy(void* instance) noexcept { delete static_cast<Held*>(instance); }

 private:
  struct Held {
    explicit Held(const grisaille_host* h) : host(h), effect(Host(h)) {}
    const grisaille_host* host;
    E effect;
  };

  template <typename Work>
  static grisaille_result guarded(const grisaille_host* host, Work&& work) noexcept {
    try {
      work();
      return GRISAILLE_OK;
    } catch (const HostRefused&) {
      // The host has already recorded the reason, in more detail.
    } catch (const std::exception& error) {
      host->fail(host, error.what());
    } catch (...) {
      host->fail(host, "an exception that is not a std::exception");
    }
    return GRISAILLE_FAILED;
  }
};

/// @endcond

/// Returns the table of an effect.
/// @tparam E the class of the effect's instances
/// @param spec the effect
/// @return the table
template <EffectClass E>
constexpr grisaille_effect_desc effect(const EffectSpec& spec) {
  return {.struct_size = sizeof(grisaille_effect_desc),
          .param_count = static_cast<uint32_t>(spec.params.size()),
          .output_count = static_cast<uint32_t>(spec.outputs.size()),
          .flags = (spec.runsByDefault ? uint32_t{GRISAILLE_EFFECT_DEFAULT} : 0u) |
                   (spec.keepsHistory ? uint32_t{GRISAILLE_EFFECT_HISTORY} : 0u) |
                   (spec.wantsJitter ? uint32_t{GRISAILLE_EFFECT_JITTER} : 0u),
          .key = spec.key,
          .label = spec.label,
          .version = spec.version,
          .tooltip = spec.tooltip,
          .params = spec.params.data(),
          .outputs = spec.outputs.data(),
          .reads = Boundary<E>::reads,
          .create = Boundary<E>::create,
          .record = Boundary<E>::record,
          .destroy = Boundary<E>::destroy,
          .guard_band = Boundary<E>::guardBand,
          .objects = spec.objects,
          .draw_at = Boundary<E>::drawAtOrNull(),
          .needs = spec.needs,
          .input_count = static_cast<uint32_t>(spec.inputs.size()),
          .inputs = spec.inputs.data()};
}

/// @}

}  // namespace grisaille::plugin

/// @ingroup effect_table
/// Exports the effects of a plugin. Write it once per plugin, at namespace scope. Its arguments
/// are the addresses of static constants of type grisaille_effect_desc.
#define GRISAILLE_EXPORT_PLUGIN(...)                                                   \
  namespace {                                                                          \
  constexpr const grisaille_effect_desc* kGrisailleEffects[] = {__VA_ARGS__};          \
  }                                                                                    \
  extern "C" {                                                                         \
  extern GRISAILLE_EXPORT const grisaille_plugin_desc grisaille_plugin;                \
  const grisaille_plugin_desc grisaille_plugin = {                                     \
      GRISAILLE_MAGIC,                                                                 \
      GRISAILLE_ABI_MAJOR,                                                             \
      GRISAILLE_ABI_MINOR,                                                             \
      sizeof(grisaille_plugin_desc),                                                   \
      static_cast<uint32_t>(sizeof(kGrisailleEffects) / sizeof(kGrisailleEffects[0])), \
      0,                                                                               \
      kGrisailleEffects};                                                              \
  }                                                                                    \
  static_assert(true)

#endif  // GRISAILLE_EFFECT_HPP
