// SPDX-License-Identifier: MIT
#include "tests/host/opengl_host.h"

#include <epoxy/gl.h>

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

  host::Device device(const char* effectFolder) override {
    return host::Device::opengl({.effectFolder = effectFolder});
  }

  host::Texture texture(const host::Device& device, Texels texels, uint32_t width, uint32_t height,
                        const std::vector<float>& numbers) override {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    textures_.push_back(name);
    const GLenum format = texels == Texels::kFloat1     ? GL_R32F
                          : texels == Texels::kFloat4   ? GL_RGBA32F
                          : texels == Texels::kUnorm8x4 ? GL_RGBA8
                                                        : GL_DEPTH24_STENCIL8;
    const GLenum given = texels == Texels::kFloat1    ? GL_RED
                         : texels == Texels::kDepth24 ? GL_DEPTH_COMPONENT
                                                      : GL_RGBA;
    const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height);
    glTextureStorage2D(name, 1, format, w, h);
    glTextureSubImage2D(name, 0, 0, 0, w, h, given, GL_FLOAT, numbers.data());
    described_ = {.image = name};
    return {device, described_};
  }
  host::TextureSpec described() const override { return described_; }

  void frame(const std::function<void(void*, uint64_t)>& record) override {
    record(nullptr, frame_++);
  }

  void drop(const std::function<void(void*, uint64_t)>& record) override {
    record(nullptr, frame_);
  }

  std::vector<float> read(const grisaille_host_output& output) override {
    const bool one = output.native_format == GL_R16F || output.native_format == GL_R32F;
    std::vector<float> numbers(size_t{output.width} * output.height * (one ? 1 : 4));
    glGetTextureImage(static_cast<GLuint>(output.image), 0, one ? GL_RED : GL_RGBA, GL_FLOAT,
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
