// SPDX-License-Identifier: MIT
// The calling thread's current OpenGL context, whichever library created it. Check it before any
// OpenGL call: libepoxy ends the program if no context is current.
#pragma once

namespace grisaille::opengl {

// The EGLContext or GLXContext, or null if none is current. Use the pointer only for comparison.
void* currentContext();

}  // namespace grisaille::opengl
