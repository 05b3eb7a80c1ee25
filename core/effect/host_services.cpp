// SPDX-License-Identifier: MIT
#include "core/effect/host_services.h"

#include <algorithm>
#include <utility>

namespace grisaille::effect {

HostServices::HostServices(gpu::Maker& device, const Effect& effect)
    : device_(device),
      key_(effect.key()),
      takesObjects_(effect.objects() != nullptr),
      host_(hostTable(this)),
      frame_(frameTable(this)) {}

const std::string& HostServices::labelled(const char* label) {
  label_ = key_;
  if (label == nullptr || *label == '\0') return label_;
  label_ += '/';
  const std::string_view text(label);
  const bool plain =
      text.size() <= 100 && std::ranges::none_of(text, [](char c) { return c < ' ' || c == 127; });
  if (plain) {
    label_ += text;
  } else {
    label_ += oneLine(text);
  }
  return label_;
}

// --- Calls ---------------------------------------------------------------------------------------

void HostServices::open() {
  ownWords_.clear();
  refused_.clear();
  misuse_.clear();
  deviceFault_.reset();
  inside_ = true;
}

const grisaille_frame* HostServices::openFrame(const FrameInputs& inputs) {
  destroyBuried(buffers_);
  destroyBuried(textures_);
  destroyBuried(samplers_);
  destroyBuried(pipelines_);
  attachments_.clear();
  inputs_.clear();
  outputs_.clear();
  writable_.clear();
  uniforms_.assign(1, inputs.viewBlock.buffer.value);
  for (const gpu::Texture texture : inputs.attachments) attachments_.push_back({texture.value});
  for (const gpu::Texture texture : inputs.named) inputs_.push_back({texture.value});
  frame_.wanted = 0;
  for (const gpu::Texture texture : inputs.outputs) {
    if (texture) {
      frame_.wanted |= 1u << outputs_.size();
      writable_.push_back(texture.value);
    }
    outputs_.push_back({texture.value});
  }
  frame_.width = inputs.width;
  frame_.height = inputs.height;
  frame_.guard = inputs.guard;
  frame_.index = frames_++;
  frame_.values = inputs.values.data();
  frame_.view = inputs.view;
  const gpu::BufferRange& block = inputs.viewBlock;
  frame_.view_block = {{block.buffer.value}, 0, block.offset, block.size};
  frame_.attachments = attachments_.data();
  frame_.outputs = outputs_.data();
  frame_.inputs = inputs_.data();
  frame_.objects = give(inputs.objects, inputs.objectsKept);
  frame_.patience = inputs.patience;
  offered_ = inputs.services;
  report_ = {};
  commands_ = inputs.commands;
  open();
  casts_ = true;
  return &frame_;
}

const grisaille_points* HostServices::openPoints(const PointInputs& inputs) {
  points_ = {.struct_size = sizeof(grisaille_points),
             .reserved = 0,
             .count = inputs.points.size(),
             .points = inputs.points.data(),
             .drawn = inputs.drawn.data(),
             .values = inputs.values.data(),
             .objects = give(inputs.objects, inputs.objectsKept)};
  offered_ = {.rays = inputs.rays};
  open();
  casts_ = true;
  return &points_;
}

const grisaille_objects* HostServices::give(const objects::View& objects, size_t kept) {
  if (!takesObjects_) return nullptr;
  objects_ = {.struct_size = sizeof(grisaille_objects),
              .stride = objects.table->object_size,
              .objects = objects.data,
              .count = objects.count,
              .kept = std::min(kept, objects.count)};
  return &objects_;
}

void HostServices::close() {
  inside_ = casts_ = false;
  gpu::Commands* commands = std::exchange(commands_, nullptr);
  if (!std::exchange(passOpen_, false)) return;
  if (misuse_.empty()) misuse_ = "it left a pass open";
  try {
    commands->endPass();
  } catch (const Error&) {
    // The call has already failed, and the caller abandons the frame.
  }
}

std::string HostServices::failure(grisaille_result result) const {
  if (result == GRISAILLE_OK) return misuse_;
  std::string words = ownWords_;
  for (const std::string& more : {refused_, misuse_}) {
    if (!more.empty()) words += words.empty() ? more : " (" + more + ")";
  }
  return words.empty() ? "it gave no reason" : words;
}

// --- Destroying ----------------------------------------------------------------------------------

template <typename Handle>
void HostServices::destroyBuried(Kind<Handle>& kind) {
  kind.freed.clear();
  kind.freed.swap(kind.buried);
  for (const Handle handle : kind.freed) device_.destroy(handle);
}

template <typename Handle>
void HostServices::destroyOwn(Kind<Handle>& kind) noexcept {
  for (const uint32_t id : kind.own) kind.buried.push_back({id});
  kind.own.clear();
  for (const Handle handle : kind.buried) {
    try {
      device_.destroy(handle);
    } catch (const Error&) {
      // The device is lost, or its destructor reports the remaining resources.
    }
  }
  kind.buried.clear();
}

void HostServices::destroyAll() noexcept {
  destroyOwn(buffers_);
  destroyOwn(textures_);
  destroyOwn(samplers_);
  destroyOwn(pipelines_);
}

}  // namespace grisaille::effect
