// SPDX-License-Identifier: MIT
#include "core/gpu/checking_uses.h"

#include <algorithm>

namespace grisaille::gpu {
namespace {

constexpr const char* kClasses[] = {"UNIFORM", "STORAGE", "TEXTURE", "IMAGE"};

std::string slotName(const grisaille_shader_slot& slot) {
  return fmt::format("{}({}) '{}'", kClasses[slot.slot_class], slot.slot, slot.name);
}

const grisaille_shader_slot* findSlot(const PipelineRecord& pipeline, const Binding& binding) {
  for (const Shader* shader : pipeline.shaders) {
    for (uint32_t i = 0; i < shader->slot_count; ++i) {
      const grisaille_shader_slot& slot = shader->slots[i];
      if (slot.slot_class == binding.slotClass && slot.slot == binding.slot) return &slot;
    }
  }
  return nullptr;
}

}  // namespace

TextureView resolvedView(const TextureView& view, const TextureRecord& texture, const char* what) {
  const TextureDesc& desc = texture.desc;
  TextureView result = view;
  if (view.mip < desc.mips && view.mipCount == 0) result.mipCount = desc.mips - view.mip;
  if (view.layer < desc.layers && view.layerCount == 0) {
    result.layerCount = desc.layers - view.layer;
  }
  if (view.mip >= desc.mips || result.mipCount > desc.mips - view.mip ||
      view.layer >= desc.layers || result.layerCount > desc.layers - view.layer) {
    throw Error(ErrorId::kBindingRange,
                "{} views level {} (count {}), layer {} (count {}) of texture '{}', which has {} "
                "levels and {} layers",
                what, view.mip, view.mipCount, view.layer, view.layerCount, texture.label,
                desc.mips, desc.layers);
  }
  return result;
}

void CallUses::addBindings(PipelineRecord& pipeline, std::span<const Binding> bindings) {
  for (size_t i = 0; i < bindings.size(); ++i) {
    const Binding& binding = bindings[i];
    const grisaille_shader_slot* slot = findSlot(pipeline, binding);
    if (slot == nullptr) {
      throw Error(ErrorId::kBindingUnknown, "pipeline '{}' has no slot {} of class {}",
                  pipeline.label, binding.slot, binding.slotClass);
    }
    for (size_t earlier = 0; earlier < i; ++earlier) {
      if (bindings[earlier].slotClass == binding.slotClass &&
          bindings[earlier].slot == binding.slot) {
        throw Error(ErrorId::kBindingUnknown, "{} of pipeline '{}' is bound twice", slotName(*slot),
                    pipeline.label);
      }
    }
  }
  for (const Shader* shader : pipeline.shaders) {
    for (uint32_t i = 0; i < shader->slot_count; ++i) {
      const grisaille_shader_slot& slot = shader->slots[i];
      const auto bound = std::find_if(bindings.begin(), bindings.end(), [&](const Binding& one) {
        return one.slotClass == slot.slot_class && one.slot == slot.slot;
      });
      if (bound == bindings.end()) {
        throw Error(ErrorId::kBindingMissing, "{} of pipeline '{}' is not bound", slotName(slot),
                    pipeline.label);
      }
      addBinding(pipeline, slot, *bound);
    }
  }
  marks_.push_back(&pipeline.usedFrame);
}

void CallUses::addBinding(const PipelineRecord& pipeline, const grisaille_shader_slot& slot,
                          const Binding& binding) {
  const bool buffer = slot.slot_class <= GRISAILLE_SLOT_STORAGE;
  const bool sampler = slot.slot_class == GRISAILLE_SLOT_TEXTURE;
  if ((buffer && !binding.buffer.buffer) || (!buffer && !binding.view.texture) ||
      (sampler && !binding.sampler)) {
    throw Error(ErrorId::kBindingMissing, "the binding of {} of pipeline '{}' has no {}",
                slotName(slot), pipeline.label,
                buffer ? "buffer" : (binding.view.texture ? "sampler" : "texture"));
  }
  if (buffer) {
    addBuffer(slot, binding.buffer);
  } else {
    addView(slot, binding);
  }
}

BufferRange CallUses::resolved(const grisaille_shader_slot& slot, const BufferRange& range) {
  const bool uniform = slot.slot_class == GRISAILLE_SLOT_UNIFORM;
  BufferRange result = range;
  // Memory returned by uniform() has no buffer record.
  for (const BufferRange& given : account_.uniforms) {
    if (!uniform || given.buffer != range.buffer || range.offset < given.offset ||
        range.offset >= given.offset + given.size) {
      continue;
    }
    const uint64_t rest = given.offset + given.size - range.offset;
    if (range.size == 0) result.size = rest;
    if (result.size <= rest) return result;
  }
  const BufferRecord& buffer = account_.buffers.get(range.buffer);
  const BufferUsage usage = uniform ? BufferUsage::kUniform : BufferUsage::kStorage;
  if (!has(buffer.usage, usage)) {
    throw Error(ErrorId::kBufferUsage,
                "buffer '{}' has usage {:#x}, but is bound to {}, which needs {:#x}", buffer.label,
                static_cast<unsigned>(buffer.usage), slotName(slot), static_cast<unsigned>(usage));
  }
  if (range.size == 0 && range.offset < buffer.size) result.size = buffer.size - range.offset;
  if (range.offset >= buffer.size || result.size > buffer.size - range.offset) {
    throw Error(ErrorId::kBindingRange,
                "{} is bound to offset {}, size {}, of buffer '{}', which has {} bytes",
                slotName(slot), range.offset, range.size, buffer.label, buffer.size);
  }
  return result;
}

void CallUses::addBuffer(const grisaille_shader_slot& slot, const BufferRange& given) {
  const BufferRange range = resolved(slot, given);
  const bool uniform = slot.slot_class == GRISAILLE_SLOT_UNIFORM;
  const Capabilities& can = account_.capabilities;
  const uint32_t alignment = uniform ? can.uniformAlignment : can.storageAlignment;
  const uint64_t limit = uniform ? can.maxUniformRange : can.maxStorageRange;
  if (range.offset % alignment != 0 || range.size > limit) {
    throw Error(ErrorId::kBindingRange,
                "{} is bound to {} bytes at offset {}; the device allows at most {} bytes, at "
                "multiples of {}",
                slotName(slot), range.size, range.offset, limit, alignment);
  }
  if (range.size < slot.block_size) {
    throw Error(ErrorId::kBindingSmall, "{} needs {} bytes, but only {} are bound", slotName(slot),
                slot.block_size, range.size);
  }
  uses_.push_back({.buffer = range.buffer,
                   .begin = range.offset,
                   .end = range.offset + range.size,
                   .reads = slot.reads != 0,
                   .writes = slot.writes != 0,
                   .what = slot.name});
  if (BufferRecord* record = account_.buffers.find(range.buffer)) {
    marks_.push_back(&record->usedFrame);
  }
}

void CallUses::addView(const grisaille_shader_slot& slot, const Binding& binding) {
  TextureRecord& texture = account_.usable(binding.view.texture);
  const bool image = slot.slot_class == GRISAILLE_SLOT_IMAGE;
  const TextureUsage usage = image ? TextureUsage::kStorage : TextureUsage::kSampled;
  if (!has(texture.desc.usage, usage)) {
    throw Error(ErrorId::kTextureUsage,
                "texture '{}' has usage {:#x}, but is bound to {}, which needs {:#x}",
                texture.label, static_cast<unsigned>(texture.desc.usage), slotName(slot),
                static_cast<unsigned>(usage));
  }
  const TextureView view = resolvedView(binding.view, texture, slot.name);
  if (image && view.mipCount != 1) {
    throw Error(ErrorId::kBindingRange,
                "{} is bound to {} levels of texture '{}'; an image takes one", slotName(slot),
                view.mipCount, texture.label);
  }
  const char* format = formatInfo(texture.desc.format).name;
  if (image && std::string_view(format) != slot.format) {
    throw Error(ErrorId::kBindingFormat, "{} is declared {}, but texture '{}' is {}",
                slotName(slot), slot.format, texture.label, format);
  }
  if (slot.arrayed == 0 && view.layerCount > 1) {
    throw Error(ErrorId::kBindingFormat,
                "{} is declared 2D, but the view of texture '{}' has {} layers", slotName(slot),
                texture.label, view.layerCount);
  }
  if (!image) {
    SamplerRecord& sampler = account_.samplers.get(binding.sampler);
    if (texture.desc.format == Format::kR32Uint && sampler.filter == Filter::kLinear) {
      throw Error(ErrorId::kBindingFormat,
                  "{} is bound to integer texture '{}' with the linear sampler '{}'",
                  slotName(slot), texture.label, sampler.label);
    }
    marks_.push_back(&sampler.usedFrame);
  }
  uses_.push_back({.texture = view.texture,
                   .begin = view.mip,
                   .end = view.mip + view.mipCount,
                   .layer = view.layer,
                   .layerEnd = view.layer + view.layerCount,
                   .reads = slot.reads != 0,
                   .writes = slot.writes != 0,
                   .what = slot.name});
  marks_.push_back(&texture.usedFrame);
}

void CallUses::addTarget(const TextureView& view, bool loads, const char* what) {
  uses_.push_back({.texture = view.texture,
                   .begin = view.mip,
                   .end = view.mip + 1,
                   .layer = view.layer,
                   .layerEnd = view.layer + 1,
                   .reads = loads,
                   .writes = true,
                   .target = true,
                   .what = what});
  marks_.push_back(&account_.textures.get(view.texture).usedFrame);
}

void CallUses::addRead(const BufferRange& range, const char* what) {
  uses_.push_back({.buffer = range.buffer,
                   .begin = range.offset,
                   .end = range.offset + range.size,
                   .reads = true,
                   .what = what});
  marks_.push_back(&account_.buffers.get(range.buffer).usedFrame);
}

std::string CallUses::nameOf(const Use& use) const {
  if (use.texture) return account_.textures.get(use.texture).label;
  const BufferRecord* buffer = account_.buffers.find(use.buffer);
  return buffer == nullptr ? "uniform()" : buffer->label;
}

bool CallUses::overlap(const Use& a, const Use& b) {
  if (a.texture != b.texture || a.buffer != b.buffer || a.begin >= b.end || b.begin >= a.end) {
    return false;
  }
  return !a.texture || (a.layer < b.layerEnd && b.layer < a.layerEnd);
}

void CallUses::checkWritten(const Use& use) const {
  if (use.texture) {
    const TextureRecord& texture = account_.textures.get(use.texture);
    for (uint32_t layer = use.layer; layer < use.layerEnd; ++layer) {
      for (uint64_t mip = use.begin; mip < use.end; ++mip) {
        if (texture.written[layer * texture.desc.mips + mip]) continue;
        throw Error(ErrorId::kUninitialised,
                    "'{}' reads level {} of layer {} of texture '{}', which was never written",
                    use.what, mip, layer, texture.label);
      }
    }
    return;
  }
  const BufferRecord* buffer = account_.buffers.find(use.buffer);
  if (buffer == nullptr || buffer->written) return;
  throw Error(ErrorId::kUninitialised, "'{}' reads buffer '{}', which was never written", use.what,
              buffer->label);
}

void CallUses::check() const {
  for (const Use& use : uses_) {
    if (use.reads) checkWritten(use);
  }
  for (const Use& writer : uses_) {
    if (!writer.writes) continue;
    for (const Use& other : uses_) {
      if (&other == &writer || !overlap(writer, other)) continue;
      // Two slots that only write may share a resource; a target may not share its subresource.
      if (!other.reads && !writer.target) continue;
      throw Error(ErrorId::kHazard, "'{}' writes and '{}' {} the same part of '{}' in one call",
                  writer.what, other.what, other.reads ? "reads" : "writes", nameOf(writer));
    }
  }
}

void CallUses::commit() {
  for (uint64_t* mark : marks_) *mark = account_.frame;
  for (const Use& use : uses_) {
    if (!use.writes) continue;
    if (!use.texture) {
      account_.markWritten(use.buffer);
      continue;
    }
    const uint32_t mips = account_.textures.get(use.texture).desc.mips;
    for (uint32_t layer = use.layer; layer < use.layerEnd; ++layer) {
      for (uint64_t mip = use.begin; mip < use.end; ++mip) {
        account_.markWritten(use.texture, layer * mips + mip);
      }
    }
  }
}

}  // namespace grisaille::gpu
