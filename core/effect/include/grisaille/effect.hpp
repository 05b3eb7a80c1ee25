// SPDX-License-Identifier: MIT
// The C++20 face of grisaille/effect.h: an author writes a class and a table, nothing else crosses.
// Header-only; it needs that header and the standard library.
//
//   #include "grisaille/effect.hpp"
//   #include "shaders/mist.h"  // made by grisaille_add_effect(mist ... SHADERS mist=mist.comp)
//
//   namespace plugin = grisaille::plugin;
//
//   enum Parameter { kDensity, kSteps };
//   constexpr grisaille_param_desc kParams[] = {
//       plugin::floatParam({.key = "density", .label = "Density", .unit = "",
//                           .tooltip = "Share of light lost over one metre", .hardMin = 0,
//                           .hardMax = 1, .softMin = 0, .softMax = 0.1, .defaultValue = 0.01,
//                           .step = 0.001}),
//       plugin::intParam({.key = "steps", .label = "Steps", .tooltip = "Samples along a ray",
//                         .hardMin = 1, .hardMax = 64, .softMin = 1, .softMax = 16,
//                         .defaultValue = 8})};
//   constexpr grisaille_output_desc kOutputs[] = {
//       plugin::output({.key = "mist", .format = GRISAILLE_FORMAT_R32F,
//                       .role = GRISAILLE_ROLE_VISIBILITY, .tooltip = "1 = clear air"})};
//
//   class Mist {
//    public:
//     explicit Mist(plugin::Host host)
//         : march_(host, "march", grisaille_shader_mist), near_(host.sampler({.label = "n"})) {}
//
//     static uint32_t reads(plugin::Values, uint32_t) noexcept {
//       return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);
//     }
//
//     void record(const plugin::Frame& frame) {
//       const uint32_t steps = frame.value<uint32_t>(kSteps);
//       const grisaille_pipeline march = march_.get({plugin::specialize(0, steps)});
//       const grisaille_range density = frame.uniform(frame.value<float>(kDensity));
//       frame.pass("march", [&] {
//         frame.dispatch(
//             march,
//             {plugin::uniform(0, density), plugin::image(0, frame.output(0)),
//              plugin::texture(0, frame.attachment(GRISAILLE_VIEW_DEPTH), near_)},
//             plugin::groupsFor(frame.width(), 8), plugin::groupsFor(frame.height(), 8));
//       });
//     }
//
//    private:
//     plugin::PipelineCache march_;
//     plugin::Sampler near_;
//   };
//
//   constexpr auto kMist = plugin::effect<Mist>({.key = "mist", .label = "Mist",
//                                                .version = "1.0.0", .tooltip = "Thin air",
//                                                .params = kParams, .outputs = kOutputs});
//   GRISAILLE_EXPORT_PLUGIN(&kMist);
//
// Errors. Whatever the host refuses is thrown as Failure; the class may throw it, or anything else,
// itself. The functions that cross catch everything and report it, so an exception ends the frame
// (or the creation), never the program. After a failed record() the object is used again: keep it
// whole.
//
// Lifetime. The class lives from create to destroy. Host is a view that its members may keep; Frame
// and Values are views that are valid during record() alone.
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

// --- One frame -----------------------------------------------------------------------------------

// What stands in slot n of its class, as the shader's UNIFORM(n), STORAGE(n), TEXTURE(n), IMAGE(n).
constexpr grisaille_binding uniform(uint32_t slot, grisaille_range range) {
  return {.slot_class = GRISAILLE_SLOT_UNIFORM,
          .slot = slot,
          .range = range,
          .texture = {0},
          .sampler = {0},
          .mip = 0,
          .mip_count = 0};
}
constexpr grisaille_binding storage(uint32_t slot, grisaille_range range) {
  grisaille_binding binding = uniform(slot, range);
  binding.slot_class = GRISAILLE_SLOT_STORAGE;
  return binding;
}
// `mipCount` levels from `mip` on; 0: all that follow.
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
constexpr grisaille_binding image(uint32_t slot, grisaille_texture texture, uint32_t mip = 0) {
  return {.slot_class = GRISAILLE_SLOT_IMAGE,
          .slot = slot,
          .range = {},
          .texture = texture,
          .sampler = {0},
          .mip = mip,
          .mip_count = 1};
}
// A whole buffer, for storage().
constexpr grisaille_range whole(grisaille_buffer buffer) {
  return {.buffer = buffer, .reserved = 0, .offset = 0, .size = 0};
}

// Groups of `localSize` threads that cover `pixels`.
constexpr uint32_t groupsFor(uint32_t pixels, uint32_t localSize) {
  return pixels / localSize + (pixels % localSize != 0 ? 1u : 0u);
}

// Is this output among the bits? It counts as the table of outputs does.
template <typename Index>
constexpr bool wants(uint32_t bits, Index output) {
  return (bits >> static_cast<uint32_t>(output) & 1u) != 0;
}

// A view of one frame, valid during record(). Every function that returns nothing or a resource
// throws Failure.
class Frame {
 public:
  explicit Frame(const grisaille_frame* frame) : frame_(frame) {}

  uint32_t width() const { return frame_->width; }  // pixels
  uint32_t height() const { return frame_->height; }
  // Pixels by which attachments go beyond the picture on each side.
  uint32_t guard() const { return frame_->guard; }
  uint64_t index() const { return frame_->index; }  // counts this instance's frames from 0

  Values values() const { return Values(frame_->values); }
  template <typename T, typename Index>
  T value(Index parameter) const {
    return values().get<T>(parameter);
  }

  const grisaille_view& view() const { return *frame_->view; }
  grisaille_range viewBlock() const { return frame_->view_block; }

  // Id 0 unless reads() asked for it with these values.
  grisaille_texture attachment(grisaille_attachment attachment) const {
    return frame_->attachments[attachment];
  }
  // By index in the table of outputs. Those that nobody wants have id 0.
  template <typename Index>
  bool wanted(Index output) const {
    return wants(frame_->wanted, output);
  }
  template <typename Index>
  grisaille_texture output(Index output) const {
    return frame_->outputs[static_cast<size_t>(output)];
  }

  // The objects that users made, oldest first; none unless the effect's table declares them. T is
  // laid out as that table says. Throws Failure where its size is not the table's.
  template <typename T>
  std::span<const T> objects() const {
    const grisaille_objects* list = frame_->objects;
    if (list == nullptr) return {};
    if (list->stride != sizeof(T)) throw Failure("the objects are of another size than their type");
    return {static_cast<const T*>(list->objects), static_cast<size_t>(list->count)};
  }
  // Number of leading objects unchanged since the last frame that record() ended without throwing.
  size_t objectsKept() const {
    return frame_->objects == nullptr ? 0 : static_cast<size_t>(frame_->objects->kept);
  }
  // Seconds of work that can wait which this frame may still do.
  double patience() const { return frame_->patience; }
  // Tells how many things wait to be drawn in a later frame.
  void waiting(uint64_t count) const { require(frame_->waiting(frame_, count), "waiting"); }

  // Calls work(), which records the pass. Passes do not nest. When work() throws, the pass is ended
  // all the same.
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

  // Inside a pass.
  void dispatch(grisaille_pipeline pipeline, std::span<const grisaille_binding> bindings,
                uint32_t groupsX, uint32_t groupsY, uint32_t groupsZ = 1) const {
    const grisaille_dispatch work = {.struct_size = sizeof(grisaille_dispatch),
                                     .pipeline = pipeline,
                                     .bindings = bindings.data(),
                                     .binding_count = static_cast<uint32_t>(bindings.size()),
                                     .groups = {groupsX, groupsY, groupsZ}};
    require(frame_->dispatch(frame_, &work), "dispatches");
  }
  void dispatch(grisaille_pipeline pipeline, std::initializer_list<grisaille_binding> bindings,
                uint32_t groupsX, uint32_t groupsY, uint32_t groupsZ = 1) const {
    dispatch(pipeline, std::span(bindings.begin(), bindings.size()), groupsX, groupsY, groupsZ);
  }

  // A copy of `block`, laid out as the shader's std140 block, for this frame.
  template <typename Block>
  requires std::is_trivially_copyable_v<Block> grisaille_range uniform(const Block& block)
  const {
    static_assert(sizeof(Block) <= 65536, "a uniform block holds at most 65536 bytes");
    grisaille_range range = {};
    require(frame_->uniform(frame_, &block, sizeof(Block), &range), "uniform blocks");
    return range;
  }

  // A texture for this frame alone, contents undefined; the host's, not to be destroyed.
  grisaille_texture transient(const TextureSpec& spec) const {
    const grisaille_texture_desc desc = textureDesc(spec);
    grisaille_texture id = {0};
    require(frame_->transient(frame_, &desc, &id), "transient textures");
    return id;
  }

  // Copies a contiguous range into a buffer from byte `offset` on, or into the whole of one level
  // and layer of a texture: rows tightly packed, top row first.
  template <std::ranges::contiguous_range Data>
  void uploadBuffer(grisaille_buffer buffer, uint64_t offset, const Data& data) const {
    const auto bytes = std::as_bytes(std::span(data));
    require(frame_->upload_buffer(frame_, buffer, offset, bytes.data(), bytes.size()), "uploads");
  }
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

// --- The effect ----------------------------------------------------------------------------------

// It may want a guard band, as grisaille_effect_desc.guard_band has it.
template <typename E>
concept WantsGuardBand = requires(Values values) {
  { E::guardBand(values) }
  noexcept->std::same_as<double>;
};

template <typename E>
concept EffectClass = std::constructible_from<E, Host> && std::is_nothrow_destructible_v<E> &&
    requires(E& effect, const Frame& frame, Values values, uint32_t wanted) {
  { E::reads(values, wanted) }
  noexcept->std::same_as<uint32_t>;
  effect.record(frame);
};

// All static: text, and the arrays behind the spans.
struct EffectSpec {
  const char* key = nullptr;
  const char* label = nullptr;
  const char* version = nullptr;
  const char* tooltip = nullptr;
  std::span<const grisaille_param_desc> params;
  std::span<const grisaille_output_desc> outputs;
  const grisaille_object_desc* objects = nullptr;  // null: users make none
  bool runsByDefault = false;                      // of the program's own effects alone
};

// The functions that cross, for one class.
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
      // The host knows why, in better words than these.
    } catch (const std::exception& error) {
      host->fail(host, error.what());
    } catch (...) {
      host->fail(host, "an exception that is no std::exception");
    }
    return GRISAILLE_FAILED;
  }
};

template <EffectClass E>
constexpr grisaille_effect_desc effect(const EffectSpec& spec) {
  return {.struct_size = sizeof(grisaille_effect_desc),
          .param_count = static_cast<uint32_t>(spec.params.size()),
          .output_count = static_cast<uint32_t>(spec.outputs.size()),
          .flags = spec.runsByDefault ? uint32_t{GRISAILLE_EFFECT_DEFAULT} : 0u,
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
          .objects = spec.objects};
}

}  // namespace grisaille::plugin

// Once in a plugin, at namespace scope: exports the effects whose addresses it is given, which are
// static constants of type grisaille_effect_desc.
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
