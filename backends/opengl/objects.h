// SPDX-License-Identifier: MIT
// An owner of an OpenGL object name.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>

namespace grisaille::opengl {

enum class ObjectKind : uint8_t {
  kNone,
  kBuffer,
  kTexture,
  kSampler,
  kProgram,
  kVertexArray,
  kFramebuffer,
  kTimestamp,
};

// Deletes its object in the destructor; the context must be current there.
class Object {
 public:
  Object() = default;
  explicit Object(ObjectKind kind);  // any kind but kTexture
  static Object texture(uint32_t target);
  static Object foreign(uint32_t texture);  // another program's texture; never deleted here
  static Object textureView();              // a name without storage, for glTextureView
  ~Object() { reset(); }
  Object(Object&& other) noexcept
      : kind_(std::exchange(other.kind_, ObjectKind::kNone)),
        name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    reset();
    kind_ = std::exchange(other.kind_, ObjectKind::kNone);
    name_ = std::exchange(other.name_, 0);
    return *this;
  }

  uint32_t name() const { return name_; }

  // Sets the name that debuggers show; "" leaves the object unnamed.
  void label(std::string_view text) const;

 private:
  void reset();

  ObjectKind kind_ = ObjectKind::kNone;
  uint32_t name_ = 0;
};

}  // namespace grisaille::opengl
