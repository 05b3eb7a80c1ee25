// SPDX-License-Identifier: MIT
// The checking device's account: what it knows of every resource and of the frame being recorded.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "core/base/error.h"
#include "core/gpu/types.h"

namespace grisaille::gpu {

constexpr uint64_t kNeverUsed = ~uint64_t{0};

struct BufferRecord {
  std::string label;
  uint64_t size = 0;
  BufferUsage usage = BufferUsage::kNone;
  bool written = false;
  uint64_t usedFrame = kNeverUsed;
};

struct TextureRecord {
  std::string label;
  TextureDesc desc;           // its label is not kept
  std::vector<bool> written;  // layer-major: layer * mips + mip
  bool transient = false;
  uint64_t madeFrame = 0;  // of a transient texture
  uint64_t usedFrame = kNeverUsed;
};

struct SamplerRecord {
  std::string label;
  Filter filter = Filter::kNearest;
  uint64_t usedFrame = kNeverUsed;
};

struct PipelineRecord {
  std::string label;
  std::vector<const Shader*> shaders;  // compute; or vertex and perhaps fragment
  std::vector<uint32_t> streamStrides = {};
  std::vector<VertexAttribute> attributes = {};
  std::vector<Format> colorFormats = {};
  Format depthFormat = Format::kNone;
  uint64_t usedFrame = kNeverUsed;
};

// The records of one kind of resource, by handle. References stay valid until the record goes.
template <typename HandleType, typename Record>
class Records {
 public:
  // `kind` is for messages: "texture".
  explicit Records(const char* kind) : kind_(kind) {}

  void add(HandleType handle, Record record) { records_[handle.value] = std::move(record); }
  void remove(HandleType handle) { records_.erase(handle.value); }
  Record* find(HandleType handle) {
    const auto found = records_.find(handle.value);
    return found == records_.end() ? nullptr : &found->second;
  }
  // Throws kStaleHandle.
  Record& get(HandleType handle) {
    if (Record* record = find(handle)) return *record;
    throw Error(ErrorId::kStaleHandle, "{} {:#x} was never made or is destroyed", kind_,
                handle.value);
  }
  const char* kind() const { return kind_; }
  auto& all() { return records_; }

 private:
  const char* kind_;
  std::unordered_map<uint32_t, Record> records_;
};

struct Account {
  Capabilities capabilities;
  Records<Buffer, BufferRecord> buffers{"buffer"};
  Records<Texture, TextureRecord> textures{"texture"};
  Records<Sampler, SamplerRecord> samplers{"sampler"};
  Records<ComputePipeline, PipelineRecord> computePipelines{"compute pipeline"};
  Records<GraphicsPipeline, PipelineRecord> graphicsPipelines{"graphics pipeline"};

  uint64_t frame = 0;  // the one being recorded, or the next
  bool recording = false;
  bool inPass = false;
  std::string pass;                   // its label
  std::vector<BufferRange> uniforms;  // memory of this frame

  // Throws kStaleHandle; kTransientStale outside of the frame that made it.
  TextureRecord& usable(Texture texture);

  // Notes first writes, so that a dropped frame's can be taken back.
  void markWritten(Buffer buffer);
  void markWritten(Texture texture, size_t subresource);

  // After begin(), and after submit() or abandon().
  void beginFrame();
  void endFrame(bool dropped);

 private:
  std::vector<Buffer> firstWrittenBuffers_;
  std::vector<std::pair<Texture, size_t>> firstWrittenTextures_;
};

}  // namespace grisaille::gpu
