// SPDX-License-Identifier: MIT
#include "backends/opengl/host_state.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace grisaille::opengl {
namespace {

// A parameter of the row layout of uploads, and the value that the layer needs.
struct Unpack {
  GLenum name;
  GLint needed;
};
constexpr std::array<Unpack, 8> kUnpack = {{{GL_UNPACK_ALIGNMENT, 1},
                                            {GL_UNPACK_SWAP_BYTES, 0},
                                            {GL_UNPACK_LSB_FIRST, 0},
                                            {GL_UNPACK_ROW_LENGTH, 0},
                                            {GL_UNPACK_IMAGE_HEIGHT, 0},
                                            {GL_UNPACK_SKIP_ROWS, 0},
                                            {GL_UNPACK_SKIP_PIXELS, 0},
                                            {GL_UNPACK_SKIP_IMAGES, 0}}};

uint32_t slotsOf(GLenum limit, uint32_t most) {
  GLint has = 0;
  glGetIntegerv(limit, &has);
  return std::min(most, static_cast<uint32_t>(std::max(has, 0)));
}

GLint stateOf(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

GLint stateOf(GLenum name, GLuint slot) {
  GLint value = 0;
  glGetIntegeri_v(name, slot, &value);
  return value;
}

GLint64 wideStateOf(GLenum name, GLuint slot) {
  GLint64 value = 0;
  glGetInteger64i_v(name, slot, &value);
  return value;
}

GLuint nameOf(GLint value) {
  return static_cast<GLuint>(value);
}

struct BufferNames {
  GLenum target, binding, start, size;
};
constexpr BufferNames kUniform = {GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING,
                                  GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE};
constexpr BufferNames kStorage = {GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING,
                                  GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE};

template <typename Buffers>
void saveBuffers(Buffers& buffers, const BufferNames& names, uint32_t count) {
  buffers.general = stateOf(names.binding);
  for (GLuint i = 0; i < count; ++i) {
    buffers.slots[i] = {stateOf(names.binding, i), wideStateOf(names.start, i),
                        wideStateOf(names.size, i)};
  }
}

// A slot with size 0 binds the whole buffer.
template <typename Buffers>
void restoreBuffers(const Buffers& buffers, const BufferNames& names, uint32_t count) {
  for (GLuint i = 0; i < count; ++i) {
    const auto& slot = buffers.slots[i];
    if (slot.buffer == 0 || slot.size == 0) {
      glBindBufferBase(names.target, i, nameOf(slot.buffer));
    } else {
      glBindBufferRange(names.target, i, nameOf(slot.buffer), static_cast<GLintptr>(slot.offset),
                        static_cast<GLsizeiptr>(slot.size));
    }
  }
  glBindBuffer(names.target, nameOf(buffers.general));
}

}  // namespace

HostState::HostState()
    : images_(slotsOf(GL_MAX_IMAGE_UNITS, kSlots)),
      storages_(slotsOf(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, kSlots)) {}

void HostState::save() {
  program_ = stateOf(GL_CURRENT_PROGRAM);
  activeUnit_ = stateOf(GL_ACTIVE_TEXTURE);
  unpackBuffer_ = stateOf(GL_PIXEL_UNPACK_BUFFER_BINDING);
  for (size_t i = 0; i < kUnpack.size(); ++i) unpack_[i] = stateOf(kUnpack[i].name);
  for (GLuint i = 0; i < kSlots; ++i) {
    glActiveTexture(GL_TEXTURE0 + i);
    units_[i] = {stateOf(GL_TEXTURE_BINDING_2D), stateOf(GL_TEXTURE_BINDING_2D_ARRAY),
                 stateOf(GL_SAMPLER_BINDING)};
  }
  for (GLuint i = 0; i < images_; ++i) {
    image_[i] = {stateOf(GL_IMAGE_BINDING_NAME, i),    stateOf(GL_IMAGE_BINDING_LEVEL, i),
                 stateOf(GL_IMAGE_BINDING_LAYERED, i), stateOf(GL_IMAGE_BINDING_LAYER, i),
                 stateOf(GL_IMAGE_BINDING_ACCESS, i),  stateOf(GL_IMAGE_BINDING_FORMAT, i)};
  }
  saveBuffers(uniform_, kUniform, kSlots);
  saveBuffers(storage_, kStorage, storages_);
}

void HostState::prepare() {
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  for (const Unpack& one : kUnpack) glPixelStorei(one.name, one.needed);
}

// Binds textures by target: glBindTextureUnit(unit, 0) would unbind the unit's other targets too.
void HostState::restore() const {
  for (GLuint i = 0; i < kSlots; ++i) {
    glActiveTexture(GL_TEXTURE0 + i);
    glBindTexture(GL_TEXTURE_2D, nameOf(units_[i].texture));
    glBindTexture(GL_TEXTURE_2D_ARRAY, nameOf(units_[i].array));
    glBindSampler(i, nameOf(units_[i].sampler));
  }
  glActiveTexture(static_cast<GLenum>(activeUnit_));
  for (GLuint i = 0; i < images_; ++i) {
    const Image& image = image_[i];
    glBindImageTexture(i, nameOf(image.texture), image.level,
                       image.layered != 0 ? GL_TRUE : GL_FALSE, image.layer,
                       static_cast<GLenum>(image.access), static_cast<GLenum>(image.format));
  }
  restoreBuffers(uniform_, kUniform, kSlots);
  restoreBuffers(storage_, kStorage, storages_);
  for (size_t i = 0; i < kUnpack.size(); ++i) glPixelStorei(kUnpack[i].name, unpack_[i]);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, nameOf(unpackBuffer_));
  glUseProgram(nameOf(program_));
}

}  // namespace grisaille::opengl
