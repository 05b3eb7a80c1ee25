// SPDX-License-Identifier: MIT
#include "core/gpu/state_tracker.h"

#include "core/base/error.h"

namespace grisaille::gpu {
namespace {

bool needsBarrier(Access before, Access after) {
  return before != after || has(before, kWriteAccess);
}

}  // namespace

void StateTracker::add(Buffer buffer) {
  buffers_[buffer.value] = {};
}

void StateTracker::add(Texture texture, uint32_t mips, uint32_t layers) {
  TextureState& state = textures_[texture.value];
  state.mips = mips;
  state.layers = layers;
  state.states.assign(size_t{mips} * layers, Access::kNone);
  state.pending.assign(size_t{mips} * layers, Access::kNone);
  state.touched = false;
}

void StateTracker::remove(Buffer buffer) {
  buffers_.erase(buffer.value);
}
void StateTracker::remove(Texture texture) {
  textures_.erase(texture.value);
}

void StateTracker::use(Buffer buffer, Access access) {
  const auto found = buffers_.find(buffer.value);
  if (found == buffers_.end() || access == Access::kNone) return;
  if (found->second.pending == Access::kNone) touchedBuffers_.push_back(buffer.value);
  found->second.pending = found->second.pending | access;
}

void StateTracker::use(TextureView view, Access access) {
  const auto found = textures_.find(view.texture.value);
  if (found == textures_.end() || access == Access::kNone) return;
  TextureState& state = found->second;
  const uint64_t mipEnd = view.mipCount == 0 ? state.mips : uint64_t{view.mip} + view.mipCount;
  const uint64_t layerEnd =
      view.layerCount == 0 ? state.layers : uint64_t{view.layer} + view.layerCount;
  if (view.mip >= state.mips || mipEnd > state.mips || view.layer >= state.layers ||
      layerEnd > state.layers) {
    throw Error(
        ErrorId::kBindingRange,
        "the view of levels [{}, {}) and layers [{}, {}) exceeds a texture of {} levels, {} layers",
        view.mip, mipEnd, view.layer, layerEnd, state.mips, state.layers);
  }
  if (!state.touched) touchedTextures_.push_back(view.texture.value);
  state.touched = true;
  for (uint32_t layer = view.layer; layer < layerEnd; ++layer) {
    for (uint32_t mip = view.mip; mip < mipEnd; ++mip) {
      Access& pending = state.pending[layer * state.mips + mip];
      pending = pending | access;
    }
  }
}

void StateTracker::use(const Shader& shader, std::span<const Binding> bindings) {
  for (const Binding& binding : bindings) {
    for (uint32_t i = 0; i < shader.slot_count; ++i) {
      const grisaille_shader_slot& slot = shader.slots[i];
      if (slot.slot_class != binding.slotClass || slot.slot != binding.slot) continue;
      // The shader may query the size of a slot that it neither reads nor writes.
      const Access storage =
          (slot.writes != 0 ? Access::kStorageWrite : Access::kNone) |
          (slot.reads != 0 || slot.writes == 0 ? Access::kStorageRead : Access::kNone);
      switch (slot.slot_class) {
        case GRISAILLE_SLOT_UNIFORM:
          use(binding.buffer.buffer, Access::kUniform);
          break;
        case GRISAILLE_SLOT_STORAGE:
          use(binding.buffer.buffer, storage);
          break;
        case GRISAILLE_SLOT_TEXTURE:
          use(binding.view, Access::kSampled);
          break;
        default:
          use(binding.view, storage);
          break;
      }
    }
  }
}

std::span<const Transition> StateTracker::flush() {
  transitions_.clear();
  for (const uint32_t value : touchedBuffers_) {
    const auto found = buffers_.find(value);
    if (found == buffers_.end()) continue;
    BufferState& state = found->second;
    if (state.pending == Access::kNone) continue;  // removed and added again in between
    if (needsBarrier(state.state, state.pending)) {
      Transition transition;
      transition.buffer = {value};
      transition.before = state.state;
      transition.after = state.pending;
      transitions_.push_back(transition);
    }
    state.state = state.pending;
    state.pending = Access::kNone;
  }
  touchedBuffers_.clear();
  for (const uint32_t value : touchedTextures_) {
    const auto found = textures_.find(value);
    if (found != textures_.end()) flushTexture({value}, found->second);
  }
  touchedTextures_.clear();
  return transitions_;
}

void StateTracker::rollBack(const StateTracker& earlier) {
  for (auto& [value, state] : buffers_) {
    const auto found = earlier.buffers_.find(value);
    state = found == earlier.buffers_.end() ? BufferState{} : found->second;
  }
  for (auto& [value, state] : textures_) {
    const auto found = earlier.textures_.find(value);
    if (found != earlier.textures_.end()) {
      state = found->second;
    } else {
      add(Texture{value}, state.mips, state.layers);
    }
  }
  touchedBuffers_.clear();
  touchedTextures_.clear();
}

void StateTracker::flushTexture(Texture texture, TextureState& state) {
  state.touched = false;
  for (uint32_t layer = 0; layer < state.layers; ++layer) {
    for (uint32_t mip = 0; mip < state.mips; ++mip) {
      Access& before = state.states[layer * state.mips + mip];
      Access& after = state.pending[layer * state.mips + mip];
      if (after == Access::kNone) continue;
      if (needsBarrier(before, after)) appendTexture(texture, mip, layer, before, after);
      before = after;
      after = Access::kNone;
    }
  }
}

void StateTracker::appendTexture(Texture texture, uint32_t mip, uint32_t layer, Access before,
                                 Access after) {
  if (!transitions_.empty()) {
    Transition& last = transitions_.back();
    const bool alike = last.texture == texture && last.before == before && last.after == after;
    if (alike && last.layerCount == 1 && last.layer == layer && last.mip + last.mipCount == mip) {
      ++last.mipCount;
      mergeLayers();
      return;
    }
  }
  transitions_.push_back({.buffer = {},
                          .texture = texture,
                          .mip = mip,
                          .mipCount = 1,
                          .layer = layer,
                          .layerCount = 1,
                          .before = before,
                          .after = after});
  mergeLayers();
}

// Merges the last two transitions if they cover the same levels of neighbouring layers.
void StateTracker::mergeLayers() {
  if (transitions_.size() < 2) return;
  Transition& first = transitions_[transitions_.size() - 2];
  const Transition& last = transitions_.back();
  if (first.texture == last.texture && first.before == last.before && first.after == last.after &&
      first.mip == last.mip && first.mipCount == last.mipCount &&
      first.layer + first.layerCount == last.layer) {
    first.layerCount += last.layerCount;
    transitions_.pop_back();
  }
}

}  // namespace grisaille::gpu
