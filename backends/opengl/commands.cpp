// SPDX-License-Identifier: MIT
#include "backends/opengl/commands.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "backends/opengl/formats.h"

namespace grisaille::opengl {
namespace {

using gpu::Access;

constexpr size_t kMaxGroupLabel = 255;  // bytes; every OpenGL driver allows more

gpu::TextureView oneSubresource(const gpu::TextureView& view) {
  return {.texture = view.texture,
          .mip = view.mip,
          .mipCount = 1,
          .layer = view.layer,
          .layerCount = 1};
}

void clearColor(GLuint framebuffer, GLint index, gpu::Format format,
                const std::array<float, 4>& color) {
  if (format != gpu::Format::kR32Uint) {
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, index, color.data());
    return;
  }
  GLuint values[4] = {};
  std::transform(color.begin(), color.end(), values,
                 [](float value) { return static_cast<GLuint>(value); });
  glClearNamedFramebufferuiv(framebuffer, GL_COLOR, index, values);
}

void setCull(gpu::Cull cull) {
  if (cull == gpu::Cull::kNone) {
    glDisable(GL_CULL_FACE);
    return;
  }
  glEnable(GL_CULL_FACE);
  glCullFace(cull == gpu::Cull::kBack ? GL_BACK : GL_FRONT);
}

void setBlend(gpu::Blend blend) {
  (blend == gpu::Blend::kNone ? glDisable : glEnable)(GL_BLEND);
}

// Sets the scissor rectangle for one draw and removes it afterwards, because clears and copies must
// not be clipped. OpenGL counts rows from the framebuffer's first row, which is the top one here.
class ScissorGuard {
 public:
  explicit ScissorGuard(const gpu::Scissor& scissor) : on_(scissor.width != 0) {
    if (!on_) return;
    glEnable(GL_SCISSOR_TEST);
    glScissor(static_cast<GLint>(scissor.x), static_cast<GLint>(scissor.y),
              static_cast<GLsizei>(scissor.width), static_cast<GLsizei>(scissor.height));
  }
  ~ScissorGuard() {
    if (on_) glDisable(GL_SCISSOR_TEST);
  }
  ScissorGuard(const ScissorGuard&) = delete;
  ScissorGuard& operator=(const ScissorGuard&) = delete;

 private:
  bool on_;
};

}  // namespace

GlCommands::GlCommands(Context& context, Resources& resources, PassTimer& timer,
                       uint32_t uniformAlignment)
    : context_(context),
      resources_(resources),
      timer_(timer),
      uniforms_(resources, uniformAlignment) {}

void GlCommands::beginFrame(uint32_t slot) {
  uniforms_.beginFrame(slot);
}

void GlCommands::endFrame() {
  closeGroups();
  transients_.endFrame([&](gpu::Texture texture) { resources_.destroy(texture); });
}

void GlCommands::openGroup(std::string_view label) {
  const std::string_view name = label.substr(0, kMaxGroupLabel);
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
  ++groups_;
}

void GlCommands::closeGroups() {
  for (; groups_ > 0; --groups_) glPopDebugGroup();
}

void GlCommands::beginPass(std::string_view label) {
  context_.makeCurrent();
  openGroup(label);
  timer_.beginPass(label);
}

void GlCommands::endPass() {
  context_.makeCurrent();
  timer_.endPass();
  glPopDebugGroup();
  --groups_;
}

void GlCommands::render(const gpu::Render& render) {
  context_.makeCurrent();
  declareUses(render);
  resources_.barriers();
  bindTargets(render);
  for (const gpu::Draw& one : render.draws) draw(one);
}

void GlCommands::declareUses(const gpu::Render& render) {
  gpu::StateTracker& tracker = resources_.tracker;
  for (const gpu::ColorTarget& target : render.colors) {
    tracker.use(oneSubresource(target.view), Access::kColorTarget);
  }
  if (render.depth.view.texture) {
    tracker.use(oneSubresource(render.depth.view), Access::kDepthTarget);
  }
  for (const gpu::Draw& one : render.draws) {
    const GraphicsPipelineResource& pipeline = resources_.graphicsPipelines.get(one.pipeline);
    tracker.use(*pipeline.vertex, one.bindings);
    if (pipeline.fragment != nullptr) tracker.use(*pipeline.fragment, one.bindings);
    for (const gpu::BufferRange& stream : one.vertexStreams) {
      tracker.use(stream.buffer, Access::kVertex);
    }
    if (one.indices.buffer) tracker.use(one.indices.buffer, Access::kIndex);
  }
}

void GlCommands::bindTargets(const gpu::Render& render) {
  FramebufferKey key;
  uint32_t width = 0, height = 0;
  const auto attachment = [&](const gpu::TextureView& view) -> Attachment {
    const TextureResource& texture = resources_.textures.get(view.texture);
    width = std::max(1u, texture.desc.width >> view.mip);
    height = std::max(1u, texture.desc.height >> view.mip);
    return {.texture = texture.object.name(), .mip = view.mip, .layer = view.layer};
  };
  for (size_t i = 0; i < render.colors.size(); ++i) key[i] = attachment(render.colors[i].view);
  const bool depth = static_cast<bool>(render.depth.view.texture);
  if (depth) key[gpu::kMaxColorTargets] = attachment(render.depth.view);

  const GLuint framebuffer = resources_.framebuffer(key);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  (depth ? glEnable : glDisable)(GL_DEPTH_TEST);

  std::vector<GLenum> discarded;
  for (size_t i = 0; i < render.colors.size(); ++i) {
    const gpu::ColorTarget& target = render.colors[i];
    if (target.load == gpu::Load::kClear) {
      clearColor(framebuffer, static_cast<GLint>(i),
                 resources_.textures.get(target.view.texture).desc.format, target.clear);
    } else if (target.load == gpu::Load::kDiscard) {
      discarded.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i));
    }
  }
  if (depth && render.depth.load == gpu::Load::kClear) {
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &render.depth.clear);
  } else if (depth && render.depth.load == gpu::Load::kDiscard) {
    discarded.push_back(GL_DEPTH_ATTACHMENT);
  }
  if (discarded.empty()) return;
  glInvalidateNamedFramebufferData(framebuffer, static_cast<GLsizei>(discarded.size()),
                                   discarded.data());
}

void GlCommands::draw(const gpu::Draw& draw) {
  const GraphicsPipelineResource& pipeline = resources_.graphicsPipelines.get(draw.pipeline);
  bind(*pipeline.vertex, draw.bindings);
  if (pipeline.fragment != nullptr) bind(*pipeline.fragment, draw.bindings);
  const GLuint vertexArray = pipeline.vertexArray.name();
  for (size_t i = 0; i < draw.vertexStreams.size() && i < pipeline.strides.size(); ++i) {
    const gpu::BufferRange& stream = draw.vertexStreams[i];
    glVertexArrayVertexBuffer(
        vertexArray, static_cast<GLuint>(i), resources_.buffers.get(stream.buffer).object.name(),
        static_cast<GLintptr>(stream.offset), static_cast<GLsizei>(pipeline.strides[i]));
  }
  glUseProgram(pipeline.program.name());
  glBindVertexArray(vertexArray);
  setCull(draw.cull);
  setBlend(pipeline.blend);
  const ScissorGuard scissor(draw.scissor);
  const auto count = static_cast<GLsizei>(draw.count);
  if (!draw.indices.buffer) {
    glDrawArrays(GL_TRIANGLES, static_cast<GLint>(draw.first), count);
    return;
  }
  glVertexArrayElementBuffer(vertexArray,
                             resources_.buffers.get(draw.indices.buffer).object.name());
  const uint64_t offset = draw.indices.offset + uint64_t{draw.first} * sizeof(uint32_t);
  glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset));
}

void GlCommands::dispatch(const gpu::Dispatch& dispatch) {
  context_.makeCurrent();
  const ComputePipelineResource& pipeline = resources_.computePipelines.get(dispatch.pipeline);
  resources_.tracker.use(*pipeline.shader, dispatch.bindings);
  resources_.barriers();
  bind(*pipeline.shader, dispatch.bindings);
  glUseProgram(pipeline.program.name());
  glDispatchCompute(dispatch.groups[0], dispatch.groups[1], dispatch.groups[2]);
}

void GlCommands::bind(const gpu::Shader& shader, std::span<const gpu::Binding> bindings) {
  for (uint32_t i = 0; i < shader.slot_count; ++i) {
    const grisaille_shader_slot& slot = shader.slots[i];
    const auto binding = std::find_if(bindings.begin(), bindings.end(), [&](const auto& one) {
      return one.slotClass == slot.slot_class && one.slot == slot.slot;
    });
    if (binding == bindings.end()) continue;
    switch (slot.slot_class) {
      case GRISAILLE_SLOT_UNIFORM:
        bindBuffer(GL_UNIFORM_BUFFER, *binding);
        break;
      case GRISAILLE_SLOT_STORAGE:
        bindBuffer(GL_SHADER_STORAGE_BUFFER, *binding);
        break;
      case GRISAILLE_SLOT_TEXTURE:
        glBindTextureUnit(slot.slot, resources_.viewName(binding->view, slot.arrayed != 0));
        glBindSampler(slot.slot, resources_.samplers.get(binding->sampler).object.name());
        break;
      default:
        bindImage(slot, *binding);
        break;
    }
  }
}

void GlCommands::bindBuffer(uint32_t target, const gpu::Binding& binding) {
  const BufferResource& buffer = resources_.buffers.get(binding.buffer.buffer);
  const uint64_t rest = buffer.size - binding.buffer.offset;
  uint64_t size = binding.buffer.size == 0 ? rest : binding.buffer.size;
  // OpenGL rounds the size of a std140 block up to whole vec4s.
  if (target == GL_UNIFORM_BUFFER) size = std::min((size + 15) / 16 * 16, rest);
  glBindBufferRange(target, binding.slot, buffer.object.name(),
                    static_cast<GLintptr>(binding.buffer.offset), static_cast<GLsizeiptr>(size));
}

void GlCommands::bindImage(const grisaille_shader_slot& slot, const gpu::Binding& binding) {
  const gpu::TextureDesc& desc = resources_.textures.get(binding.view.texture).desc;
  const bool arrayed = slot.arrayed != 0;
  GLuint name = 0;
  GLint mip = 0, layer = 0;
  if (arrayed) {  // the one level that the view holds
    gpu::TextureView view = binding.view;
    view.mipCount = 1;
    name = resources_.viewName(view, true);
  } else {
    name = resources_.textures.get(binding.view.texture).object.name();
    mip = static_cast<GLint>(binding.view.mip);
    layer = static_cast<GLint>(binding.view.layer);
  }
  const GLenum access = slot.reads == 0    ? GL_WRITE_ONLY
                        : slot.writes == 0 ? GL_READ_ONLY
                                           : GL_READ_WRITE;
  glBindImageTexture(slot.slot, name, mip, arrayed ? GL_TRUE : GL_FALSE, layer, access,
                     glFormat(desc.format).internalFormat);
}

gpu::BufferRange GlCommands::uniform(std::span<const std::byte> bytes) {
  context_.makeCurrent();
  return uniforms_.push(bytes);
}

gpu::Texture GlCommands::transient(const gpu::TextureDesc& desc) {
  context_.makeCurrent();
  return transients_.take(
      desc, [&](const gpu::TextureDesc& wanted) { return resources_.createTexture(wanted); });
}

void GlCommands::upload(gpu::Buffer buffer, uint64_t offset, std::span<const std::byte> bytes) {
  context_.makeCurrent();
  const GLuint name = resources_.buffers.get(buffer).object.name();
  resources_.tracker.use(buffer, Access::kCopyWrite);
  resources_.barriers();
  glNamedBufferSubData(name, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                       bytes.data());
}

void GlCommands::upload(gpu::Texture texture, uint32_t mip, uint32_t layer,
                        std::span<const std::byte> bytes) {
  context_.makeCurrent();
  const TextureResource& resource = resources_.textures.get(texture);
  resources_.tracker.use(
      {.texture = texture, .mip = mip, .mipCount = 1, .layer = layer, .layerCount = 1},
      Access::kCopyWrite);
  resources_.barriers();
  const auto width = static_cast<GLsizei>(std::max(1u, resource.desc.width >> mip));
  const auto height = static_cast<GLsizei>(std::max(1u, resource.desc.height >> mip));
  const GlFormat& format = glFormat(resource.desc.format);
  const auto level = static_cast<GLint>(mip);
  if (resource.desc.layers > 1) {
    glTextureSubImage3D(resource.object.name(), level, 0, 0, static_cast<GLint>(layer), width,
                        height, 1, format.transferFormat, format.transferType, bytes.data());
  } else {
    glTextureSubImage2D(resource.object.name(), level, 0, 0, width, height, format.transferFormat,
                        format.transferType, bytes.data());
  }
}

}  // namespace grisaille::opengl
