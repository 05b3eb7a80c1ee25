// SPDX-License-Identifier: MIT
#include "core/gpu/checking_commands.h"

#include <algorithm>

#include "core/gpu/checking_descriptors.h"
#include "core/gpu/checking_uses.h"

namespace grisaille::gpu {
namespace {

constexpr size_t kMaxUniformBytes = 65536;

struct TargetSize {
  uint32_t width = 0, height = 0;
};

// Checks one target, and that it has the same size as the others. `size`: 0 before the first
// target.
void addTarget(Account& account, CallUses& uses, TargetSize& size, const TextureView& view,
               Load load, bool depth) {
  const char* what = depth ? "depth target" : "colour target";
  if (!view.texture) {
    throw Error(ErrorId::kTargetMismatch, "a {} has no texture", what);
  }
  const TextureRecord& texture = account.usable(view.texture);
  if (!has(texture.desc.usage, TextureUsage::kTarget)) {
    throw Error(ErrorId::kTextureUsage, "texture '{}' of usage {:#x} cannot be a target",
                texture.label, static_cast<unsigned>(texture.desc.usage));
  }
  if (formatInfo(texture.desc.format).depth != depth) {
    throw Error(ErrorId::kPipelineTargets, "texture '{}' of format {} cannot be a {}",
                texture.label, formatInfo(texture.desc.format).name, what);
  }
  TextureView one = view;
  one.mipCount = one.layerCount = 1;
  resolvedView(one, texture, what);
  const TargetSize here{std::max(1u, texture.desc.width >> view.mip),
                        std::max(1u, texture.desc.height >> view.mip)};
  if (size.width == 0) size = here;
  if (here.width != size.width || here.height != size.height) {
    throw Error(ErrorId::kTargetMismatch, "texture '{}' is {}x{}, but another target is {}x{}",
                texture.label, here.width, here.height, size.width, size.height);
  }
  uses.addTarget(one, load == Load::kLoad, what);
}

// Returns the targets' size.
TargetSize addTargets(Account& account, CallUses& uses, const Render& render) {
  if (render.colors.size() > kMaxColorTargets ||
      (render.colors.empty() && !render.depth.view.texture)) {
    throw Error(ErrorId::kTargetMismatch, "a render call has {} colour targets and {} depth target",
                render.colors.size(), render.depth.view.texture ? "a" : "no");
  }
  TargetSize size;
  for (const ColorTarget& color : render.colors) {
    addTarget(account, uses, size, color.view, color.load, false);
  }
  if (render.depth.view.texture) {
    addTarget(account, uses, size, render.depth.view, render.depth.load, true);
  }
  return size;
}

void checkScissor(const Scissor& scissor, const TargetSize& size, const PipelineRecord& pipeline) {
  if (scissor.width == 0) return;
  const bool inside = scissor.height != 0 && scissor.x < size.width && scissor.y < size.height &&
                      scissor.width <= size.width - scissor.x &&
                      scissor.height <= size.height - scissor.y;
  if (inside) return;
  throw Error(
      ErrorId::kScissor,
      "a draw with pipeline '{}' has a scissor of {}x{} pixels at {}, {} on targets of {}x{}",
      pipeline.label, scissor.width, scissor.height, scissor.x, scissor.y, size.width, size.height);
}

void checkFormats(Account& account, const Render& render, const PipelineRecord& pipeline) {
  const auto differ = [&](const std::string& detail) {
    throw Error(ErrorId::kPipelineTargets, "pipeline '{}' is drawn with {}", pipeline.label,
                detail);
  };
  if (pipeline.colorFormats.size() != render.colors.size()) {
    differ(fmt::format("{} colour targets, but was created for {}", render.colors.size(),
                       pipeline.colorFormats.size()));
  }
  const auto compare = [&](Texture texture, Format format) {
    const TextureRecord& record = account.textures.get(texture);
    if (record.desc.format == format) return;
    differ(fmt::format("target '{}' of format {}, but was created for {}", record.label,
                       formatInfo(record.desc.format).name, formatInfo(format).name));
  };
  for (size_t i = 0; i < render.colors.size(); ++i) {
    compare(render.colors[i].view.texture, pipeline.colorFormats[i]);
  }
  const bool depth = pipeline.depthFormat != Format::kNone;
  if (depth != static_cast<bool>(render.depth.view.texture)) {
    differ(depth ? "no depth target, but needs one"
                 : "a depth target, but was created without one");
  }
  if (depth) compare(render.depth.view.texture, pipeline.depthFormat);
}

// Returns a range of a vertex or index buffer with its size resolved. Throws kBufferUsage,
// kDrawRange.
BufferRange drawRange(Account& account, const BufferRange& range, BufferUsage usage,
                      const char* what) {
  const BufferRecord& buffer = account.buffers.get(range.buffer);
  if (!has(buffer.usage, usage)) {
    throw Error(ErrorId::kBufferUsage, "buffer '{}' of usage {:#x} cannot be bound as {}",
                buffer.label, static_cast<unsigned>(buffer.usage), what);
  }
  BufferRange result = range;
  if (range.size == 0 && range.offset < buffer.size) result.size = buffer.size - range.offset;
  if (range.offset % 4 != 0 || range.offset >= buffer.size ||
      result.size > buffer.size - range.offset) {
    throw Error(ErrorId::kDrawRange,
                "{} are bound to offset {}, size {}, of buffer '{}', which has {} bytes; offsets "
                "are multiples of 4",
                what, range.offset, range.size, buffer.label, buffer.size);
  }
  return result;
}

void addDraw(Account& account, CallUses& uses, const Render& render, const TargetSize& size,
             const Draw& draw) {
  PipelineRecord& pipeline = account.graphicsPipelines.get(draw.pipeline);
  checkFormats(account, render, pipeline);
  checkScissor(draw.scissor, size, pipeline);
  uses.addBindings(pipeline, draw.bindings);
  if (draw.count == 0 || draw.vertexStreams.size() < pipeline.streamStrides.size()) {
    throw Error(ErrorId::kDrawRange,
                "a draw of {} vertices with pipeline '{}' binds {} vertex streams of {}",
                draw.count, pipeline.label, draw.vertexStreams.size(),
                pipeline.streamStrides.size());
  }
  const bool indexed = static_cast<bool>(draw.indices.buffer);
  const uint64_t last = uint64_t{draw.first} + draw.count - 1;
  if (indexed) {
    const BufferRange range = drawRange(account, draw.indices, BufferUsage::kIndex, "indices");
    if (last >= range.size / 4) {
      throw Error(ErrorId::kDrawRange,
                  "index {} is drawn with pipeline '{}', but only {} are bound", last,
                  pipeline.label, range.size / 4);
    }
    uses.addRead(range, "indices");
  }
  for (uint32_t i = 0; i < pipeline.streamStrides.size(); ++i) {
    const BufferRange range =
        drawRange(account, draw.vertexStreams[i], BufferUsage::kVertex, "vertices");
    // The values of the indices are unknown here: an indexed draw needs at least one vertex.
    uint64_t end = 0;
    for (const VertexAttribute& attribute : pipeline.attributes) {
      if (attribute.stream != i) continue;
      end = std::max(end, uint64_t{attribute.offset} + attributeBytes(attribute.format));
    }
    end += (indexed ? 0 : last) * pipeline.streamStrides[i];
    if (end > range.size) {
      throw Error(
          ErrorId::kDrawRange,
          "vertex {} is drawn with pipeline '{}' and ends at byte {} of stream {}, but only "
          "{} bytes are bound",
          indexed ? 0 : last, pipeline.label, end, i, range.size);
    }
    uses.addRead(range, "vertices");
  }
}

}  // namespace

void CheckingCommands::requireRecording(const char* what) const {
  if (account_.recording) return;
  throw Error(ErrorId::kNotRecording, "{} outside a frame", what);
}

void CheckingCommands::requirePass(const char* what) const {
  requireRecording(what);
  if (account_.inPass) return;
  throw Error(ErrorId::kPassMissing, "{} outside a pass", what);
}

void CheckingCommands::beginPass(std::string_view label) {
  requireRecording("beginPass()");
  if (account_.inPass) {
    throw Error(ErrorId::kPassNesting, "pass '{}' begins inside pass '{}'", label, account_.pass);
  }
  commands_->beginPass(label);
  account_.inPass = true;
  account_.pass = label;
}

void CheckingCommands::endPass() {
  requirePass("endPass()");
  commands_->endPass();
  account_.inPass = false;
}

void CheckingCommands::render(const Render& render) {
  requirePass("render()");
  CallUses uses(account_);
  const TargetSize size = addTargets(account_, uses, render);
  for (const Draw& draw : render.draws) addDraw(account_, uses, render, size, draw);
  uses.check();
  commands_->render(render);
  uses.commit();
}

void CheckingCommands::dispatch(const Dispatch& dispatch) {
  requirePass("dispatch()");
  PipelineRecord& pipeline = account_.computePipelines.get(dispatch.pipeline);
  for (size_t axis = 0; axis < 3; ++axis) {
    const uint32_t limit = account_.capabilities.maxGroups[axis];
    if (dispatch.groups[axis] >= 1 && dispatch.groups[axis] <= limit) continue;
    throw Error(ErrorId::kDispatchSize,
                "pipeline '{}' is dispatched with {} groups on axis {}; the limit is {}",
                pipeline.label, dispatch.groups[axis], axis, limit);
  }
  CallUses uses(account_);
  uses.addBindings(pipeline, dispatch.bindings);
  uses.check();
  commands_->dispatch(dispatch);
  uses.commit();
}

BufferRange CheckingCommands::uniform(std::span<const std::byte> bytes) {
  requireRecording("uniform()");
  if (bytes.empty() || bytes.size() > kMaxUniformBytes) {
    throw Error(ErrorId::kUniformSize, "uniform() of {} bytes", bytes.size());
  }
  const BufferRange range = commands_->uniform(bytes);
  account_.uniforms.push_back(range);
  return range;
}

Texture CheckingCommands::transient(const TextureDesc& desc) {
  requireRecording("transient()");
  checkDescriptor(desc, account_.capabilities);
  const Texture texture = commands_->transient(desc);
  TextureRecord record{.label = std::string(desc.label),
                       .desc = desc,
                       .written = std::vector<bool>(size_t{desc.mips} * desc.layers),
                       .transient = true,
                       .madeFrame = account_.frame};
  record.desc.label = {};
  account_.textures.add(texture, std::move(record));
  return texture;
}

void CheckingCommands::upload(Buffer handle, uint64_t offset, std::span<const std::byte> bytes) {
  requireRecording("upload()");
  BufferRecord& buffer = account_.buffers.get(handle);
  if (bytes.empty() || offset >= buffer.size || bytes.size() > buffer.size - offset) {
    throw Error(ErrorId::kUploadRange, "upload of {} bytes at offset {} into buffer '{}' of {}",
                bytes.size(), offset, buffer.label, buffer.size);
  }
  commands_->upload(handle, offset, bytes);
  buffer.usedFrame = account_.frame;
  account_.markWritten(handle);
}

void CheckingCommands::upload(Texture handle, uint32_t mip, uint32_t layer,
                              std::span<const std::byte> bytes) {
  requireRecording("upload()");
  TextureRecord& texture = account_.usable(handle);
  const TextureDesc& desc = texture.desc;
  if (mip >= desc.mips || layer >= desc.layers || bytes.size() != subresourceBytes(desc, mip)) {
    throw Error(
        ErrorId::kUploadRange,
        "upload of {} bytes into level {} of layer {} of texture '{}', {}x{} {} with {} levels and "
        "{} layers",
        bytes.size(), mip, layer, texture.label, desc.width, desc.height,
        formatInfo(desc.format).name, desc.mips, desc.layers);
  }
  commands_->upload(handle, mip, layer, bytes);
  texture.usedFrame = account_.frame;
  account_.markWritten(handle, size_t{layer} * desc.mips + mip);
}

}  // namespace grisaille::gpu
