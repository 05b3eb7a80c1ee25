// SPDX-License-Identifier: MIT
#include "core/gpu/checking_descriptors.h"

#include <algorithm>
#include <bit>
#include <string>

#include "core/base/error.h"

namespace grisaille::gpu {
namespace {

constexpr const char* kStages[] = {"vertex", "fragment", "compute"};

bool known(Format format) {
  return format > Format::kNone && format <= Format::kD32Float;
}

void checkShader(const Shader* shader, grisaille_stage stage, std::string_view label) {
  if (shader == nullptr) {
    throw Error(ErrorId::kShaderMissing, "pipeline '{}' has no {} shader", label, kStages[stage]);
  }
  if (shader->struct_size < sizeof(Shader)) {
    throw Error(ErrorId::kShaderMissing,
                "a shader struct of pipeline '{}' has {} bytes; this program expects {}", label,
                shader->struct_size, sizeof(Shader));
  }
  if (shader->stage != stage) {
    throw Error(ErrorId::kShaderMissing, "pipeline '{}' has {}, of another stage, as its {} shader",
                label, shader->name, kStages[stage]);
  }
  if (shader->spirv == nullptr || shader->spirv_words == 0 || shader->glsl == nullptr) {
    throw Error(ErrorId::kShaderMissing, "shader {} of pipeline '{}' has no code", shader->name,
                label);
  }
}

std::string namesOf(std::span<const Shader* const> shaders) {
  std::string names;
  for (const Shader* shader : shaders) {
    if (!names.empty()) names += ", ";
    names += shader->name;
  }
  return names;
}

void checkConstants(std::span<const Specialization> constants,
                    std::span<const Shader* const> shaders, std::string_view label) {
  for (size_t i = 0; i < constants.size(); ++i) {
    const uint32_t id = constants[i].id;
    const grisaille_shader_constant* declared = nullptr;
    for (const Shader* shader : shaders) {
      for (uint32_t at = 0; at < shader->constant_count; ++at) {
        if (shader->constants[at].id == id) declared = &shader->constants[at];
      }
    }
    if (declared == nullptr) {
      throw Error(ErrorId::kSpecialization,
                  "pipeline '{}' sets constant {}, which no shader of it declares: {}", label, id,
                  namesOf(shaders));
    }
    if (declared->type == GRISAILLE_SCALAR_BOOL && constants[i].bits > 1) {
      throw Error(ErrorId::kSpecialization, "pipeline '{}' sets the bool {} to {}, not 0 or 1",
                  label, declared->name, constants[i].bits);
    }
    for (size_t earlier = 0; earlier < i; ++earlier) {
      if (constants[earlier].id != id) continue;
      throw Error(ErrorId::kSpecialization, "pipeline '{}' sets constant {} ({}) twice", label, id,
                  declared->name);
    }
  }
}

void checkAttributes(const GraphicsPipelineDesc& desc) {
  if (desc.streamStrides.size() > kMaxVertexStreams) {
    throw Error(ErrorId::kVertexLayout, "pipeline '{}' has {} vertex streams; the limit is {}",
                desc.label, desc.streamStrides.size(), kMaxVertexStreams);
  }
  for (size_t i = 0; i < desc.streamStrides.size(); ++i) {
    if (desc.streamStrides[i] != 0 && desc.streamStrides[i] % 4 == 0) continue;
    throw Error(ErrorId::kVertexLayout,
                "stream {} of pipeline '{}' has a stride of {}, not a multiple of 4 bytes", i,
                desc.label, desc.streamStrides[i]);
  }
  for (size_t i = 0; i < desc.attributes.size(); ++i) {
    const VertexAttribute& attribute = desc.attributes[i];
    const bool format = attribute.format <= AttributeFormat::kUnorm8x4;
    if (!format || attribute.stream >= desc.streamStrides.size()) {
      throw Error(
          ErrorId::kVertexLayout,
          "attribute {} of pipeline '{}' names stream {} of {} streams, or an unknown format",
          attribute.location, desc.label, attribute.stream, desc.streamStrides.size());
    }
    const uint32_t stride = desc.streamStrides[attribute.stream];
    const uint64_t end = uint64_t{attribute.offset} + attributeBytes(attribute.format);
    if (attribute.offset % 4 != 0 || end > stride) {
      throw Error(
          ErrorId::kVertexLayout,
          "attribute {} of pipeline '{}' ends at byte {} of a vertex of {}, or its offset is "
          "not a multiple of 4",
          attribute.location, desc.label, end, stride);
    }
    for (size_t earlier = 0; earlier < i; ++earlier) {
      if (desc.attributes[earlier].location != attribute.location) continue;
      throw Error(ErrorId::kVertexLayout, "pipeline '{}' has attribute {} twice", desc.label,
                  attribute.location);
    }
  }
}

void checkVertexInputs(const GraphicsPipelineDesc& desc) {
  for (uint32_t i = 0; i < desc.vertex->input_count; ++i) {
    const grisaille_shader_location& input = desc.vertex->inputs[i];
    const auto fed = std::find_if(
        desc.attributes.begin(), desc.attributes.end(),
        [&](const VertexAttribute& attribute) { return attribute.location == input.location; });
    if (fed == desc.attributes.end()) {
      throw Error(ErrorId::kVertexLayout, "no attribute of pipeline '{}' feeds input {} ({})",
                  desc.label, input.location, input.name);
    }
    const uint32_t components = attributeComponents(fed->format);
    if (input.type != GRISAILLE_SCALAR_FLOAT || components != input.components) {
      throw Error(
          ErrorId::kVertexLayout,
          "input {} ({}) of pipeline '{}' has {} components, but its attribute has {} floats",
          input.location, input.name, desc.label, input.components, components);
    }
  }
}

void checkBlend(const GraphicsPipelineDesc& desc) {
  if (desc.blend > Blend::kOver) {
    throw Error(ErrorId::kPipelineTargets, "pipeline '{}' has an unknown blend", desc.label);
  }
  if (desc.blend == Blend::kNone) return;
  for (const Format format : desc.colorFormats) {
    if (formatInfo(format).blends) continue;
    throw Error(ErrorId::kPipelineTargets,
                "pipeline '{}' blends a target of format {}, which cannot blend", desc.label,
                formatInfo(format).name);
  }
}

void checkOutputs(const GraphicsPipelineDesc& desc) {
  const uint32_t outputs = desc.fragment == nullptr ? 0 : desc.fragment->output_count;
  if (desc.colorFormats.size() > kMaxColorTargets || desc.colorFormats.size() != outputs) {
    throw Error(ErrorId::kPipelineTargets,
                "pipeline '{}' has {} colour formats, but its fragment shader has {} outputs",
                desc.label, desc.colorFormats.size(), outputs);
  }
  for (uint32_t i = 0; i < outputs; ++i) {
    const Format format = desc.colorFormats[i];
    if (!known(format) || formatInfo(format).depth) {
      throw Error(ErrorId::kPipelineTargets,
                  "colour target {} of pipeline '{}' has no colour format", i, desc.label);
    }
    const grisaille_shader_location& output = desc.fragment->outputs[i];
    const uint32_t type =
        format == Format::kR32Uint ? GRISAILLE_SCALAR_UINT : GRISAILLE_SCALAR_FLOAT;
    const FormatInfo& info = formatInfo(format);
    if (output.location != i || output.type != type || output.components < info.channels) {
      throw Error(ErrorId::kPipelineTargets,
                  "output {} ({}, {} components) of pipeline '{}' does not fit target {} ({})",
                  output.location, output.name, output.components, desc.label, i, info.name);
    }
  }
  checkBlend(desc);
  const bool depth = desc.depthFormat != Format::kNone;
  if (depth && (!known(desc.depthFormat) || !formatInfo(desc.depthFormat).depth)) {
    throw Error(ErrorId::kPipelineTargets, "the depth format of pipeline '{}' has no depth",
                desc.label);
  }
  if (!depth && outputs == 0) {
    throw Error(ErrorId::kPipelineTargets, "pipeline '{}' has no target", desc.label);
  }
}

}  // namespace

void checkDescriptor(const BufferDesc& desc, const Capabilities& capabilities) {
  if (desc.size == 0 || desc.size > capabilities.maxBufferBytes) {
    throw Error(ErrorId::kBufferSize, "buffer '{}' has {} bytes; the limit is {}", desc.label,
                desc.size, capabilities.maxBufferBytes);
  }
  if (desc.usage == BufferUsage::kNone || static_cast<unsigned>(desc.usage) > 15u) {
    throw Error(ErrorId::kBufferUsage, "buffer '{}' has no usage or an unknown one: {:#x}",
                desc.label, static_cast<unsigned>(desc.usage));
  }
}

void checkDescriptor(const TextureDesc& desc, const Capabilities& capabilities) {
  if (!known(desc.format)) {
    throw Error(ErrorId::kTextureFormat, "texture '{}' has no format", desc.label);
  }
  const uint32_t largest = std::max(desc.width, desc.height);
  if (std::min(desc.width, desc.height) == 0 || largest > capabilities.maxTextureSize ||
      desc.layers == 0 || desc.layers > capabilities.maxTextureLayers) {
    throw Error(ErrorId::kTextureSize,
                "texture '{}' has {}x{} texels and {} layers; the limits are {} texels per side "
                "and {} layers",
                desc.label, desc.width, desc.height, desc.layers, capabilities.maxTextureSize,
                capabilities.maxTextureLayers);
  }
  const uint32_t levels = static_cast<uint32_t>(std::bit_width(largest));
  if (desc.mips == 0 || desc.mips > levels) {
    throw Error(ErrorId::kTextureMips, "texture '{}' of {}x{} texels has {} levels, at most {} fit",
                desc.label, desc.width, desc.height, desc.mips, levels);
  }
  if (desc.usage == TextureUsage::kNone || static_cast<unsigned>(desc.usage) > 7u) {
    throw Error(ErrorId::kTextureUsage, "texture '{}' has no usage or an unknown one: {:#x}",
                desc.label, static_cast<unsigned>(desc.usage));
  }
  if (has(desc.usage, TextureUsage::kStorage) && !formatInfo(desc.format).storage) {
    throw Error(ErrorId::kTextureFormat, "texture '{}' of format {} cannot be a storage image",
                desc.label, formatInfo(desc.format).name);
  }
}

void checkDescriptor(const ComputePipelineDesc& desc) {
  checkShader(desc.shader, GRISAILLE_STAGE_COMPUTE, desc.label);
  checkConstants(desc.constants, {&desc.shader, 1}, desc.label);
}

void checkDescriptor(const GraphicsPipelineDesc& desc) {
  checkShader(desc.vertex, GRISAILLE_STAGE_VERTEX, desc.label);
  if (desc.fragment != nullptr) checkShader(desc.fragment, GRISAILLE_STAGE_FRAGMENT, desc.label);
  const Shader* shaders[] = {desc.vertex, desc.fragment};
  checkConstants(desc.constants, {shaders, desc.fragment == nullptr ? 1u : 2u}, desc.label);
  checkAttributes(desc);
  checkVertexInputs(desc);
  checkOutputs(desc);
}

}  // namespace grisaille::gpu
