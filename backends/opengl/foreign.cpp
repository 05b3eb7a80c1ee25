// SPDX-License-Identifier: MIT
#include "backends/opengl/foreign.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

int ofTexture(GLuint name, GLenum what) {
  GLint value = 0;
  glGetTextureParameteriv(name, what, &value);
  return value;
}

int ofLevel(GLuint name, GLenum what) {
  GLint value = 0;
  glGetTextureLevelParameteriv(name, 0, what, &value);
  return value;
}

bool sampledAsFloat(int type) {
  return type == GL_FLOAT || type == GL_UNSIGNED_NORMALIZED || type == GL_SIGNED_NORMALIZED;
}

// The name of an internal format, for messages; null: another format.
const char* formatNameOf(int format) {
  switch (format) {
#define NAME(format) \
  case format:       \
    return #format;
    NAME(GL_DEPTH_COMPONENT16)
    NAME(GL_DEPTH_COMPONENT24)
    NAME(GL_DEPTH_COMPONENT32)
    NAME(GL_DEPTH_COMPONENT32F)
    NAME(GL_DEPTH24_STENCIL8)
    NAME(GL_DEPTH32F_STENCIL8)
    NAME(GL_R8)
    NAME(GL_R16)
    NAME(GL_R16F)
    NAME(GL_R32F)
    NAME(GL_RG8)
    NAME(GL_RG16)
    NAME(GL_RG16_SNORM)
    NAME(GL_RG16F)
    NAME(GL_RG32F)
    NAME(GL_RGB8)
    NAME(GL_RGB16F)
    NAME(GL_RGB32F)
    NAME(GL_R11F_G11F_B10F)
    NAME(GL_RGB10_A2)
    NAME(GL_RGBA8)
    NAME(GL_RGBA8_SNORM)
    NAME(GL_SRGB8_ALPHA8)
    NAME(GL_RGBA16)
    NAME(GL_RGBA16F)
    NAME(GL_RGBA32F)
    NAME(GL_R8UI)
    NAME(GL_R32UI)
    NAME(GL_RGBA8UI)
    NAME(GL_RGBA32UI)
    NAME(GL_STENCIL_INDEX8)
#undef NAME
    default:
      return nullptr;
  }
}

std::string formatText(GLuint name) {
  const int format = ofLevel(name, GL_TEXTURE_INTERNAL_FORMAT);
  const char* known = formatNameOf(format);
  return fmt::format("{} ({:#x})", known != nullptr ? known : "the internal format", format);
}

void checkFormat(GLuint name) {
  const bool depth = ofLevel(name, GL_TEXTURE_DEPTH_SIZE) > 0;
  if (!sampledAsFloat(ofLevel(name, depth ? GL_TEXTURE_DEPTH_TYPE : GL_TEXTURE_RED_TYPE))) {
    throw Error(ErrorId::kHostTexture, "texture {} is {}, which is not sampled as floats", name,
                formatText(name));
  }
  if (depth && ofTexture(name, GL_DEPTH_STENCIL_TEXTURE_MODE) == GL_STENCIL_INDEX) {
    throw Error(ErrorId::kHostTexture,
                "GL_DEPTH_STENCIL_TEXTURE_MODE of texture {} is GL_STENCIL_INDEX, which hides its "
                "depth",
                name);
  }
}

void checkSize(GLuint name, const gpu::ForeignTexture& texture, uint32_t width, uint32_t height) {
  const bool given = texture.width != 0 || texture.height != 0;
  if (given && (texture.width != width || texture.height != height)) {
    throw Error(ErrorId::kHostTexture, "texture {} has {} x {} pixels, not {} x {}", name, width,
                height, texture.width, texture.height);
  }
}

// A 2D texture that shows a layer of an array.
Object viewOfLayer(GLuint array, uint32_t layer) {
  Object view = Object::textureView();
  glTextureView(view.name(), GL_TEXTURE_2D, array,
                static_cast<GLenum>(ofLevel(array, GL_TEXTURE_INTERNAL_FORMAT)), 0, 1, layer, 1);
  return view;
}

void addLayers(TextureResource& resource, GLuint name, const gpu::ForeignTexture& texture) {
  const auto count = static_cast<uint32_t>(ofLevel(name, GL_TEXTURE_DEPTH));
  if (texture.layers < 1 || texture.firstLayer >= count ||
      texture.layers > count - texture.firstLayer) {
    throw Error(ErrorId::kHostTexture, "texture {} has {} layers, not {} from {} on", name, count,
                texture.layers, texture.firstLayer);
  }
  if (ofTexture(name, GL_TEXTURE_IMMUTABLE_FORMAT) == GL_FALSE) {
    throw Error(ErrorId::kHostTexture,
                "the array {} has no immutable storage, of which its layers could be shown: create "
                "it with glTextureStorage3D()",
                name);
  }
  if (texture.layers == 1) {
    resource.object = viewOfLayer(name, texture.firstLayer);
    return;
  }
  resource.object = Object::foreign(name);
  for (uint32_t layer = 0; layer < texture.layers; ++layer) {
    resource.views.push_back({.range = {.mip = 0, .mipCount = 1, .layer = layer, .layerCount = 1},
                              .arrayed = false,
                              .object = viewOfLayer(name, texture.firstLayer + layer)});
  }
}

}  // namespace

TextureResource wrapForeign(const gpu::ForeignTexture& texture) {
  const auto name = static_cast<GLuint>(texture.name);
  if (texture.name != name || glIsTexture(name) == GL_FALSE) {
    throw Error(ErrorId::kHostTexture, "{} names no texture", texture.name);
  }
  const int target = ofTexture(name, GL_TEXTURE_TARGET);
  if (target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_ARRAY) {
    throw Error(ErrorId::kHostTexture, "texture {} has the target {:#x}, not a 2D texture or array",
                name, target);
  }
  checkFormat(name);
  const auto width = static_cast<uint32_t>(ofLevel(name, GL_TEXTURE_WIDTH));
  const auto height = static_cast<uint32_t>(ofLevel(name, GL_TEXTURE_HEIGHT));
  checkSize(name, texture, width, height);
  TextureResource resource;
  resource.foreign = true;
  resource.desc = {.format = gpu::Format::kRgba32Float,
                   .width = width,
                   .height = height,
                   .layers = texture.layers,
                   .usage = gpu::TextureUsage::kSampled};
  if (target == GL_TEXTURE_2D_ARRAY) {
    addLayers(resource, name, texture);
  } else if (texture.firstLayer != 0 || texture.layers != 1) {
    throw Error(ErrorId::kHostTexture, "texture {} is no array, but {} layers from {} on are asked",
                name, texture.layers, texture.firstLayer);
  } else {
    resource.object = Object::foreign(name);
  }
  return resource;
}

gpu::ForeignInfo describeForeign(const TextureResource& texture) {
  const GLuint name = texture.object.name();
  uint32_t channels = 0;
  for (const GLenum size :
       {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE, GL_TEXTURE_ALPHA_SIZE}) {
    if (ofLevel(name, size) > 0) ++channels;
  }
  const bool depth = ofLevel(name, GL_TEXTURE_DEPTH_SIZE) > 0;
  return {.width = texture.desc.width,
          .height = texture.desc.height,
          .layers = texture.desc.layers,
          .channels = depth ? 1 : channels,
          .depth = depth,
          .format = formatText(name)};
}

}  // namespace grisaille::opengl
