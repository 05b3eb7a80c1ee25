// SPDX-License-Identifier: MIT
// A renderer of one scene, with OpenGL's own conventions: rows from the bottom, a depth buffer with
// 0 at the near plane, normals in view space. Then a pass over the colour that takes the share of
// the sky which each pixel sees.
#pragma once

#include <epoxy/gl.h>

#include <glm/glm.hpp>
#include <vector>

namespace example {

class Renderer {
 public:
  Renderer();
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  void drawScene();
  // Into `lit`, with the share of the sky that is seen, of the size of the picture.
  void light(GLuint visibility);

  GLuint depth = 0, normal = 0, colour = 0, lit = 0;

 private:
  GLuint target_ = 0, litTarget_ = 0;  // framebuffers
  GLuint scene_ = 0, light_ = 0;       // programs
  GLuint vertices_ = 0, layout_ = 0, none_ = 0;
  GLsizei count_ = 0;
};

// Components of a texture of the picture's size, rows from the top.
std::vector<float> read(GLuint texture, GLenum format, int components);

}  // namespace example
