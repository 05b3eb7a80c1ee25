// SPDX-License-Identifier: MIT
// The records of the checking device: the state of every resource and of the frame being recorded.
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
  TextureDesc desc;           // without its label
  std::vector<bool> written;  // layer-major: layer * mips + mip
  bool transient = false;
  uint64_t madeFrame = 0;  // transient textures: the frame that created it
  uint64_t usedFrame = kNeverUsed;
};

struct SamplerRecord {
  std::string label;
  Filter filter = Filter::kNearest;
  uint64_t usedFrame = kNeverUsed;
};

struct PipelineRecord {
  std::string label;
  std::vector<const Shader*> shaders;  // compute; or vertex and optionally fragment
  std::vector<uint32_t> streamStrides = {};
  std::vector<VertexAttribute> attributes = {};
  std::vector<Format> colorFormats = {};
  Format depthFormat = Format::kNone;
  uint64_t usedFrame = kNeverUsed;
};

// The records of one kind of resource, by handle. References stay valid until remove().
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
    throw Error(ErrorId::kStaleHandle, "{} {:#x} does not exist or is destroyed", kind_,
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

  uint64_t frame = 0;  // number of the frame being recorded, or of the next frame
  bool recording = false;
  bool inPass = false;
  std::string pass;                   // label of the current pass
  std::vector<BufferRange> uniforms;  // returned by uniform() in this frame

  // Throws kStaleHandle; throws kTransientStale for a transient texture of another frame.
  TextureRecord& usable(Texture texture);

  // Mark as written. First writes are recorded, for endFrame() to undo when a frame is dropped.
  void markWritten(Buffer buffer);
  void markWritten(Texture texture, size_t subresource);

  // Call beginFrame() after begin(), and endFrame() after submit() or abandon().
  void beginFrame();
  void endFrame(bool dropped);

 private:
  std::vector<Buffer> firstWrittenBuffers_;
  std::vector<std::pair<Texture, size_t>> firstWrittenTextures_;
};

}  // namespace grisaille::gpu
