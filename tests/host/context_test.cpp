// SPDX-License-Identifier: MIT
// A host's OpenGL context: recording preserves its state, and calls without it are refused.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <map>
#include <thread>

#include "examples/opengl/window.h"
#include "tests/host/opengl_host.h"
#include "tests/host/seen.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kSide = 16;

// The state that recording might touch, by name.
std::map<std::string, int64_t> stateOf() {
  std::map<std::string, int64_t> state;
  const auto get = [&](const char* name, GLenum what) {
    GLint64 value = 0;
    glGetInteger64v(what, &value);
    state[name] = value;
  };
  get("program", GL_CURRENT_PROGRAM);
  get("vertex array", GL_VERTEX_ARRAY_BINDING);
  get("draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING);
  get("read framebuffer", GL_READ_FRAMEBUFFER_BINDING);
  get("active texture", GL_ACTIVE_TEXTURE);
  get("unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING);
  get("pack buffer", GL_PIXEL_PACK_BUFFER_BINDING);
  get("unpack alignment", GL_UNPACK_ALIGNMENT);
  get("unpack row length", GL_UNPACK_ROW_LENGTH);
  get("unpack skip rows", GL_UNPACK_SKIP_ROWS);
  get("pack alignment", GL_PACK_ALIGNMENT);
  get("uniform buffer", GL_UNIFORM_BUFFER_BINDING);
  get("storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING);
  get("clip origin", GL_CLIP_ORIGIN);
  get("clip depth", GL_CLIP_DEPTH_MODE);
  get("depth function", GL_DEPTH_FUNC);
  get("blend source", GL_BLEND_SRC_RGB);
  get("viewport", GL_VIEWPORT);
  for (const GLenum flag : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST,
                            GL_FRAMEBUFFER_SRGB, GL_DEBUG_OUTPUT}) {
    state["flag " + std::to_string(flag)] = glIsEnabled(flag);
  }
  GLint active = 0;
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
  for (GLuint i = 0; i < 16; ++i) {
    const std::string slot = " " + std::to_string(i);
    const auto at = [&](const char* name, GLenum what) {
      GLint64 value = 0;
      glGetInteger64i_v(what, i, &value);
      state[name + slot] = value;
    };
    glActiveTexture(GL_TEXTURE0 + i);
    get(("texture" + slot).c_str(), GL_TEXTURE_BINDING_2D);
    get(("array" + slot).c_str(), GL_TEXTURE_BINDING_2D_ARRAY);
    get(("cube" + slot).c_str(), GL_TEXTURE_BINDING_CUBE_MAP);
    get(("sampler" + slot).c_str(), GL_SAMPLER_BINDING);
    at("uniform", GL_UNIFORM_BUFFER_BINDING);
    at("uniform start", GL_UNIFORM_BUFFER_START);
    at("uniform size", GL_UNIFORM_BUFFER_SIZE);
    if (i >= 8) continue;
    at("storage", GL_SHADER_STORAGE_BUFFER_BINDING);
    at("storage start", GL_SHADER_STORAGE_BUFFER_START);
    at("storage size", GL_SHADER_STORAGE_BUFFER_SIZE);
    at("image", GL_IMAGE_BINDING_NAME);
    at("image level", GL_IMAGE_BINDING_LEVEL);
    at("image layered", GL_IMAGE_BINDING_LAYERED);
    at("image layer", GL_IMAGE_BINDING_LAYER);
    at("image access", GL_IMAGE_BINDING_ACCESS);
    at("image format", GL_IMAGE_BINDING_FORMAT);
  }
  glActiveTexture(static_cast<GLenum>(active));
  return state;
}

// Binds something to every binding point.
void disturb() {
  GLuint buffer = 0, sampler = 0;
  std::array<GLuint, 3> textures = {};
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, 4096, nullptr, GL_DYNAMIC_STORAGE_BIT);
  glCreateSamplers(1, &sampler);
  glCreateTextures(GL_TEXTURE_2D, 1, &textures[0]);
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &textures[1]);
  glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &textures[2]);
  glTextureStorage2D(textures[0], 1, GL_RGBA8, 4, 4);
  glTextureStorage3D(textures[1], 1, GL_RGBA8, 4, 4, 2);
  glTextureStorage2D(textures[2], 1, GL_RGBA8, 4, 4);
  for (GLuint i = 0; i < 16; i += 2) {
    for (const GLuint texture : textures) glBindTextureUnit(i, texture);
    glBindSampler(i, sampler);
    glBindBufferRange(GL_UNIFORM_BUFFER, i, buffer, 256 * i / 2, 256);
    if (i < 8) {
      glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer, 256, 512);
      glBindImageTexture(i, textures[1], 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA8);
    } else {
      glBindTextureUnit(i + 1, textures[2]);
    }
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer);
  glActiveTexture(GL_TEXTURE5);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 123);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, 3);
  glEnable(GL_BLEND);
}

class OpenGlContext : public ::testing::Test {
 protected:
  OpenGlContext()
      : host_(makeOpenGlHost()),
        device_(host_->device()),
        depth_(host_->texture(device_, Texels::kFloat1, kSide, kSide,
                              std::vector<float>(kSide * kSide, 2.0f))) {}
  ~OpenGlContext() override { EXPECT_EQ(host_->complaints(), 0); }

  host::Effect effect() {
    return {device_,
            {.effect = "ssao",
             .width = kSide,
             .height = kSide,
             .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM}};
  }
  void record(host::Effect& effect) {
    constexpr double kView[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const glm::dmat4 projection = projectionOf({.angle = 1}, 1, {.near = 0.1});
    const host::Camera camera(kView, &projection[0][0]);
    host_->frame([&](void*, uint64_t number) {
      effect.record({.number = number,
                     .camera = camera,
                     .depth = depth_,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
    });
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
  host::Texture depth_;
};

TEST_F(OpenGlContext, StateIsAsItWas) {
  disturb();
  const auto before = stateOf();
  host::Effect one = effect();
  EXPECT_EQ(stateOf(), before) << "making an effect";
  for (const char* estimator : {"slices", "classic"}) {  // "classic" uploads a texture
    one.set("estimator", estimator);
    record(one);
    EXPECT_EQ(stateOf(), before) << estimator;
  }
  const std::vector<float> open = host_->read(one.output("ao"));
  EXPECT_GT(open[0], 0.5f);
  one.resize(8, 8);
  EXPECT_EQ(stateOf(), before) << "resizing";
}

int numberOf(const std::function<void()>& call) {
  try {
    call();
    return 0;
  } catch (const host::Failure& failure) {
    return failure.number();
  }
}

// On a thread without a context, and in another context.
TEST_F(OpenGlContext, OtherContextsAreRefused) {
  host::Effect one = effect();
  const auto expectRefused = [&] {
    EXPECT_EQ(numberOf([&] { effect(); }), 5604);
    EXPECT_EQ(numberOf([&] { record(one); }), 5604);
    EXPECT_EQ(numberOf([&] { one.resize(4, 4); }), 5604);
    EXPECT_EQ(numberOf([&] { host::Texture(device_, host_->described()); }), 5604);
    EXPECT_EQ(grisaille_host_effect_destroy(one.handle()), 5604);
    EXPECT_EQ(grisaille_host_texture_destroy(depth_.handle()), 5604);
    EXPECT_EQ(one.get("radius"), 0.5) << "needs no context";
  };
  std::thread([&] {
    expectRefused();
    EXPECT_EQ(numberOf([] { host::Device::opengl(); }), 5604);
  }).join();
  std::thread([&] {
    const example::Window other;
    expectRefused();
  }).join();
  record(one);
}

}  // namespace
}  // namespace grisaille::tests
