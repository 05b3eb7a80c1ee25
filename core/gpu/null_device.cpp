// SPDX-License-Identifier: MIT
#include "core/gpu/null_device.h"

#include <algorithm>

#include "core/gpu/handle_pool.h"
#include "core/gpu/transient_pool.h"

namespace grisaille::gpu {
namespace {

struct NullBuffer {
  std::string label;
  std::vector<std::byte> bytes;
};

struct NullTexture {
  std::string label;
  TextureDesc desc;                              // without its label
  std::vector<std::vector<std::byte>> contents;  // layer-major; empty until uploaded
};

struct NullPipeline {
  std::string label;
  std::vector<const Shader*> shaders;
};

DeviceInfo nullInfo() {
  DeviceInfo info{.backend = "null", .name = "null device", .driver = "none", .software = true};
  // The smallest limits and the largest alignments that the layer allows a device to have.
  info.capabilities = {.maxTextureSize = 4096,
                       .maxTextureLayers = 256,
                       .maxBufferBytes = uint64_t{1} << 28,
                       .maxStorageRange = uint64_t{1} << 27,
                       .maxUniformRange = 65536,
                       .uniformAlignment = 256,
                       .storageAlignment = 256,
                       .maxGroups = {65535, 65535, 65535},
                       .maxAnisotropy = 1};
  return info;
}

class NullDeviceImpl final : public NullDevice, private Commands {
 public:
  const DeviceInfo& info() const override { return info_; }
  const std::vector<Recorded>& recorded() const override { return recorded_; }

  Buffer createBuffer(const BufferDesc& desc) override {
    const Buffer buffer =
        buffers_.add({std::string(desc.label), std::vector<std::byte>(desc.size)});
    tracker_.add(buffer);
    return buffer;
  }
  Texture createTexture(const TextureDesc& desc) override {
    NullTexture texture{std::string(desc.label), desc, {}};
    texture.desc.label = {};
    texture.contents.resize(size_t{desc.mips} * desc.layers);
    const Texture handle = textures_.add(std::move(texture));
    tracker_.add(handle, desc.mips, desc.layers);
    return handle;
  }
  Sampler createSampler(const SamplerDesc&) override { return samplers_.add({}); }
  ComputePipeline createComputePipeline(const ComputePipelineDesc& desc) override {
    return computePipelines_.add({std::string(desc.label), {desc.shader}});
  }
  GraphicsPipeline createGraphicsPipeline(const GraphicsPipelineDesc& desc) override {
    NullPipeline pipeline{std::string(desc.label), {desc.vertex}};
    if (desc.fragment != nullptr) pipeline.shaders.push_back(desc.fragment);
    return graphicsPipelines_.add(std::move(pipeline));
  }

  void destroy(Buffer buffer) override {
    if (!buffer) return;
    buffers_.remove(buffer);
    tracker_.remove(buffer);
  }
  void destroy(Texture texture) override {
    if (!texture) return;
    textures_.remove(texture);
    tracker_.remove(texture);
  }
  void destroy(Sampler sampler) override {
    if (sampler) samplers_.remove(sampler);
  }
  void destroy(ComputePipeline pipeline) override {
    if (pipeline) computePipelines_.remove(pipeline);
  }
  void destroy(GraphicsPipeline pipeline) override {
    if (pipeline) graphicsPipelines_.remove(pipeline);
  }

  Commands& begin() override {
    recorded_.clear();
    before_ = tracker_;
    recording_ = true;
    return *this;
  }
  void submit() override { endFrame(); }
  void abandon() override {
    if (!recording_) return;
    tracker_.rollBack(before_);
    endFrame();
  }
  void wait() override {}

  std::vector<std::byte> read(Texture handle, uint32_t mip, uint32_t layer) override {
    const NullTexture& texture = textures_.get(handle);
    std::vector<std::byte> bytes = texture.contents.at(size_t{layer} * texture.desc.mips + mip);
    bytes.resize(subresourceBytes(texture.desc, mip));
    return bytes;
  }
  std::vector<std::byte> read(BufferRange range) override {
    const std::vector<std::byte>& bytes = buffers_.get(range.buffer).bytes;
    const uint64_t size = range.size == 0 ? bytes.size() - range.offset : range.size;
    const auto first = bytes.begin() + static_cast<ptrdiff_t>(range.offset);
    return {first, first + static_cast<ptrdiff_t>(size)};
  }
  bool present(Texture) override {
    throw Error(ErrorId::kNoWindow, "the null device cannot present: it has no window");
  }
  std::vector<FrameTimes> takeTimes() override { return {}; }

 private:
  void beginPass(std::string_view label) override {
    recorded_.emplace_back(RecordedPass{std::string(label), true});
  }
  void endPass() override { recorded_.emplace_back(RecordedPass{"", false}); }

  void render(const Render& render) override;
  void dispatch(const Dispatch& dispatch) override {
    const NullPipeline& pipeline = computePipelines_.get(dispatch.pipeline);
    tracker_.use(*pipeline.shaders[0], dispatch.bindings);
    barriers();
    recorded_.emplace_back(RecordedDispatch{
        pipeline.label, dispatch.groups, {dispatch.bindings.begin(), dispatch.bindings.end()}});
  }

  BufferRange uniform(std::span<const std::byte> bytes) override {
    // Each call gets its own buffer, which endFrame() removes.
    const Buffer buffer = buffers_.add({"uniform", {bytes.begin(), bytes.end()}});
    uniforms_.push_back(buffer);
    return {.buffer = buffer, .offset = 0, .size = bytes.size()};
  }
  Texture transient(const TextureDesc& desc) override {
    return transients_.take(desc, [this](const TextureDesc& made) { return createTexture(made); });
  }

  void upload(Buffer handle, uint64_t offset, std::span<const std::byte> bytes) override {
    NullBuffer& buffer = buffers_.get(handle);
    tracker_.use(handle, Access::kCopyWrite);
    barriers();
    std::copy(bytes.begin(), bytes.end(), buffer.bytes.begin() + static_cast<ptrdiff_t>(offset));
    recorded_.emplace_back(RecordedUpload{buffer.label, bytes.size()});
  }
  void upload(Texture handle, uint32_t mip, uint32_t layer,
              std::span<const std::byte> bytes) override {
    NullTexture& texture = textures_.get(handle);
    tracker_.use({.texture = handle, .mip = mip, .mipCount = 1, .layer = layer, .layerCount = 1},
                 Access::kCopyWrite);
    barriers();
    texture.contents.at(size_t{layer} * texture.desc.mips + mip).assign(bytes.begin(), bytes.end());
    recorded_.emplace_back(RecordedUpload{texture.label, bytes.size()});
  }

  void barriers() {
    const std::span<const Transition> transitions = tracker_.flush();
    if (transitions.empty()) return;
    recorded_.emplace_back(RecordedBarriers{{transitions.begin(), transitions.end()}});
  }

  void endFrame() {
    recording_ = false;
    for (const Buffer buffer : uniforms_) buffers_.remove(buffer);
    uniforms_.clear();
    transients_.endFrame([this](Texture texture) { destroy(texture); });
  }

  DeviceInfo info_ = nullInfo();
  HandlePool<Buffer, NullBuffer> buffers_{"buffer"};
  HandlePool<Texture, NullTexture> textures_{"texture"};
  HandlePool<Sampler, std::monostate> samplers_{"sampler"};
  HandlePool<ComputePipeline, NullPipeline> computePipelines_{"compute pipeline"};
  HandlePool<GraphicsPipeline, NullPipeline> graphicsPipelines_{"graphics pipeline"};
  StateTracker tracker_, before_;
  TransientPool transients_;
  std::vector<Buffer> uniforms_;
  std::vector<Recorded> recorded_;
  bool recording_ = false;
};

void NullDeviceImpl::render(const Render& render) {
  RecordedRender record{.draws = render.draws.size(), .targets = {}, .depth = false};
  const auto target = [&](TextureView view, Access access) {
    view.mipCount = view.layerCount = 1;
    tracker_.use(view, access);
    return textures_.get(view.texture).label;
  };
  for (const ColorTarget& color : render.colors) {
    record.targets.push_back(target(color.view, Access::kColorTarget));
  }
  if (render.depth.view.texture) {
    record.depth = true;
    record.targets.push_back(target(render.depth.view, Access::kDepthTarget));
  }
  for (const Draw& draw : render.draws) {
    for (const Shader* shader : graphicsPipelines_.get(draw.pipeline).shaders) {
      tracker_.use(*shader, draw.bindings);
    }
    for (const BufferRange& stream : draw.vertexStreams) {
      tracker_.use(stream.buffer, Access::kVertex);
    }
    if (draw.indices.buffer) tracker_.use(draw.indices.buffer, Access::kIndex);
  }
  barriers();
  recorded_.emplace_back(std::move(record));
}

}  // namespace

std::unique_ptr<NullDevice> makeNullDevice() {
  return std::make_unique<NullDeviceImpl>();
}

}  // namespace grisaille::gpu
