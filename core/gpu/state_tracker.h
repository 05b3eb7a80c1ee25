// SPDX-License-Identifier: MIT
// Tracks the state of every subresource (mip level and layer) and finds the barriers that the next
// call needs. Backends translate the transitions into barriers of their API. The null device
// records them, for tests without a driver. Follows the state tracking of nvrhi.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "core/gpu/types.h"

namespace grisaille::gpu {

// How a call uses a resource; a set of flags.
enum class Access : uint16_t {
  kNone = 0,
  kVertex = 1,
  kIndex = 2,
  kUniform = 4,
  kSampled = 8,
  kStorageRead = 16,
  kStorageWrite = 32,
  kColorTarget = 64,
  kDepthTarget = 128,
  kCopyRead = 256,
  kCopyWrite = 512,
};
constexpr Access operator|(Access a, Access b) {
  return static_cast<Access>(static_cast<int>(a) | static_cast<int>(b));
}
constexpr bool has(Access set, Access any) {
  return (static_cast<int>(set) & static_cast<int>(any)) != 0;
}
constexpr Access kWriteAccess =
    Access::kStorageWrite | Access::kColorTarget | Access::kDepthTarget | Access::kCopyWrite;

// Either `buffer` or `texture` is set. `before` is kNone for contents that were never written.
struct Transition {
  Buffer buffer;
  Texture texture;
  uint32_t mip = 0, mipCount = 1, layer = 0, layerCount = 1;
  Access before = Access::kNone;
  Access after = Access::kNone;
};

class StateTracker {
 public:
  void add(Buffer buffer);
  void add(Texture texture, uint32_t mips, uint32_t layers);
  void remove(Buffer buffer);
  void remove(Texture texture);

  // Declare one use by the next call. Several uses of one subresource are combined. Resources that
  // were not added (a backend's own uniform memory) are ignored. A count of 0 in a view means all
  // remaining levels or layers.
  void use(Buffer buffer, Access access);
  void use(TextureView view, Access access);  // throws kBindingRange

  // Declares the uses of all bindings of a shader, from the shader's reflection. Bindings to slots
  // that the shader does not declare are ignored.
  void use(const Shader& shader, std::span<const Binding> bindings);

  // Returns the transitions that the declared uses need. A read after a read of the same kind needs
  // none. Adjacent subresources of a texture with equal states are merged. Valid until the next
  // flush().
  std::span<const Transition> flush();

  // Undoes all uses since `earlier` was copied from this tracker: for a frame that is dropped.
  // Resources added since then stay, in the state of never used; removed resources stay removed.
  // `earlier` must have been copied right after a flush().
  void rollBack(const StateTracker& earlier);

 private:
  struct TextureState {
    uint32_t mips = 1, layers = 1;
    std::vector<Access> states;   // layer-major: layer * mips + mip
    std::vector<Access> pending;  // same order as `states`
    bool touched = false;
  };
  struct BufferState {
    Access state = Access::kNone;
    Access pending = Access::kNone;
  };

  void flushTexture(Texture texture, TextureState& state);
  void appendTexture(Texture texture, uint32_t mip, uint32_t layer, Access before, Access after);
  void mergeLayers();

  std::unordered_map<uint32_t, BufferState> buffers_;
  std::unordered_map<uint32_t, TextureState> textures_;
  std::vector<uint32_t> touchedBuffers_;
  std::vector<uint32_t> touchedTextures_;
  std::vector<Transition> transitions_;
};

}  // namespace grisaille::gpu
