// SPDX-License-Identifier: MIT
// The commands of the checking device.
#pragma once

#include "core/gpu/checking_records.h"
#include "core/gpu/device.h"

namespace grisaille::gpu {

class CheckingCommands final : public Commands {
 public:
  explicit CheckingCommands(Account& account) : account_(account) {}

  // Sets the commands of this frame that receive every valid call.
  void wrap(Commands& commands) { commands_ = &commands; }

  void beginPass(std::string_view label) override;
  void endPass() override;
  void render(const Render& render) override;
  void dispatch(const Dispatch& dispatch) override;
  BufferRange uniform(std::span<const std::byte> bytes) override;
  Texture transient(const TextureDesc& desc) override;
  void upload(Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) override;
  void upload(Texture texture, uint32_t mip, uint32_t layer,
              std::span<const std::byte> bytes) override;

 private:
  void requireRecording(const char* what) const;
  void requirePass(const char* what) const;

  Account& account_;
  Commands* commands_ = nullptr;
};

}  // namespace grisaille::gpu
