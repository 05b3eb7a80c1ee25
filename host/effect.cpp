// SPDX-License-Identifier: MIT
#include "host/effect.h"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <utility>

#include "core/frame/view_block.h"
#include "host/checks.h"

using grisaille::Error;
using grisaille::ErrorId;
namespace gpu = grisaille::gpu;
namespace host = grisaille::host;

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
  if (rows_ != GRISAILLE_HOST_ROWS_FROM_TOP || layers > 1) prepareCopies();
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
  std::exception_ptr failed;
  try {
    end();
  } catch (...) {
    failed = std::current_exception();
  }
  for (grisaille::effect::Chain& chain : chains_) {
    chain.start(pool_);
    chain.create();
  }
  report_ = {};
  before_.clear();
  attachments_.drop();
  pool_.clear();
  for (const gpu::Texture picture : shown_) device.gpu->forget(picture);
  if (failed) std::rethrow_exception(failed);
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
  if (device.depths) inputs.services.depths = &device.depths;
  if (device.pictures) inputs.services.pictures = &device.pictures;
  inputs.patience = recording.patience;
  const grisaille::effect::Report report =
      chains_[layer].record(chains_[layer].selection.entries()[0], inputs);
  report_.waiting += report.waiting;
  report_.givenUp = std::max(report_.givenUp, report.givenUp);
  report_.coarser = std::max(report_.coarser, report.coarser);
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
