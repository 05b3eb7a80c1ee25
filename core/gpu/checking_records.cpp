// SPDX-License-Identifier: MIT
#include "core/gpu/checking_records.h"

namespace grisaille::gpu {
namespace {

// Records of transient textures are kept for this many frames, to report late uses. The backend may
// destroy these textures without telling; without a limit the records would pile up.
constexpr uint64_t kRemembered = 64;

}  // namespace

TextureRecord& Account::usable(Texture texture) {
  TextureRecord& record = textures.get(texture);
  if (record.transient && (!recording || record.madeFrame != frame)) {
    throw Error(ErrorId::kTransientStale, "transient texture '{}' of frame {} is used {} frame {}",
                record.label, record.madeFrame, recording ? "in" : "before", frame);
  }
  return record;
}

void Account::markWritten(Buffer buffer) {
  BufferRecord* record = buffers.find(buffer);
  if (record == nullptr || record->written) return;
  record->written = true;
  firstWrittenBuffers_.push_back(buffer);
}

void Account::markWritten(Texture texture, size_t subresource) {
  TextureRecord* record = textures.find(texture);
  if (record == nullptr || record->written[subresource]) return;
  record->written[subresource] = true;
  firstWrittenTextures_.emplace_back(texture, subresource);
}

void Account::beginFrame() {
  recording = true;
  inPass = false;
}

void Account::endFrame(bool dropped) {
  if (dropped) {
    for (const Buffer buffer : firstWrittenBuffers_) {
      if (BufferRecord* record = buffers.find(buffer)) record->written = false;
    }
    for (const auto& [texture, subresource] : firstWrittenTextures_) {
      if (TextureRecord* record = textures.find(texture)) record->written[subresource] = false;
    }
  }
  firstWrittenBuffers_.clear();
  firstWrittenTextures_.clear();
  uniforms.clear();
  recording = inPass = false;
  ++frame;
  std::erase_if(textures.all(), [this](const auto& entry) {
    return entry.second.transient && entry.second.madeFrame + kRemembered < frame;
  });
}

}  // namespace grisaille::gpu
