// SPDX-License-Identifier: MIT
#include "host/effect.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/frame/view_block.h"
#include "host/checks.h"

using grisaille::Error;
using grisaille::ErrorId;
namespace gpu = grisaille::gpu;
namespace host = grisaille::host;

namespace grisaille::host {
namespace {

constexpr uint32_t kLargestSide = 16384;  // pixels

void checkSize(const grisaille_host_device& device, uint32_t width, uint32_t height) {
  const uint32_t most = std::min(kLargestSide, device.gpu->info().capabilities.maxTextureSize);
  if (width >= 1 && width <= most && height >= 1 && height <= most) return;
  throw Error(ErrorId::kTextureSize, "{} x {} pixels are out of 1 to {}", width, height, most);
}

gpu::Texture checked(const grisaille_host_texture* texture, const grisaille_host_effect& effect,
                     uint32_t channels, const char* name) {
  if (texture == nullptr) return {};
  if (&texture->device != &effect.device) {
    throw Error(ErrorId::kHostForeign, "{} and the effect belong to different devices", name);
  }
  const gpu::ForeignInfo& info = texture->info;
  if (info.width != effect.width || info.height != effect.height) {
    throw Error(ErrorId::kHostTexture, "{} has {} x {} pixels, but the effect has {} x {}", name,
                info.width, info.height, effect.width, effect.height);
  }
  if (info.channels < channels && !(info.depth && channels == 1)) {
    throw Error(ErrorId::kHostTexture, "{} has {} channels, but needs {}", name, info.channels,
                channels);
  }
  return texture->texture;
}

effect::Chain chainOf(const grisaille_host_device& device, const grisaille_host_effect_desc& desc) {
  const std::string keys[] = {&present(desc.effect, "desc.effect")};
  return effect::Chain(effect::Selection(device.registry, keys));
}

}  // namespace
}  // namespace grisaille::host

grisaille_host_effect::grisaille_host_effect(grisaille_host_device& of,
                                             const grisaille_host_effect_desc& desc)
    : device(of),
      rows_(desc.rows),
      chain_(host::chainOf(of, desc)),
      attachments_(*of.gpu, of.kernels) {
  of.gpu->requireUsable();
  chain_.start(of.pipelines);
  chain_.create();
  host::checkEnum(desc.rows, 2, "desc.rows");
  host::checkReserved(desc.reserved, "desc.reserved");
  if (desc.output_count > 0) host::present(desc.outputs, "desc.outputs");
  for (uint32_t i = 0; i < desc.output_count; ++i) {
    wanted_ |= 1u << indexOf(&host::present(desc.outputs[i], "an entry of desc.outputs"));
  }
  if (desc.output_count == 0) wanted_ = 1;
  resize(desc.width, desc.height);
  ++device.effects;
}

grisaille_host_effect::~grisaille_host_effect() {
  release(prepared_);
  drop(pictures_);
  --device.effects;
}

uint32_t grisaille_host_effect::indexOf(std::string_view key) const {
  const auto outputs = values().effect().outputs();
  for (uint32_t i = 0; i < outputs.size(); ++i) {
    if (key == outputs[i].key) return i;
  }
  std::string all;
  for (const grisaille_output_desc& output : outputs) {
    all += (all.empty() ? "" : ", ") + std::string(output.key);
  }
  throw Error(ErrorId::kOutputUnknown, "effect {} has no output '{}'; it has {}",
              values().effect().desc->key, grisaille::oneLine(key), all);
}

void grisaille_host_effect::drop(std::vector<Picture>& pictures) {
  for (Picture& picture : pictures) {
    if (picture.shown != picture.made) device.gpu->destroy(picture.shown);
    device.gpu->destroy(picture.made);
    picture = {};
  }
}

void grisaille_host_effect::makePictures(std::vector<Picture>& pictures, uint32_t ofWidth,
                                         uint32_t ofHeight) {
  const auto outputs = values().effect().outputs();
  for (uint32_t i = 0; i < outputs.size(); ++i) {
    if ((wanted_ & (1u << i)) == 0) continue;
    const gpu::TextureDesc desc = {
        .label = outputs[i].key,
        .format = grisaille::effect::formatOf(outputs[i].format),
        .width = ofWidth,
        .height = ofHeight,
        .usage = gpu::TextureUsage::kStorage | gpu::TextureUsage::kSampled};
    Picture& picture = pictures[i];
    picture.made = device.gpu->createTexture(desc);
    if (rows_ == GRISAILLE_HOST_ROWS_FROM_TOP) {
      picture.shown = picture.made;
    } else {
      device.kernels.turn(desc.format);
      picture.shown = device.gpu->createTexture(desc);
    }
    device.gpu->native(picture.shown);  // creates the texture's view now
  }
}

void grisaille_host_effect::resize(uint32_t newWidth, uint32_t newHeight) {
  host::checkSize(device, newWidth, newHeight);
  if (newWidth == width && newHeight == height) return;
  std::vector<Picture> pictures(values().effect().outputs().size());
  std::vector<gpu::Texture> made, shown;
  try {
    makePictures(pictures, newWidth, newHeight);
    for (const Picture& picture : pictures) {
      made.push_back(picture.made);
      if (picture.shown) shown.push_back(picture.shown);
    }
  } catch (...) {
    drop(pictures);
    throw;
  }
  drop(pictures_);
  pictures_ = std::move(pictures);
  made_ = std::move(made);
  shown_ = std::move(shown);
  width = newWidth;
  height = newHeight;
  before_.reset();
  attachments_.resize(width, height);
}

grisaille::objects::ObjectList& grisaille_host_effect::objects() {
  grisaille::objects::ObjectList* list = chain_.objects(values().effect().key());
  if (list != nullptr) return *list;
  throw Error(ErrorId::kEffectTakesNoObjects, "the table of {} declares no objects",
              values().effect().key());
}

host::Textures grisaille_host_effect::texturesOf(const grisaille_host_frame& frame,
                                                 uint32_t reads) const {
  struct Given {
    grisaille_attachment attachment;
    const grisaille_host_texture* texture;
    uint32_t channels;
    const char* name;
    const char* needed = nullptr;  // what an effect that reads it cannot do without
  };
  const Given all[] = {
      {GRISAILLE_DEPTH, &host::present(frame.depth, "frame.depth"), 1, "frame.depth"},
      {GRISAILLE_NORMAL, frame.normal, 3, "frame.normal"},
      {GRISAILLE_BACK_DEPTH, frame.back_depth, 1, "frame.back_depth"},
      {GRISAILLE_NEXT_DEPTH, frame.next_depth, 1, "frame.next_depth"},
      {GRISAILLE_THICKNESS, frame.thickness, 1, "frame.thickness"},
      {GRISAILLE_BASE_COLOUR, frame.base_colour, 3, "frame.base_colour", "base colours"},
      {GRISAILLE_COLOUR, frame.colour, 3, "frame.colour", "the lit colour"},
      {GRISAILLE_MOTION, frame.motion, 2, "frame.motion"}};
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
      texture = host::checked(found->texture, *this, 1, input.key);
    } else if ((input.flags & GRISAILLE_INPUT_REQUIRED) != 0) {
      throw Error(ErrorId::kHostMissing, "{} needs the input {}, which frame.inputs lacks",
                  values().effect().key(), key);
    }
  }
}

void grisaille_host_effect::record(const grisaille_host_frame& frame) {
  device.gpu->requireUsable();
  const uint32_t reads = values().effect().reads(values().all().data(), wanted_);
  const host::View view = host::viewOf(frame, {width, height}, rows_);
  const double patience =
      frame.patience == 0 ? std::numeric_limits<double>::infinity() : frame.patience;
  if (!(patience > 0)) {
    throw Error(ErrorId::kHostValue, "frame.patience is {}, must be 0 or more", frame.patience);
  }
  const host::Textures textures = texturesOf(frame, reads);
  const host::MotionBlock motion = host::motionOf(frame, view.seen, before_ ? &*before_ : nullptr);
  attachments_.prepare(reads, textures);
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT + host::kMostInputs> read;
  size_t count = 0;
  for (const gpu::Texture texture : textures.attachments) {
    if (texture) read[count++] = texture;
  }
  for (const gpu::Texture texture : textures.named) {
    if (texture) read[count++] = texture;
  }
  gpu::Commands& commands =
      device.gpu->begin(frame.command_buffer, frame.number, std::span(read).first(count));
  try {
    recordInto(commands, view, motion, textures, reads, patience);
  } catch (...) {
    device.gpu->end(shown_);
    throw;
  }
  device.gpu->end(shown_);
  before_ = view.seen;
}

void grisaille_host_effect::release(std::vector<gpu::ComputePipeline>& pipelines) {
  for (const gpu::ComputePipeline pipeline : pipelines) device.pipelines.destroy(pipeline);
  pipelines.clear();
}

void grisaille_host_effect::prepare(const grisaille_host_prepare& how) {
  device.gpu->requireUsable();
  host::checkEnum(how.orthographic, 2, "how.orthographic");
  host::checkReserved(how.reserved, "how.reserved");
  // The library computes the others from depth.
  constexpr uint32_t kOptional = GRISAILLE_READS(GRISAILLE_NEXT_DEPTH) |
                                 GRISAILLE_READS(GRISAILLE_THICKNESS) |
                                 GRISAILLE_READS(GRISAILLE_MOTION);
  const uint32_t reads = values().effect().reads(values().all().data(), wanted_);
  const grisaille::objects::ObjectList* list = chain_.objects(values().effect().key());
  const std::vector<host::NeededPipeline> needed =
      host::pipelinesOf(values(), list != nullptr ? list->view() : grisaille::objects::View{},
                        {.width = width,
                         .height = height,
                         .wanted = wanted_,
                         .attachments = (~kOptional | values().effect().desc->needs | how.inputs),
                         .orthographic = how.orthographic != 0});
  // The library's own pipelines are the first step.
  const auto count = static_cast<uint32_t>(needed.size() + 1);
  const auto tell = [&](uint32_t done) {
    if (how.progress != nullptr) how.progress(how.context, done, count);
  };
  constexpr uint32_t kNeeded =
      GRISAILLE_READS(GRISAILLE_BASE_COLOUR) | GRISAILLE_READS(GRISAILLE_COLOUR);
  host::Attachments::prepare(device.kernels, reads, how.inputs | kNeeded,
                             values().effect().desc->input_count > 0);
  tell(1);
  std::vector<gpu::ComputePipeline> pipelines;
  pipelines.reserve(needed.size());
  try {
    for (const host::NeededPipeline& one : needed) {
      pipelines.push_back(device.pipelines.createComputePipeline(
          {.label = one.label, .shader = one.shader, .constants = one.constants}));
      tell(static_cast<uint32_t>(pipelines.size() + 1));
    }
  } catch (...) {
    release(pipelines);
    throw;
  }
  release(prepared_);
  prepared_ = std::move(pipelines);
}

// The effect's instance begins again: uploads of the dropped recording are lost. Its textures, and
// the attachments, are created anew, and the pictures keep their identity.
void grisaille_host_effect::dropped() {
  device.gpu->requireUsable();
  chain_.end();
  chain_.start(device.pipelines);
  chain_.create();
  report_ = {};
  before_.reset();
  attachments_.resize(width, height);
  for (const Picture& picture : pictures_) {
    if (picture.made) device.gpu->forget(picture.made);
    if (picture.shown && picture.shown != picture.made) device.gpu->forget(picture.shown);
  }
  device.gpu->forgetTransients();
}

void grisaille_host_effect::drawAt(std::span<const grisaille_point> points,
                                   std::span<grisaille_drawn> drawn) {
  for (size_t i = 0; i < points.size(); ++i) host::checkPoint(points[i], i);
  chain_.drawAt(chain_.selection.entries()[0],
                {.points = points, .drawn = drawn, .rays = device.rays ? &device.rays : nullptr});
}

void grisaille_host_effect::recordInto(gpu::Commands& commands, const host::View& view,
                                       const host::MotionBlock& motion,
                                       const host::Textures& textures, uint32_t reads,
                                       double patience) {
  attachments_.record(commands, view.source, motion, textures);
  const grisaille::frame::ViewBlock block = grisaille::frame::viewBlock(view.seen);
  const grisaille_view seen = grisaille::frame::effectView(view.seen);
  grisaille::effect::FrameInputs inputs;
  inputs.commands = &commands;
  inputs.width = width;
  inputs.height = height;
  inputs.view = &seen;
  inputs.viewBlock = commands.uniform(std::as_bytes(std::span(&block, 1)));
  for (size_t i = 0; i < inputs.attachments.size(); ++i) {
    if ((reads & GRISAILLE_READS(i)) == 0) continue;
    inputs.attachments[i] = attachments_.get(static_cast<grisaille_attachment>(i));
  }
  inputs.outputs = made_;
  inputs.named = attachments_.named();
  if (device.rays) inputs.services.rays = &device.rays;
  if (device.depths) inputs.services.depths = &device.depths;
  if (device.pictures) inputs.services.pictures = &device.pictures;
  inputs.patience = patience;
  report_ = chain_.record(chain_.selection.entries()[0], inputs);
  if (rows_ == GRISAILLE_HOST_ROWS_FROM_TOP) return;
  const gpu::BufferRange source = commands.uniform(std::as_bytes(std::span(&view.source, 1)));
  const auto outputs = values().effect().outputs();
  for (size_t i = 0; i < pictures_.size(); ++i) {
    if (!pictures_[i].made) continue;
    attachments_.copy(commands, source, pictures_[i].made, pictures_[i].shown,
                      grisaille::effect::formatOf(outputs[i].format), "host/turn");
  }
}

gpu::NativeTexture grisaille_host_effect::output(std::string_view key, uint32_t& format) const {
  const uint32_t index = indexOf(key);
  if ((wanted_ & (1u << index)) == 0) {
    throw Error(ErrorId::kOutputUnknown, "output '{}' was not named when effect {} was created",
                key, values().effect().desc->key);
  }
  format = values().effect().outputs()[index].format;
  return device.gpu->native(pictures_[index].shown);
}
