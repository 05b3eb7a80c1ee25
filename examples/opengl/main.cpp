// SPDX-License-Identifier: MIT
// opengl_host OUTPUT_FOLDER: draws five frames and writes the last one as picture.ppm. Also writes
// raw numbers, rows from the top: depth.f32 (depth buffer), normal.f32 (three components, view
// space), ao.f32, and vertices.f32 (of the scene: position and normal).
#include <cstdio>
#include <cstring>

// grisaille: begin
#include <grisaille/host.h>
// grisaille: end

#include "renderer.h"
#include "scene.h"
#include "window.h"

namespace example {
namespace {

// grisaille: begin
void check(int result) {
  if (result != 0) throw std::runtime_error(grisaille_host_last_error());
}

// Ambient occlusion of the renderer's scene. Uses the current OpenGL context.
class Occlusion {
 public:
  explicit Occlusion(const Renderer& renderer) {
    grisaille_host_opengl opengl = {};
    opengl.struct_size = sizeof(opengl);
    check(grisaille_host_device_opengl(&opengl, &device_));
    depth_ = wrap(renderer.depth);
    normal_ = wrap(renderer.normal);
    grisaille_host_effect_desc desc = {};
    desc.struct_size = sizeof(desc);
    desc.width = kWidth;
    desc.height = kHeight;
    desc.rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM;
    desc.effect = "ssao";
    check(grisaille_host_effect_create(device_, &desc, &effect_));
    check(grisaille_host_effect_set(effect_, "radius", 0.5));
  }

  ~Occlusion() {
    grisaille_host_effect_destroy(effect_);
    grisaille_host_texture_destroy(depth_);
    grisaille_host_texture_destroy(normal_);
    grisaille_host_device_destroy(device_);
  }

  // Records the effect. Returns a texture of the picture's size: ambient visibility, 1 = open.
  GLuint record(uint64_t number) {
    const glm::dmat4 view(viewFromWorld()), projection(clipFromView());
    grisaille_host_camera camera = {};
    camera.struct_size = sizeof(camera);
    camera.clip = GRISAILLE_HOST_CLIP_MINUS_ONE_TO_ONE;
    for (int i = 0; i < 16; ++i) camera.view[i] = view[i / 4][i % 4];
    for (int i = 0; i < 16; ++i) camera.projection[i] = projection[i / 4][i % 4];
    grisaille_host_frame frame = {};
    frame.struct_size = sizeof(frame);
    frame.number = number;
    frame.camera = &camera;
    frame.depth = depth_;
    frame.depth_kind = GRISAILLE_HOST_DEPTH_BUFFER;
    frame.normal = normal_;
    frame.normal_space = GRISAILLE_HOST_NORMALS_VIEW;
    check(grisaille_host_effect_record(effect_, &frame));
    grisaille_host_output output = {};
    output.struct_size = sizeof(output);
    check(grisaille_host_effect_output(effect_, "ao", &output));
    return static_cast<GLuint>(output.image);
  }

 private:
  grisaille_host_texture* wrap(GLuint name) {
    grisaille_host_texture_desc desc = {};
    desc.struct_size = sizeof(desc);
    desc.image = name;
    grisaille_host_texture* texture = nullptr;
    check(grisaille_host_texture_wrap(device_, &desc, &texture));
    return texture;
  }

  grisaille_host_device* device_ = nullptr;
  grisaille_host_texture *depth_ = nullptr, *normal_ = nullptr;
  grisaille_host_effect* effect_ = nullptr;
};
// grisaille: end

void run(const std::filesystem::path& folder) {
  const Window window;
  Renderer renderer;
  // grisaille: begin
  Occlusion occlusion(renderer);
  // grisaille: end
  GLuint visibility = 0;
  for (uint64_t frame = 0; frame < 5; ++frame) {
    renderer.drawScene();
    // grisaille: begin
    visibility = occlusion.record(frame);
    renderer.light(visibility);
    // grisaille: end
  }
  writeFile(folder / "depth.f32", read(renderer.depth, GL_DEPTH_COMPONENT, 1));
  writeFile(folder / "normal.f32", read(renderer.normal, GL_RGB, 3));
  writeFile(folder / "ao.f32", read(visibility, GL_RED, 1));
  writeFile(folder / "vertices.f32", scene());
  const std::vector<float> lit = read(renderer.lit, GL_RGBA, 4);
  std::vector<glm::vec4> pixels(lit.size() / 4);
  std::memcpy(pixels.data(), lit.data(), lit.size() * sizeof(float));
  writePicture(folder / "picture.ppm", pixels);
  if (glGetError() != GL_NO_ERROR) throw std::runtime_error("OpenGL reports an error");
}

}  // namespace
}  // namespace example

int main(int count, char** arguments) {
  try {
    if (count < 2) throw std::runtime_error("usage: opengl_host OUTPUT_FOLDER");
    example::run(arguments[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
