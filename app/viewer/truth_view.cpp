// SPDX-License-Identifier: MIT
#include "app/viewer/truth_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/truth/error_map.h"
#include "app/truth/pixel_order.h"
#include "app/viewer/session.h"

namespace grisaille::app::viewer {
namespace {

// Seconds between two updates of the picture during tracing. Each update takes some ten
// milliseconds from the tracing and from other work.
constexpr double kTruthInterval = 0.25;

// RGB to the texels of a kRgba8Unorm texture.
std::vector<uint32_t> packed(const image::Image& colors) {
  std::vector<uint32_t> texels(size_t{colors.width} * colors.height);
  for (size_t i = 0; i < texels.size(); ++i) {
    uint32_t texel = 0xff000000u;
    for (size_t c = 0; c < 3; ++c) {
      const float value = std::clamp(colors.pixels[i * 3 + c], 0.0f, 1.0f);
      texel |= static_cast<uint32_t>(std::lround(value * 255)) << (8 * c);
    }
    texels[i] = texel;
  }
  return texels;
}

}  // namespace

TruthView::~TruthView() {
  for (const Sheet& sheet : sheets_) device_->destroy(sheet.texture);
}

void TruthView::moveTo(gpu::Device& device) {
  for (Sheet& sheet : sheets_) {
    device_->destroy(sheet.texture);
    sheet = {};
  }
  device_ = &device;
}

void TruthView::show(const truth::LiveView& view, image::Image picture) {
  picture_ = std::move(picture);
  if (!(view_ == view)) {
    view_ = view;
    restart();
    return;
  }
  compare();
}

void TruthView::follow(double radius, uint32_t rays) {
  if (picture_.pixels.empty() || (view_.radius == radius && view_.samples == rays)) return;
  view_.radius = radius;
  view_.samples = rays;
  restart();
}

void TruthView::restart() {
  traced_ = {};
  looked_ = {};
  compare();
  truth_.start(view_);
  ++started_;
  running_ = true;
}

void TruthView::stop() {
  if (picture_.pixels.empty()) return;
  truth_.cancel();
  running_ = false;
  view_ = {};
  picture_ = {};
  traced_ = {};
  compare();
}

bool TruthView::look() {
  if (!running_) return false;
  const bool first = traced_.pixels == 0;
  const bool ended = !truth_.running();
  const Clock::time_point now = Clock::now();
  const bool due = std::chrono::duration<double>(now - looked_).count() >= kTruthInterval;
  if (!first && !ended && !due) return false;
  try {
    if (!truth_.poll(traced_)) return false;
  } catch (...) {
    running_ = false;
    throw;
  }
  running_ = !traced_.done;
  looked_ = now;
  compare();
  return true;
}

void TruthView::compare() {
  ++revision_;
  comparison_ = {};
  if (traced_.pixels > 0) comparison_ = truth::compare(picture_, traced_.values);
}

double TruthView::share() const {
  if (traced_.values.empty()) return 0;
  return static_cast<double>(traced_.pixels) / static_cast<double>(traced_.values.size());
}

std::optional<size_t> TruthView::standIn(glm::uvec2 texel) const {
  const uint32_t index = truth::standIn(
      texel, traced_.size, [this](uint32_t i) { return truth::isTraced(traced_.values[i]); });
  return index == UINT32_MAX ? std::nullopt : std::optional<size_t>(index);
}

std::optional<truth::Point> TruthView::at(glm::uvec2 texel) const {
  if (texel.x >= traced_.size.x || texel.y >= traced_.size.y) return std::nullopt;
  const auto index = standIn(texel);
  if (!index) return std::nullopt;
  const trace::Visibility& value = traced_.values[*index];
  return truth::Point{picture_.pixels[*index], value.mean, value.standardError};
}

image::Image TruthView::numbers(std::string_view view) const {
  const glm::uvec2 size = traced_.size;
  image::Image image{.width = size.x, .height = size.y, .channels = 1, .pixels = {}};
  image.pixels.reserve(size_t{size.x} * size.y);
  for (uint32_t y = 0; y < size.y; ++y) {
    for (uint32_t x = 0; x < size.x; ++x) {
      const auto index = standIn({x, y});
      float value = std::numeric_limits<float>::quiet_NaN();
      if (index) {
        const float mean = traced_.values[*index].mean;
        value = view == kTruthView ? mean : picture_.pixels[*index] - mean;
      }
      image.pixels.push_back(value);
    }
  }
  return image;
}

std::optional<Side> TruthView::side(std::string_view view) {
  // The first pass traces one pixel of each 4 x 4 square: then every pixel has a stand-in.
  const glm::uvec2 squares = (traced_.size + 3u) / 4u;
  if (traced_.pixels < std::max(uint64_t{squares.x} * squares.y, uint64_t{1})) return std::nullopt;
  const bool error = view == kErrorView;
  Sheet& sheet = sheets_[error ? 1 : 0];
  const Side side = {sheet.texture, error ? Kind::kEncoded : Kind::kNumber};
  if (sheet.revision == revision_) return side;
  const image::Image values = numbers(view);
  const std::vector<uint32_t> colors =
      error ? packed(truth::errorMap(values)) : std::vector<uint32_t>();
  if (sheet.size != traced_.size) {
    device_->destroy(sheet.texture);
    sheet = {};
    sheet.texture =
        device_->createTexture({.label = error ? "error" : "truth",
                                .format = error ? gpu::Format::kRgba8Unorm : gpu::Format::kR32Float,
                                .width = traced_.size.x,
                                .height = traced_.size.y,
                                .usage = gpu::TextureUsage::kSampled});
    sheet.size = traced_.size;
  }
  gpu::Commands& commands = device_->begin();
  try {
    commands.upload(
        sheet.texture, 0, 0,
        error ? std::as_bytes(std::span(colors)) : std::as_bytes(std::span(values.pixels)));
  } catch (...) {
    device_->abandon();
    throw;
  }
  device_->submit();
  sheet.revision = revision_;
  return Side{sheet.texture, side.kind};
}

}  // namespace grisaille::app::viewer
