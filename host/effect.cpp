// SPDX-License-Identifier: MIT
#include "host/effect.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

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

uint32_t indexOf(const effect::Effect& effect, std::string_view key) {
  const auto outputs = effect.outputs();
  for (uint32_t i = 0; i < outputs.size(); ++i) {
    if (key == outputs[i].key) return i;
  }
  std::string all;
  for (const grisaille_output_desc& output : outputs) {
    all += (all.empty() ? "" : ", ") + std::string(output.key);
  }
  throw Error(ErrorId::kOutputUnknown, "effect {} has no output '{}'; it has {}", effect.key(),
              oneLine(key), all);
}

effect::Chain chainOf(const grisaille_host_device& device, const grisaille_host_effect_desc& desc) {
  const std::string keys[] = {&present(desc.effect, "desc.effect")};
  return effect::Chain(effect::Selection(device.registry, keys));
}

// The number of layers of an effect.
uint32_t layersOf(const grisaille_host_effect_desc& desc) {
  constexpr uint32_t kMost = 16;
  if (desc.layers > kMost) {
    throw Error(ErrorId::kHostValue, "desc.layers is {}, over {}", desc.layers, kMost);
  }
  return std::max(desc.layers, 1u);
}

uint32_t keptSizesOf(const grisaille_host_effect_desc& desc) {
  constexpr uint32_t kMost = 256;
  if (desc.kept_sizes <= kMost) return desc.kept_sizes;
  throw Error(ErrorId::kHostValue, "desc.kept_sizes is {}, over {}", desc.kept_sizes, kMost);
}

}  // namespace

Wanted::Wanted(const grisaille_host_device& device, const grisaille_host_effect_desc& desc)
    : chain(chainOf(device, desc)), layers(layersOf(desc)) {
  effect::Values& values = chain.selection.entries()[0].values;
  checkEnum(desc.rows, 2, "desc.rows");
  copies = layers > 1 || desc.rows != GRISAILLE_HOST_ROWS_FROM_TOP;
  if (desc.output_count > 0) present(desc.outputs, "desc.outputs");
  for (uint32_t i = 0; i < desc.output_count; ++i) {
    outputs |=
        1u << indexOf(values.effect(), &present(desc.outputs[i], "an entry of desc.outputs"));
  }
  if (desc.output_count == 0) outputs = 1;
  if (desc.setting_count > 0) present(desc.settings, "desc.settings");
  for (uint32_t i = 0; i < desc.setting_count; ++i) {
    const grisaille_host_setting& one = desc.settings[i];
    values.set(&present(one.key, "the key of a setting"),
               std::string_view(&present(one.text, "the text of a setting")));
  }
}

gpu::MemoryUse memoryNeeded(const grisaille_host_device& device,
                            const grisaille_host_effect_desc& desc,
                            const grisaille_host_prepare& how) {
  device.gpu->requireUsable();
  checkPrepare(how);
  const Wanted wanted(device, desc);
  checkSize(device, desc.width, desc.height);
  gpu::MemoryUse use = neededOf(*device.gpu, wanted.chain.selection.entries()[0].values, {},
                                {.width = desc.width,
                                 .height = desc.height,
                                 .wanted = wanted.outputs,
                                 .inputs = how.inputs,
                                 .orthographic = how.orthographic != 0,
                                 .copies = wanted.copies,
                                 .layers = wanted.layers})
                           .memory;
  use.hostBytes *= device.framesInFlight;
  return use;
}

}  // namespace grisaille::host

grisaille_host_effect::grisaille_host_effect(grisaille_host_device& of,
                                             const grisaille_host_effect_desc& desc)
    : device(of),
      layers(host::layersOf(desc)),
      rows_(desc.rows),
      label_(fmt::format("grisaille: {}", &host::present(desc.effect, "desc.effect"))),
      pool_(of.pipelines, *of.gpu, host::keptSizesOf(desc)),
      commands_(pool_),
      attachments_(pool_, of.kernels) {
  of.gpu->requireUsable();
  for (uint32_t i = 0; i < layers; ++i) {
    host::Wanted wanted(of, desc);
    wanted_ = wanted.outputs;
    chains_.push_back(std::move(wanted.chain));
  }
  host::checkSize(of, desc.width, desc.height);
  for (grisaille::effect::Chain& chain : chains_) {
    chain.start(pool_);
    chain.create();
  }
  if (copies({.x = 0, .y = 0, .width = desc.width, .height = desc.height})) prepareCopies();
  resize(desc.width, desc.height);
  ++device.effects;
}

grisaille_host_effect::~grisaille_host_effect() {
  release(prepared_);
  drop(pictures_);
  --device.effects;
}

void grisaille_host_effect::end() {
  for (grisaille::effect::Chain& chain : chains_) chain.end();
}

bool grisaille_host_effect::copies(const grisaille_host_rectangle& place) const {
  return rows_ != GRISAILLE_HOST_ROWS_FROM_TOP || layers > 1 || place.width != width ||
         place.height != height;
}

// Compiles what copies the outputs.
void grisaille_host_effect::prepareCopies() {
  const auto outputs = values().effect().outputs();
  for (uint32_t i = 0; i < outputs.size(); ++i) {
    if ((wanted_ & (1u << i)) == 0) continue;
    device.kernels.turn(grisaille::effect::formatOf(outputs[i].format), host::Kernels::kOut);
  }
}

void grisaille_host_effect::drop(Pictures& pictures) {
  for (gpu::Texture& picture : pictures) pool_.destroy(std::exchange(picture, {}));
}

grisaille_host_effect::Pictures grisaille_host_effect::makePictures(uint32_t ofWidth,
                                                                    uint32_t ofHeight) {
  const auto outputs = values().effect().outputs();
  Pictures pictures(outputs.size());
  try {
    for (uint32_t i = 0; i < outputs.size(); ++i) {
      if ((wanted_ & (1u << i)) == 0) continue;
      pictures[i] = pool_.createTexture(host::outputDesc(outputs[i], ofWidth, ofHeight, layers));
      device.gpu->native(pictures[i]);  // creates the texture's view now
    }
  } catch (...) {
    drop(pictures);
    throw;
  }
  return pictures;
}

void grisaille_host_effect::resize(uint32_t newWidth, uint32_t newHeight) {
  host::checkSize(device, newWidth, newHeight);
  if (newWidth == width && newHeight == height) return;
  Pictures pictures = makePictures(newWidth, newHeight);
  std::vector<gpu::Texture> shown;
  for (const gpu::Texture picture : pictures) {
    if (picture) shown.push_back(picture);
  }
  attachments_.drop();
  drop(pictures_);
  pool_.clear();
  pictures_ = std::move(pictures);
  made_ = pictures_;
  shown_ = std::move(shown);
  width = newWidth;
  height = newHeight;
  before_.clear();
}

const grisaille::objects::Table& grisaille_host_effect::objectTable() {
  const grisaille::objects::ObjectList* list = chains_[0].objects(values().effect().key());
  if (list != nullptr) return list->table();
  throw Error(ErrorId::kEffectTakesNoObjects, "the table of {} declares no objects",
              values().effect().key());
}

void grisaille_host_effect::setObjects(const grisaille::objects::View& objects) {
  objectTable();
  for (grisaille::effect::Chain& chain : chains_) {
    chain.objects(values().effect().key())->assign(objects);
  }
}

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

// One recording.
struct grisaille_host_effect::Recording {
  const grisaille_host_frame& frame;
  const host::Textures& textures;
  uint32_t reads;  // GRISAILLE_READS()
  double patience;
  bool copies;
};

void grisaille_host_effect::record(const grisaille_host_frame& frame) {
  device.gpu->requireUsable();
  const uint32_t reads = values().effect().reads(values().all().data(), wanted_);
  const grisaille_host_rectangle place = host::rectangleOf(frame, {width, height});
  views_.clear();
  for (uint32_t i = 0; i < layers; ++i) views_.push_back(host::viewOf(frame, i, place, rows_));
  const double patience =
      frame.patience == 0 ? std::numeric_limits<double>::infinity() : frame.patience;
  if (!(patience > 0)) {
    throw Error(ErrorId::kHostValue, "frame.patience is {}, must be 0 or more", frame.patience);
  }
  const host::Textures textures = texturesOf(frame, reads);
  host::motionOf(frame, views_[0].seen, nullptr);  // checks the frame
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT + host::kMostInputs> read;
  size_t count = 0;
  for (const gpu::Texture texture : textures.attachments) {
    if (texture) read[count++] = texture;
  }
  for (const gpu::Texture texture : textures.named) {
    if (texture) read[count++] = texture;
  }
  device.pipelines.setRecording(values().effect().desc->key);
  const Recording recording = {.frame = frame,
                               .textures = textures,
                               .reads = reads,
                               .patience = patience,
                               .copies = copies(place)};
  bool begun = false;
  const auto end = [&] {
    device.pipelines.setRecording(nullptr);
    if (begun) device.gpu->end(shown_);
    pool_.end();
  };
  try {
    pool_.begin(place.width, place.height);
    attachments_.resize(place.width, place.height);
    attachments_.prepare(reads, textures);
    if (recording.copies) prepareCopies();
    commands_.wrap(device.gpu->begin(frame.command_buffer, frame.number,
                                     std::span(read).first(count), label_));
    begun = true;
    report_ = {};
    for (uint32_t i = 0; i < layers; ++i) {
      recordLayer(recording, i);
      pool_.takeBack();
    }
  } catch (...) {
    end();
    throw;
  }
  end();
  uploaded_ = std::max(uploaded_, commands_.uploaded());
  before_.clear();
  for (const host::View& view : views_) before_.push_back(view.seen);
}

void grisaille_host_effect::release(std::vector<gpu::ComputePipeline>& pipelines) {
  for (const gpu::ComputePipeline pipeline : pipelines) device.pipelines.destroy(pipeline);
  pipelines.clear();
}

void grisaille_host_effect::prepare(const grisaille_host_prepare& how) {
  device.gpu->requireUsable();
  host::checkPrepare(how);
  const uint32_t reads = values().effect().reads(values().all().data(), wanted_);
  const grisaille::objects::ObjectList* list = chains_[0].objects(values().effect().key());
  const std::vector<host::NeededPipeline> needed =
      host::neededOf(*device.gpu, values(),
                     list != nullptr ? list->view() : grisaille::objects::View{},
                     {.width = width,
                      .height = height,
                      .wanted = wanted_,
                      .inputs = how.inputs,
                      .orthographic = how.orthographic != 0,
                      .copies = false,
                      .layers = 1})
          .pipelines;
  // The library's own pipelines are the first step.
  const auto count = static_cast<uint32_t>(needed.size() + 1);
  const auto tell = [&](uint32_t done) {
    if (how.progress != nullptr) how.progress(how.context, done, count);
  };
  constexpr uint32_t kNeeded =
      GRISAILLE_READS(GRISAILLE_BASE_COLOUR) | GRISAILLE_READS(GRISAILLE_COLOUR);
  host::Attachments::prepare(device.kernels, reads, how.inputs | kNeeded,
                             values().effect().desc->input_count > 0);
  prepareCopies();
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

// The effect's instances begin again: uploads of the dropped recording are lost. Its textures, and
// the attachments, are created anew, and the pictures keep their identity.
void grisaille_host_effect::dropped() {
  device.gpu->requireUsable();
  end();
  for (grisaille::effect::Chain& chain : chains_) {
    chain.start(pool_);
    chain.create();
  }
  report_ = {};
  before_.clear();
  attachments_.drop();
  pool_.clear();
  for (const gpu::Texture picture : shown_) device.gpu->forget(picture);
}

void grisaille_host_effect::drawAt(std::span<const grisaille_point> points,
                                   std::span<grisaille_drawn> drawn) {
  for (size_t i = 0; i < points.size(); ++i) host::checkPoint(points[i], i);
  chains_[0].drawAt(
      chains_[0].selection.entries()[0],
      {.points = points, .drawn = drawn, .rays = device.rays ? &device.rays : nullptr});
}

void grisaille_host_effect::recordLayer(const Recording& recording, uint32_t layer) {
  const host::View& view = views_[layer];
  const host::MotionBlock motion =
      host::motionOf(recording.frame, view.seen, before_.empty() ? nullptr : &before_[layer]);
  attachments_.record(commands_, view.source, motion, recording.textures, layer);
  const auto outputs = values().effect().outputs();
  for (size_t i = 0; i < pictures_.size(); ++i) {
    made_[i] = pictures_[i];
    if (!pictures_[i] || !recording.copies) continue;
    made_[i] = pool_.transient(host::outputDesc(outputs[i], view.seen.size.x, view.seen.size.y, 1));
  }
  const grisaille::frame::ViewBlock block = grisaille::frame::viewBlock(view.seen);
  const grisaille_view seen = grisaille::frame::effectView(view.seen);
  grisaille::effect::FrameInputs inputs;
  inputs.commands = &commands_;
  inputs.width = view.seen.size.x;
  inputs.height = view.seen.size.y;
  inputs.view = &seen;
  inputs.viewBlock = commands_.uniform(std::as_bytes(std::span(&block, 1)));
  for (size_t i = 0; i < inputs.attachments.size(); ++i) {
    if ((recording.reads & GRISAILLE_READS(i)) == 0) continue;
    inputs.attachments[i] = attachments_.get(static_cast<grisaille_attachment>(i));
  }
  inputs.outputs = made_;
  inputs.named = attachments_.named();
  if (device.rays) inputs.services.rays = &device.rays;
  if (device.pictures) inputs.services.pictures = &device.pictures;
  inputs.patience = recording.patience;
  const grisaille::effect::Report report =
      chains_[layer].record(chains_[layer].selection.entries()[0], inputs);
  report_.waiting += report.waiting;
  report_.givenUp = std::max(report_.givenUp, report.givenUp);
  if (!recording.copies) return;
  const gpu::BufferRange source = commands_.uniform(std::as_bytes(std::span(&view.source, 1)));
  for (size_t i = 0; i < pictures_.size(); ++i) {
    if (!pictures_[i]) continue;
    attachments_.copyOut(commands_, source, made_[i], pictures_[i], layer,
                         grisaille::effect::formatOf(outputs[i].format));
  }
}

gpu::NativeTexture grisaille_host_effect::output(std::string_view key, uint32_t& format) const {
  const uint32_t index = host::indexOf(values().effect(), key);
  if ((wanted_ & (1u << index)) == 0) {
    throw Error(ErrorId::kOutputUnknown, "output '{}' was not named when effect {} was created",
                key, values().effect().desc->key);
  }
  format = values().effect().outputs()[index].format;
  return device.gpu->native(pictures_[index]);
}

gpu::MemoryUse grisaille_host_effect::memory() const {
  gpu::MemoryUse use = pool_.use();
  use.hostBytes = uploaded_ * device.framesInFlight;
  return use;
}
