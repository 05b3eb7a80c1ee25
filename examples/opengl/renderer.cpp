// SPDX-License-Identifier: MIT
#include "renderer.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <initializer_list>

#include "scene.h"

namespace example {
namespace {

constexpr const char* kSceneVertex = R"(#version 450
layout(location = 0) uniform mat4 view_from_world;
layout(location = 1) uniform mat4 clip_from_view;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 world_normal;
void main() {
  gl_Position = clip_from_view * (view_from_world * vec4(position, 1.0));
  world_normal = normal;
})";

constexpr const char* kSceneFragment = R"(#version 450
layout(location = 0) uniform mat4 view_from_world;
layout(location = 0) in vec3 world_normal;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 normal;
void main() {
  normal = vec4(mat3(view_from_world) * normalize(world_normal), 0.0);
  // A distant lamp, and ambient light from the sky.
  float lamp = max(dot(normalize(world_normal), normalize(vec3(0.5, 0.9, 0.4))), 0.0);
  colour = vec4(vec3(0.25) * lamp + vec3(0.5), 1.0);
})";

constexpr const char* kLightVertex = R"(#version 450
void main() {
  gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0.0, 1.0);
})";

constexpr const char* kLightFragment = R"(#version 450
layout(binding = 0) uniform sampler2D colour;
layout(binding = 1) uniform sampler2D visibility;
layout(location = 0) out vec4 lit;
void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  lit = texelFetch(colour, pixel, 0) * texelFetch(visibility, pixel, 0).x;
})";

GLuint program(const char* vertex, const char* fragment) {
  const GLuint made = glCreateProgram();
  const auto attach = [&](GLenum stage, const char* text) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(made, shader);
    glDeleteShader(shader);
  };
  attach(GL_VERTEX_SHADER, vertex);
  attach(GL_FRAGMENT_SHADER, fragment);
  glLinkProgram(made);
  GLint linked = GL_FALSE;
  glGetProgramiv(made, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) throw std::runtime_error("the driver cannot link a shader program");
  return made;
}

GLuint texture(GLenum format) {
  GLuint made = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &made);
  glTextureStorage2D(made, 1, format, kWidth, kHeight);
  return made;
}

GLuint framebuffer(GLuint depth, std::initializer_list<GLuint> colours) {
  GLuint made = 0;
  glCreateFramebuffers(1, &made);
  std::vector<GLenum> drawn;
  for (const GLuint one : colours) {
    drawn.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(drawn.size()));
    glNamedFramebufferTexture(made, drawn.back(), one, 0);
  }
  glNamedFramebufferDrawBuffers(made, static_cast<GLsizei>(drawn.size()), drawn.data());
  if (depth != 0) glNamedFramebufferTexture(made, GL_DEPTH_STENCIL_ATTACHMENT, depth, 0);
  return made;
}

}  // namespace

glm::mat4 clipFromView() {
  return glm::perspective(kAngle, static_cast<float>(kWidth) / static_cast<float>(kHeight), kNear,
                          kFar);
}

Renderer::Renderer()
    : depth(texture(GL_DEPTH24_STENCIL8)),
      normal(texture(GL_RGBA32F)),
      colour(texture(GL_RGBA16F)),
      lit(texture(GL_RGBA16F)),
      target_(framebuffer(depth, {colour, normal})),
      litTarget_(framebuffer(0, {lit})),
      scene_(program(kSceneVertex, kSceneFragment)),
      light_(program(kLightVertex, kLightFragment)) {
  const std::vector<Vertex> scene = example::scene();
  count_ = static_cast<GLsizei>(scene.size());
  glCreateBuffers(1, &vertices_);
  glNamedBufferStorage(vertices_, static_cast<GLsizeiptr>(scene.size() * sizeof(Vertex)),
                       scene.data(), 0);
  glCreateVertexArrays(1, &layout_);
  glCreateVertexArrays(1, &none_);
  glVertexArrayVertexBuffer(layout_, 0, vertices_, 0, sizeof(Vertex));
  for (const GLuint i : {0u, 1u}) {
    glEnableVertexArrayAttrib(layout_, i);
    glVertexArrayAttribFormat(layout_, i, 3, GL_FLOAT, GL_FALSE, i * sizeof(glm::vec3));
    glVertexArrayAttribBinding(layout_, i, 0);
  }
}

Renderer::~Renderer() {
  const GLuint textures[] = {depth, normal, colour, lit};
  glDeleteTextures(4, textures);
  const GLuint framebuffers[] = {target_, litTarget_};
  glDeleteFramebuffers(2, framebuffers);
  glDeleteProgram(scene_);
  glDeleteProgram(light_);
  glDeleteBuffers(1, &vertices_);
  const GLuint layouts[] = {layout_, none_};
  glDeleteVertexArrays(2, layouts);
}

void Renderer::drawScene() {
  glBindFramebuffer(GL_FRAMEBUFFER, target_);
  glViewport(0, 0, kWidth, kHeight);
  glEnable(GL_DEPTH_TEST);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  glUseProgram(scene_);
  const glm::mat4 clip = clipFromView();
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(viewFromWorld()));
  glUniformMatrix4fv(1, 1, GL_FALSE, glm::value_ptr(clip));
  glBindVertexArray(layout_);
  glDrawArrays(GL_TRIANGLES, 0, count_);
}

void Renderer::light(GLuint visibility) {
  glBindFramebuffer(GL_FRAMEBUFFER, litTarget_);
  glDisable(GL_DEPTH_TEST);
  glUseProgram(light_);
  glBindTextureUnit(0, colour);
  glBindTextureUnit(1, visibility);
  glBindVertexArray(none_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<float> read(GLuint texture, GLenum format, int components) {
  const size_t row = size_t{kWidth} * static_cast<size_t>(components);
  std::vector<float> pixels(row * kHeight);
  glGetTextureImage(texture, 0, format, GL_FLOAT,
                    static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
  for (size_t y = 0; y < kHeight / 2; ++y) {
    std::swap_ranges(pixels.begin() + static_cast<ptrdiff_t>(y * row),
                     pixels.begin() + static_cast<ptrdiff_t>((y + 1) * row),
                     pixels.begin() + static_cast<ptrdiff_t>((kHeight - 1 - y) * row));
  }
  return pixels;
}

}  // namespace example
