// SPDX-License-Identifier: MIT
#include "backends/opengl/objects.h"

#include <epoxy/gl.h>

namespace grisaille::opengl {
namespace {

constexpr size_t kMaxLabel = 255;  // bytes; GL_MAX_LABEL_LENGTH is at least 256 with the NUL

GLenum identifierOf(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::kBuffer:
      return GL_BUFFER;
    case ObjectKind::kTexture:
      return GL_TEXTURE;
    case ObjectKind::kSampler:
      return GL_SAMPLER;
    case ObjectKind::kProgram:
      return GL_PROGRAM;
    case ObjectKind::kVertexArray:
      return GL_VERTEX_ARRAY;
    case ObjectKind::kFramebuffer:
      return GL_FRAMEBUFFER;
    case ObjectKind::kTimestamp:
      return GL_QUERY;
    case ObjectKind::kNone:
      break;
  }
  return GL_NONE;
}

}  // namespace

Object::Object(ObjectKind kind) : kind_(kind) {
  switch (kind) {
    case ObjectKind::kBuffer:
      glCreateBuffers(1, &name_);
      break;
    case ObjectKind::kSampler:
      glCreateSamplers(1, &name_);
      break;
    case ObjectKind::kProgram:
      name_ = glCreateProgram();
      break;
    case ObjectKind::kVertexArray:
      glCreateVertexArrays(1, &name_);
      break;
    case ObjectKind::kFramebuffer:
      glCreateFramebuffers(1, &name_);
      break;
    case ObjectKind::kTimestamp:
      glCreateQueries(GL_TIMESTAMP, 1, &name_);
      break;
    case ObjectKind::kTexture:
    case ObjectKind::kNone:
      break;
  }
}

Object Object::texture(uint32_t target) {
  Object object;
  object.kind_ = ObjectKind::kTexture;
  glCreateTextures(target, 1, &object.name_);
  return object;
}

Object Object::foreign(uint32_t texture) {
  Object object;
  object.name_ = texture;
  return object;
}

Object Object::textureView() {
  Object object;
  object.kind_ = ObjectKind::kTexture;
  glGenTextures(1, &object.name_);
  return object;
}

void Object::label(std::string_view text) const {
  if (text.empty()) return;
  text = text.substr(0, kMaxLabel);
  glObjectLabel(identifierOf(kind_), name_, static_cast<GLsizei>(text.size()), text.data());
}

void Object::reset() {
  switch (std::exchange(kind_, ObjectKind::kNone)) {
    case ObjectKind::kBuffer:
      glDeleteBuffers(1, &name_);
      break;
    case ObjectKind::kTexture:
      glDeleteTextures(1, &name_);
      break;
    case ObjectKind::kSampler:
      glDeleteSamplers(1, &name_);
      break;
    case ObjectKind::kProgram:
      glDeleteProgram(name_);
      break;
    case ObjectKind::kVertexArray:
      glDeleteVertexArrays(1, &name_);
      break;
    case ObjectKind::kFramebuffer:
      glDeleteFramebuffers(1, &name_);
      break;
    case ObjectKind::kTimestamp:
      glDeleteQueries(1, &name_);
      break;
    case ObjectKind::kNone:
      break;
  }
  name_ = 0;
}

}  // namespace grisaille::opengl
