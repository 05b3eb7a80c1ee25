// SPDX-License-Identifier: MIT
#include "tests/host/opengl_host.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdio>

#include "examples/opengl/window.h"

namespace grisaille::tests {
namespace {

void onMessage(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
               const void* count) {
  if (type != GL_DEBUG_TYPE_ERROR) return;
  std::fprintf(stderr, "OpenGL: %s\n", text);
  ++*static_cast<int*>(const_cast<void*>(count));
}

struct Kind {
  GLenum internal, given;
};

Kind kindOf(Texels texels) {
  switch (texels) {
    case Texels::kFloat1:
      return {GL_R32F, GL_RED};
    case Texels::kFloat4:
      return {GL_RGBA32F, GL_RGBA};
    case Texels::kHalf4:
      return {GL_RGBA16F, GL_RGBA};
    case Texels::kUnorm8x4:
      return {GL_RGBA8, GL_RGBA};
    case Texels::kUnorm16x2:
      return {GL_RG16, GL_RG};
    case Texels::kUnorm10x3:
      return {GL_RGB10_A2, GL_RGB};
    case Texels::kDepth16:
      return {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT};
    case Texels::kDepth24:
      return {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT};
    case Texels::kDepth24Stencil:
      return {GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT};
    case Texels::kDepth32:
      return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT};
    default:
      return {GL_DEPTH32F_STENCIL8, GL_DEPTH_COMPONENT};
  }
}

class OpenGlHost : public Host {
 public:
  OpenGlHost() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(onMessage, &complaints_);
  }
  ~OpenGlHost() override {
    glDeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
  }

  host::Device device(const char* effectFolder, uint32_t flags,
                      const grisaille_host_log* log) override {
    return host::Device::opengl({.effectFolder = effectFolder, .flags = flags, .log = log});
  }

  host::Texture texture(const host::Device& device, Texels texels, uint32_t width, uint32_t height,
                        const std::vector<float>& numbers, uint32_t layers) override {
    GLuint name = 0;
    glCreateTextures(layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D, 1, &name);
    textures_.push_back(name);
    const Kind kind = kindOf(texels);
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    if (layers > 0) {
      const auto count = static_cast<GLsizei>(layers);
      glTextureStorage3D(name, 1, kind.internal, w, h, count);
      glTextureSubImage3D(name, 0, 0, 0, 0, w, h, count, kind.given, GL_FLOAT, numbers.data());
    } else {
      glTextureStorage2D(name, 1, kind.internal, w, h);
      glTextureSubImage2D(name, 0, 0, 0, w, h, kind.given, GL_FLOAT, numbers.data());
    }
    described_ = {.image = name, .layers = std::max(layers, 1u)};
    return {device, described_};
  }
  bool has(Texels) const override { return true; }
  host::TextureSpec described() const override { return described_; }

  void frame(const std::function<void(void*, uint64_t)>& record) override {
    record(nullptr, frame_++);
  }

  void drop(const std::function<void(void*, uint64_t)>& record) override {
    record(nullptr, frame_);
  }

  std::vector<float> read(const grisaille_host_output& output, uint32_t layer) override {
    const bool one = output.native_format == GL_R16F || output.native_format == GL_R32F;
    std::vector<float> numbers(size_t{output.width} * output.height * (one ? 1 : 4));
    glGetTextureSubImage(static_cast<GLuint>(output.image), 0, 0, 0, static_cast<GLint>(layer),
                         static_cast<GLsizei>(output.width), static_cast<GLsizei>(output.height), 1,
                         one ? GL_RED : GL_RGBA, GL_FLOAT,
                         static_cast<GLsizei>(numbers.size() * sizeof(float)), numbers.data());
    return numbers;
  }

  int complaints() const override { return complaints_ + (glGetError() != GL_NO_ERROR ? 1 : 0); }

 private:
  example::Window window_;
  std::vector<GLuint> textures_;
  host::TextureSpec described_;
  uint64_t frame_ = 0;
  int complaints_ = 0;
};

}  // namespace

std::unique_ptr<Host> makeOpenGlHost() {
  return std::make_unique<OpenGlHost>();
}

}  // namespace grisaille::tests
