// SPDX-License-Identifier: MIT
#include "app/viewer/stage.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/frame/texture_image.h"
#include "core/scene/view.h"
#include "shaders/depths.h"
#include "shaders/keep_output.h"

namespace grisaille::app::viewer {
namespace {

constexpr uint32_t kGroup = 8;
constexpr uint32_t kMostAveraged = 1024;  // frames
constexpr uint32_t kFailed = std::numeric_limits<uint32_t>::max();

// Same layout as in shaders/viewer/depths.comp.
struct DepthsBlock {
  glm::ivec4 texels[Stage::kMostDepths];
};
GRISAILLE_CHECK_BLOCK_depths_Places(DepthsBlock);

Kind kindOf(const grisaille_output_desc& output) {
  if (output.role == GRISAILLE_ROLE_OVERLAY) return Kind::kOverlay;
  if (output.role == GRISAILLE_ROLE_COLOUR) return Kind::kLight;
  const gpu::Format format = effect::formatOf(output.format);
  if (gpu::formatInfo(format).channels == 1) return Kind::kNumber;
  const bool isSigned = frame::transferOf(output.key) == image::Transfer::kSigned;
  return isSigned ? Kind::kSigned : Kind::kEncoded;
}

Kind kindOf(const effect::Selection& effects, const std::string& output) {
  for (const Viewable& viewable : viewables(effects)) {
    if (viewable.output == output) return viewable.kind;
  }
  return Kind::kEncoded;
}

// A composed picture without a background shows a checkerboard there.
Kind kindOf(const StageDesc& desc, const effect::Selection& effects, const std::string& output) {
  const bool clear = output == "color" && desc.background.a < 1;
  return clear ? Kind::kOverlay : kindOf(effects, output);
}

// Gives a chain another selection while this lives. The chain keeps its objects and instances.
class Exchanged {
 public:
  Exchanged(effect::Chain& chain, effect::Selection other)
      : chain_(chain), own_(std::exchange(chain.selection, std::move(other))) {}
  ~Exchanged() { chain_.selection = std::move(own_); }
  Exchanged(const Exchanged&) = delete;
  Exchanged& operator=(const Exchanged&) = delete;

 private:
  effect::Chain& chain_;
  effect::Selection own_;
};

// The parameter by which an effect that is on averages frames; null: it has none, or does not use
// it now.
const grisaille_param_desc* historyOf(const effect::Selection::Entry& entry) {
  if (!entry.on) return nullptr;
  for (const grisaille_param_desc& param : entry.effect().params()) {
    const bool is = param.key == kHistory && param.type == GRISAILLE_PARAM_INT;
    if (is && entry.values.isUsed(param)) return &param;
  }
  return nullptr;
}

// The selection with the longest average that each effect offers.
effect::Selection converging(effect::Selection effects) {
  for (effect::Selection::Entry& entry : effects.entries()) {
    if (const auto* history = historyOf(entry)) entry.values.set(kHistory, history->hard_max);
  }
  return effects;
}

}  // namespace

uint32_t framesAveraged(const effect::Selection& effects, bool converges) {
  double most = 1;
  for (const effect::Selection::Entry& entry : effects.entries()) {
    const auto* history = historyOf(entry);
    if (history == nullptr) continue;
    most = std::max(most, converges ? history->hard_max : entry.values.get(kHistory));
  }
  return static_cast<uint32_t>(std::min(most, double{kMostAveraged}));
}

std::vector<Viewable> viewables(const effect::Selection& effects) {
  std::vector<Viewable> all = {{"color", "Final", Kind::kLight}};
  for (const effect::Selection::Entry& entry : effects.entries()) {
    if (!entry.on) continue;
    for (const grisaille_output_desc& output : entry.effect().outputs()) {
      if (effect::formatOf(output.format) == gpu::Format::kR32Uint) continue;
      const std::string name = std::string(entry.key()) + "." + output.key;
      all.push_back({name, name, kindOf(output)});
    }
  }
  all.push_back({"normal", "Normals", Kind::kSigned});
  all.push_back({"facet_normal", "Facet normals", Kind::kSigned});
  all.push_back({"depth", "Depth", Kind::kDepth});
  all.push_back({"back_depth", "Back depth", Kind::kDepth});
  all.push_back({"next_depth", "Next depth", Kind::kDepth});
  all.push_back({"thickness", "Thickness", Kind::kDepth});
  all.push_back({"base_colour", "Base colour", Kind::kLight});
  return all;
}

bool Stage::Wanted::operator==(const Wanted& o) const {
  return camera == o.camera && size == o.size && halves == o.halves && surface == o.surface &&
         background == o.background && revision == o.revision && left == o.left &&
         right == o.right && extra == o.extra && objects == o.objects && poses == o.poses;
}

Stage::Stage(gpu::Device& device, const scene::Scene& scene, SceneServices& services,
             effect::Chain& chain)
    : device_(device),
      services_(services),
      renderer_(device, scene, &services.matter()),
      started_(chain, device) {}

Stage::~Stage() {
  device_.destroy(held_);
  device_.destroy(keep_);
  device_.destroy(depths_);
  device_.destroy(depthsRead_);
  device_.destroy(nearest_);
}

Stage::Wanted Stage::wanted(const StageDesc& desc, bool held) {
  Wanted all = {.camera = desc.camera,
                .size = desc.size,
                .halves = desc.halves,
                .surface = desc.surface,
                .background = desc.background,
                .revision = held ? desc.heldRevision : desc.liveRevision,
                .left = held ? "" : desc.left,
                .right = held || desc.held == nullptr ? desc.right : "",
                .extra = held ? std::vector<std::string>() : desc.extra,
                .objects = desc.chain->objectsRevision(),
                .poses = desc.poses};
  return all;
}

uint32_t Stage::framesWanted(const StageDesc& desc) {
  return desc.averages ? framesAveraged(desc.chain->selection, desc.converges) : 1;
}

bool Stage::isStale(const StageDesc& desc) const {
  if (desc.size.x == 0 || desc.size.y == 0) return false;
  if (!done_ || waiting_ + heldWaiting_ > 0 || !(*done_ == wanted(desc, false))) return true;
  if (frames_ < framesWanted(desc)) return true;
  return desc.held != nullptr && !(heldDone_ && *heldDone_ == wanted(desc, true));
}

void Stage::render(const StageDesc& desc, glm::uvec2 size, std::span<const std::string> outputs) {
  renderer_.render({.camera = desc.camera,
                    .width = size.x,
                    .height = size.y,
                    .surface = desc.surface,
                    .background = desc.background,
                    .chain = desc.chain,
                    .outputs = outputs,
                    .patience = desc.patience,
                    .services = services_.all()});
}

void Stage::renderLive(const StageDesc& desc, std::span<const std::string> outputs) {
  std::optional<Exchanged> exchanged;
  if (desc.averages && desc.converges) {
    exchanged.emplace(*desc.chain, converging(desc.chain->selection));
  }
  render(desc, texelsOf(desc.size, scaleOf(desc)), outputs);
}

void Stage::makePipelines() {
  if (keep_) return;
  nearest_ = device_.createSampler({.label = "nearest"});
  depths_ = device_.createComputePipeline(
      {.label = "depths", .shader = &grisaille_shader_depths, .constants = {}});
  depthsRead_ = device_.createBuffer({.label = "depths",
                                      .size = kMostDepths * sizeof(float),
                                      .usage = gpu::BufferUsage::kStorage});
  keep_ = device_.createComputePipeline(
      {.label = "keep", .shader = &grisaille_shader_keep_output, .constants = {}});
}

// Renders with the held settings and copies the output: the next frame reuses its render targets.
void Stage::updateHeld(const StageDesc& desc) {
  heldDone_ = wanted(desc, true);
  heldWaiting_ = 0;
  const std::vector<std::string> outputs = {desc.right};
  const glm::uvec2 texels = texelsOf(desc.size, scaleOf(desc));
  {
    const Exchanged exchanged(*desc.chain, *desc.held);
    render(desc, texels, outputs);
  }
  heldWaiting_ = renderer_.report().waiting;
  if (heldSize_ != texels) {
    device_.destroy(held_);
    held_ = {};
    held_ =
        device_.createTexture({.label = "held",
                               .format = gpu::Format::kRgba32Float,
                               .width = texels.x,
                               .height = texels.y,
                               .usage = gpu::TextureUsage::kSampled | gpu::TextureUsage::kStorage});
    heldSize_ = texels;
  }
  makePipelines();
  gpu::Commands& commands = device_.begin();
  try {
    const std::array bindings = {
        gpu::textureBinding(0, {.texture = renderer_.texture(desc.right)}, nearest_),
        gpu::imageBinding(0, held_)};
    commands.beginPass("viewer/keep");
    commands.dispatch(
        {.pipeline = keep_,
         .bindings = bindings,
         .groups = {(texels.x + kGroup - 1) / kGroup, (texels.y + kGroup - 1) / kGroup, 1}});
    commands.endPass();
  } catch (...) {
    device_.abandon();
    throw;
  }
  device_.submit();
  right_ = {held_, desc.right, kindOf(desc, *desc.held, desc.right), {}};
}

void Stage::update(const StageDesc& desc) {
  if (!isStale(desc)) return;
  const bool held = desc.held != nullptr && !desc.right.empty();
  const Wanted now = wanted(desc, false);
  const uint32_t frames = done_ && *done_ == now ? frames_ + 1 : 1;
  frames_ = kFailed;
  done_ = now;
  // The held frame overwrites the live side's render targets.
  if (held && (heldWaiting_ > 0 || !heldDone_ || !(*heldDone_ == wanted(desc, true)))) {
    updateHeld(desc);
  }
  if (!held) heldWaiting_ = 0;
  waiting_ = 0;
  ++revision_;
  std::vector<std::string> outputs = {desc.left};
  if (!held && !desc.right.empty() && desc.right != desc.left) outputs.push_back(desc.right);
  outputs.insert(outputs.end(), desc.extra.begin(), desc.extra.end());
  left_ = {};
  if (!held) right_ = {};
  renderLive(desc, outputs);
  frames_ = frames;
  waiting_ = renderer_.report().waiting;
  givenUp_ = renderer_.report().givenUp;
  coarser_ = renderer_.report().coarser;
  size_ = desc.size;
  scale_ = scaleOf(desc);
  left_ = {
      renderer_.texture(desc.left), desc.left, kindOf(desc, desc.chain->selection, desc.left), {}};
  if (!held && !desc.right.empty()) {
    right_ = {renderer_.texture(desc.right),
              desc.right,
              kindOf(desc, desc.chain->selection, desc.right),
              {}};
  }
}

gpu::Texture Stage::texture(bool right) const {
  return right && right_.texture ? right_.texture : left_.texture;
}

std::vector<float> Stage::valueAt(bool right, glm::uvec2 pixel) {
  Side& side = right && right_.texture ? right_ : left_;
  if (!side.texture || pixel.x >= size_.x || pixel.y >= size_.y) return {};
  const glm::uvec2 texel = pixel / scale_;
  if (!side.values) {
    side.values = side.texture == held_
                      ? frame::toImage(device_.read(held_), gpu::Format::kRgba32Float, heldSize_.x,
                                       heldSize_.y)
                      : renderer_.read(side.output);
  }
  const image::Image& image = *side.values;
  const float* first = &image.pixels[(size_t{texel.y} * image.width + texel.x) * image.channels];
  return {first, first + image.channels};
}

std::vector<double> Stage::depthsAt(std::span<const glm::ivec2> pixels) {
  const frame::Renderer::Depth depth = renderer_.depth();
  if (!done_ || !depth.texture || !left_.texture) return {};
  makePipelines();
  DepthsBlock block{};
  std::vector<bool> inside(pixels.size());
  for (size_t i = 0; i < pixels.size(); ++i) {
    inside[i] = glm::all(glm::greaterThanEqual(pixels[i], glm::ivec2(0))) &&
                glm::all(glm::lessThan(pixels[i], glm::ivec2(size_)));
    const glm::ivec2 texel = pixels[i] / static_cast<int>(scale_);
    if (inside[i]) block.texels[i] = {texel + glm::ivec2(depth.guard), 0, 0};
  }
  gpu::Commands& commands = device_.begin();
  try {
    const std::array bindings = {
        gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(&block, 1)))),
        gpu::textureBinding(0, {.texture = depth.texture}, nearest_),
        gpu::storageBinding(0, {depthsRead_})};
    commands.beginPass("viewer/depths");
    commands.dispatch({.pipeline = depths_, .bindings = bindings, .groups = {1, 1, 1}});
    commands.endPass();
  } catch (...) {
    device_.abandon();
    throw;
  }
  device_.submit();
  const std::vector<std::byte> bytes = device_.read(gpu::BufferRange{depthsRead_});
  const scene::View view = scene::viewOf(done_->camera, done_->size);
  std::vector<double> depths(pixels.size(), std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < pixels.size(); ++i) {
    float value = 0;
    std::memcpy(&value, &bytes[i * sizeof(float)], sizeof(value));
    if (inside[i] && value > 0) depths[i] = scene::viewDepthOf(view, double{value});
  }
  return depths;
}

image::Image Stage::picture(const StageDesc& desc, const std::string& output) {
  // What effects average is that of the frames before, also at another size.
  if (!isStale(desc) && size_ == desc.size && left_.output == output) return renderer_.read(output);
  StageDesc whole = desc;
  whole.halves = false;
  whole.patience = std::numeric_limits<double>::infinity();
  const std::vector<std::string> outputs = {output};
  done_.reset();
  ++revision_;
  left_ = {};
  if (right_.texture != held_) right_ = {};
  renderLive(whole, outputs);
  return renderer_.read(output);
}

}  // namespace grisaille::app::viewer
