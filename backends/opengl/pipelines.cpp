// SPDX-License-Identifier: MIT
#include "backends/opengl/pipelines.h"

#include <epoxy/gl.h>

#include <vector>

#include "backends/opengl/debug_output.h"

namespace grisaille::opengl {
namespace {

using gpu::Specialization;

std::string literal(const grisaille_shader_constant& constant, uint32_t bits) {
  switch (constant.type) {
    case GRISAILLE_SCALAR_INT:
      return fmt::format("int({}u)", bits);
    case GRISAILLE_SCALAR_FLOAT:
      return fmt::format("uintBitsToFloat({:#x}u)", bits);
    case GRISAILLE_SCALAR_BOOL:
      return bits != 0 ? "true" : "false";
    default:
      return fmt::format("{}u", bits);
  }
}

// The shader's text with macros for its constants: SPIRV-Cross generates GLSL that reads
// specialisation constants from macros.
std::string specialised(const gpu::Shader& shader, std::span<const Specialization> values) {
  std::string defines;
  for (uint32_t i = 0; i < shader.constant_count; ++i) {
    for (const Specialization& value : values) {
      if (value.id != shader.constants[i].id) continue;
      defines += fmt::format("#define SPIRV_CROSS_CONSTANT_ID_{} {}\n", value.id,
                             literal(shader.constants[i], value.bits));
    }
  }
  std::string text = shader.glsl;
  text.insert(text.find('\n') + 1, defines);  // nothing may stand before #version
  return text;
}

std::string firstLine(const std::string& log) {
  const size_t begin = log.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos || log[begin] == '\0') return "the driver does not say why";
  return log.substr(begin, log.find_first_of("\r\n", begin) - begin);
}

std::string programLog(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  if (length > 0) glGetProgramInfoLog(program, length, nullptr, log.data());
  return log;
}

std::string shaderLog(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  if (length > 0) glGetShaderInfoLog(shader, length, nullptr, log.data());
  return log;
}

// Compiles the shader and attaches it to the program, which then owns it.
void attachStage(GLuint program, const gpu::Shader* shader, GLenum stage, std::string_view label,
                 std::span<const Specialization> values) {
  if (shader == nullptr) {
    throw Error(ErrorId::kShaderMissing, "pipeline '{}' lacks a shader", label);
  }
  const std::string text = specialised(*shader, values);
  const char* source = text.c_str();
  const GLuint name = glCreateShader(stage);
  glAttachShader(program, name);
  glDeleteShader(name);  // takes effect when the program is deleted
  glShaderSource(name, 1, &source, nullptr);
  glCompileShader(name);
  GLint compiled = GL_FALSE;
  glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return;
  throw Error(ErrorId::kShaderRefused, "shader '{}' does not compile: {}", shader->name,
              firstLine(shaderLog(name)));
}

void link(const Object& program, std::string_view label, const char* shader) {
  glLinkProgram(program.name());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    throw Error(ErrorId::kShaderRefused, "shader '{}' of pipeline '{}' does not link: {}", shader,
                label, firstLine(programLog(program.name())));
  }
  program.label(label);
}

Object buildVertexArray(const gpu::GraphicsPipelineDesc& desc) {
  Object object(ObjectKind::kVertexArray);
  const GLuint name = object.name();
  for (const gpu::VertexAttribute& attribute : desc.attributes) {
    const auto components = static_cast<GLint>(gpu::attributeComponents(attribute.format));
    const bool bytes = attribute.format == gpu::AttributeFormat::kUnorm8x4;
    glEnableVertexArrayAttrib(name, attribute.location);
    glVertexArrayAttribFormat(name, attribute.location, components,
                              bytes ? GL_UNSIGNED_BYTE : GL_FLOAT, bytes ? GL_TRUE : GL_FALSE,
                              attribute.offset);
    glVertexArrayAttribBinding(name, attribute.location, attribute.stream);
  }
  object.label(desc.label);
  return object;
}

}  // namespace

ComputePipelineResource buildCompute(const gpu::ComputePipelineDesc& desc) {
  const QuietDebugOutput quiet;
  ComputePipelineResource pipeline{.program = Object(ObjectKind::kProgram), .shader = desc.shader};
  attachStage(pipeline.program.name(), desc.shader, GL_COMPUTE_SHADER, desc.label, desc.constants);
  link(pipeline.program, desc.label, desc.shader->name);
  return pipeline;
}

GraphicsPipelineResource buildGraphics(const gpu::GraphicsPipelineDesc& desc) {
  const QuietDebugOutput quiet;
  GraphicsPipelineResource pipeline{
      .program = Object(ObjectKind::kProgram),
      .vertexArray = {},
      .vertex = desc.vertex,
      .fragment = desc.fragment,
      .strides = {desc.streamStrides.begin(), desc.streamStrides.end()},
      .blend = desc.blend};
  const GLuint program = pipeline.program.name();
  attachStage(program, desc.vertex, GL_VERTEX_SHADER, desc.label, desc.constants);
  if (desc.fragment != nullptr) {
    attachStage(program, desc.fragment, GL_FRAGMENT_SHADER, desc.label, desc.constants);
  }
  link(pipeline.program, desc.label, desc.vertex->name);
  pipeline.vertexArray = buildVertexArray(desc);
  return pipeline;
}

}  // namespace grisaille::opengl
