// SPDX-License-Identifier: MIT
// Renders one scene with OpenGL's conventions: rows from the bottom, a depth buffer with 0 at the
// near plane, normals in view space. A second pass multiplies the colour by the ambient visibility.
#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <vector>

namespace example {

// The projection, with clip z from -1 to 1.
glm::mat4 clipFromView();

class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Draws into `depth`, `normal` and `colour`.
  void drawScene();
  // Writes colour x visibility into `lit`. visibility: texture of the picture's size, read from r.
  void light(GLuint visibility);

  GLuint depth = 0, normal = 0, colour = 0, lit = 0;

 private:
  GLuint target_ = 0, litTarget_ = 0;  // framebuffers
  GLuint scene_ = 0, light_ = 0;       // programs
  GLuint vertices_ = 0, layout_ = 0, none_ = 0;
  GLsizei count_ = 0;
};

// Reads a texture of the picture's size back, rows from the top. components: of `format`.
std::vector<float> read(GLuint texture, GLenum format, int components);

}  // namespace example
