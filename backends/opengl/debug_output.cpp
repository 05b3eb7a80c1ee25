// SPDX-License-Identifier: MIT
#include "backends/opengl/debug_output.h"

#include <epoxy/gl.h>

#include <string_view>

#include "core/base/error.h"

namespace grisaille::opengl {
namespace {

gpu::Severity severityOf(GLenum type, GLenum severity) {
  if (type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH) {
    return gpu::Severity::kError;
  }
  return severity == GL_DEBUG_SEVERITY_MEDIUM ? gpu::Severity::kWarning : gpu::Severity::kInfo;
}

void GLAPIENTRY onMessage(GLenum, GLenum type, GLuint, GLenum severity, GLsizei length,
                          const GLchar* text, const void* user) {
  std::string_view line(text, static_cast<size_t>(length));
  while (!line.empty() && (line.back() == '\n' || line.back() == '\0')) line.remove_suffix(1);
  const auto& sink = *static_cast<const gpu::MessageSink*>(user);
  sink(severityOf(type, severity), oneLine(line));
}

bool isNvidia() {
  const GLubyte* vendor = glGetString(GL_VENDOR);
  return vendor != nullptr &&
         std::string_view(reinterpret_cast<const char*>(vendor)).starts_with("NVIDIA");
}

// Two kinds of NVIDIA's messages are not about faults. One, of type performance, says that it
// compiles a program again. The other, of low severity, says that a clear finds textures or shaders
// unbound, which only a draw would use.
void leaveOutHints() {
  glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_PERFORMANCE, GL_DONT_CARE, 0, nullptr,
                        GL_FALSE);
  glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_OTHER, GL_DEBUG_SEVERITY_LOW, 0, nullptr,
                        GL_FALSE);
}

}  // namespace

void startDebugOutput(const gpu::MessageSink& sink, bool check) {
  GLint flags = 0;
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  if ((flags & GL_CONTEXT_FLAG_DEBUG_BIT) == 0) return;
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
  if (check) {
    for (const GLenum severity :
         {GL_DEBUG_SEVERITY_HIGH, GL_DEBUG_SEVERITY_MEDIUM, GL_DEBUG_SEVERITY_LOW}) {
      glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, severity, 0, nullptr, GL_TRUE);
    }
    if (isNvidia()) leaveOutHints();
  } else {
    glDebugMessageControl(GL_DONT_CARE, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  }
  glDebugMessageCallback(onMessage, &sink);
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // messages arrive on the thread that made the call
}

void stopDebugOutput() {
  glDisable(GL_DEBUG_OUTPUT);
  glDebugMessageCallback(nullptr, nullptr);
}

QuietDebugOutput::QuietDebugOutput() : wasOn_(glIsEnabled(GL_DEBUG_OUTPUT) == GL_TRUE) {
  if (wasOn_) glDisable(GL_DEBUG_OUTPUT);
}

QuietDebugOutput::~QuietDebugOutput() {
  if (wasOn_) glEnable(GL_DEBUG_OUTPUT);
}

}  // namespace grisaille::opengl
