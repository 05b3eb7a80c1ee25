// SPDX-License-Identifier: MIT
// Which OpenGL context the calling thread has, whoever made it. Asked before any call of OpenGL,
// since libepoxy ends the program where there is none.
#pragma once

namespace grisaille::opengl {

// EGL's or GLX's; null: none. It is a name to compare, no more.
void* currentContext();

}  // namespace grisaille::opengl
