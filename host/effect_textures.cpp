// SPDX-License-Identifier: MIT
// Checks the textures of a frame, and finds those that an effect reads.
#include <algorithm>
#include <array>

#include "host/checks.h"
#include "host/effect.h"

using grisaille::Error;
using grisaille::ErrorId;
namespace gpu = grisaille::gpu;
namespace host = grisaille::host;

namespace grisaille::host {
namespace {

// What a texture must have.
enum class Channels : uint8_t { kDepth, kAny, kTwo, kThree };

bool has(const gpu::ForeignInfo& info, Channels channels) {
  switch (channels) {
    case Channels::kDepth:
      return info.channels == 1;
    case Channels::kAny:
      return true;
    case Channels::kTwo:
      return info.channels >= 2;
    case Channels::kThree:
      return info.channels >= 3;
  }
  return false;
}

gpu::Texture checked(const grisaille_host_texture* texture, const grisaille_host_effect& effect,
                     Channels channels, const char* name) {
  if (texture == nullptr) return {};
  if (&texture->device != &effect.device) {
    throw Error(ErrorId::kHostForeign, "{} and the effect belong to different devices", name);
  }
  const gpu::ForeignInfo& info = texture->info;
  if (info.width != effect.width || info.height != effect.height) {
    throw Error(ErrorId::kHostTexture, "{} has {} x {} pixels, but the effect has {} x {}", name,
                info.width, info.height, effect.width, effect.height);
  }
  if (info.layers < effect.layers) {
    throw Error(ErrorId::kHostTexture, "{} has {} layers, but the effect has {}", name, info.layers,
                effect.layers);
  }
  if (!has(info, channels)) {
    constexpr const char* kTakes[] = {"1 channel, or a depth format", "any", "2 channels or more",
                                      "3 channels or more"};
    throw Error(ErrorId::kHostTexture, "{} has {} channels ({}), but takes {}", name, info.channels,
                info.format, kTakes[static_cast<size_t>(channels)]);
  }
  return texture->texture;
}

// Two for octahedral normals.
Channels ofNormals(uint32_t encoding) {
  return encoding >= GRISAILLE_HOST_OCTAHEDRAL_SIGNED ? Channels::kTwo : Channels::kThree;
}

}  // namespace
}  // namespace grisaille::host

host::Textures grisaille_host_effect::texturesOf(const grisaille_host_frame& frame,
                                                 uint32_t reads) const {
  struct Given {
    grisaille_attachment attachment;
    const grisaille_host_texture* texture;
    host::Channels channels;
    const char* name;
    const char* needed = nullptr;  // what an effect that reads it cannot do without
  };
  const Given all[] = {
      {GRISAILLE_DEPTH, &host::present(frame.depth, "frame.depth"), host::Channels::kDepth,
       "frame.depth"},
      {GRISAILLE_NORMAL, frame.normal, host::ofNormals(frame.normal_encoding), "frame.normal"},
      {GRISAILLE_BACK_DEPTH, frame.back_depth, host::Channels::kDepth, "frame.back_depth"},
      {GRISAILLE_NEXT_DEPTH, frame.next_depth, host::Channels::kDepth, "frame.next_depth"},
      {GRISAILLE_THICKNESS, frame.thickness, host::Channels::kDepth, "frame.thickness"},
      {GRISAILLE_BASE_COLOUR, frame.base_colour, host::Channels::kThree, "frame.base_colour",
       "base colours"},
      {GRISAILLE_COLOUR, frame.colour, host::Channels::kThree, "frame.colour", "the lit colour"},
      {GRISAILLE_MOTION, frame.motion, host::Channels::kTwo, "frame.motion"}};
  const grisaille_effect_desc& effect = *values().effect().desc;
  host::Textures textures;
  for (const Given& one : all) {
    const gpu::Texture texture = host::checked(one.texture, *this, one.channels, one.name);
    const bool read = (reads & GRISAILLE_READS(one.attachment)) != 0;
    if (read && !texture && one.needed != nullptr) {
      throw Error(ErrorId::kHostMissing, "{} reads {}, but {} is null", effect.key, one.needed,
                  one.name);
    }
    if (read && !texture && (effect.needs & GRISAILLE_READS(one.attachment)) != 0) {
      throw Error(ErrorId::kHostMissing, "{} needs {}, which is null", effect.key, one.name);
    }
    if (read || one.attachment == GRISAILLE_DEPTH) textures.attachments[one.attachment] = texture;
  }
  findNamed(frame, textures);
  return textures;
}

void grisaille_host_effect::findNamed(const grisaille_host_frame& frame,
                                      host::Textures& textures) const {
  if (frame.input_count > 0) host::present(frame.inputs, "frame.inputs");
  const std::span given(frame.inputs, frame.input_count);
  for (const grisaille_host_input& input : given) {
    host::present(input.key, "the key of an input");
    host::present(input.texture, "the texture of an input");
  }
  for (const grisaille_input_desc& input : values().effect().inputs()) {
    const std::string_view key = input.key;
    const auto found = std::ranges::find_if(
        given, [&](const grisaille_host_input& one) { return key == one.key; });
    gpu::Texture& texture = textures.named[textures.namedCount++];
    if (found != given.end()) {
      texture = host::checked(found->texture, *this, host::Channels::kAny, input.key);
    } else if ((input.flags & GRISAILLE_INPUT_REQUIRED) != 0) {
      throw Error(ErrorId::kHostMissing, "{} needs the input {}, which frame.inputs lacks",
                  values().effect().key(), key);
    }
  }
}
