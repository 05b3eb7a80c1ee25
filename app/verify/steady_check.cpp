// SPDX-License-Identifier: MIT
#include "app/verify/steady_check.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/base/error.h"
#include "core/gpu/null_device.h"

namespace grisaille::app {
namespace {

constexpr uint32_t kWidth = 96, kHeight = 54;

// Frames of a new instance that are compared with those of another.
constexpr int kFrames = 3;
// Of a value, at least of 1: two steps of a half float. Compilers round otherwise where a loop
// counts its turns, as they cannot unroll it.
constexpr float kStepsOfHalf = 1.0f / 512;
// Clocks that count whole seconds differ after this time.
constexpr std::chrono::milliseconds kLater(1100);

// Frames until an effect has all that it keeps, and frames in which it must not grow.
constexpr int kWarm = 10, kSteady = 16;
constexpr size_t kMostGrowth = size_t{kSteady} * 128 * 1024;  // bytes: other code allocates too

// Bytes that the process has allocated on the heap; 0 where the C library does not tell.
size_t heapBytes() {
#ifdef __GLIBC__
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

}  // namespace

void SteadyCheck::render(frame::Renderer& renderer, int frames) {
  for (int i = 0; i < frames; ++i) {
    renderer.render({.camera = scene::atriumCamera(),
                     .width = kWidth,
                     .height = kHeight,
                     .surface = frame::Surface::kBaseColour,
                     .chain = &chain_,
                     .outputs = outputs_,
                     .services = services_.all()});
  }
}

SteadyCheck::Pictures SteadyCheck::read(frame::Renderer& renderer) const {
  Pictures pictures;
  for (const std::string& output : outputs_) {
    try {
      pictures.push_back(renderer.read(output));
    } catch (const Error& error) {
      if (error.id() != ErrorId::kUninitialised) throw;
      pictures.emplace_back();  // nothing writes it, which other checks report
    }
  }
  return pictures;
}

// The last of some frames of a new instance. `once`: the frame before must be equal to it.
SteadyCheck::Pictures SteadyCheck::drawAfresh(bool once, Variant variant) {
  VariantMaker maker(device_, variant);
  const effect::StartedChain started(chain_, maker);
  frame::Renderer renderer(device_, scene_);
  render(renderer, kFrames - 1);
  const Pictures before = read(renderer);
  render(renderer, 1);
  Pictures last = read(renderer);
  const bool same = !once || compare(before, last,
                                     "differs between equal frames, which needs "
                                     "GRISAILLE_EFFECT_HISTORY: it depends on earlier frames, the "
                                     "clock, or memory that nothing wrote");
  chain_.end();  // before the maker
  return same ? last : Pictures{};
}

// With shaders that do the same if they have no fault.
void SteadyCheck::checkVariants(const Pictures& plain) {
  report_.step(title_ + "running the threads of each workgroup in another order");
  const bool steady = compare(plain, drawAfresh(false, Variant::kReversed),
                              "depends on the order of threads: a race in shared memory or in a "
                              "buffer, or atomics whose results are not sorted");
  if (steady) {
    report_.step(title_ + "counting the turns of loops");
    compare(plain, drawAfresh(false, Variant::kCounted),
            "depends on a loop that does not end within 50,000 turns", "loop", kStepsOfHalf);
    report_.step(title_ + "leading indices out of range to other places");
    compare(
        drawAfresh(false, Variant::kFirst), drawAfresh(false, Variant::kLast),
        "depends on an access out of range: an index past a storage buffer, or a texel outside of "
        "an image or a fetched texture",
        "range");
  }
  report_.conclude(title_ + "stays inside its buffers and images, in any order of threads");
}

bool SteadyCheck::compare(const Pictures& one, const Pictures& other, const std::string& fault,
                          const char* cause, float allowed) {
  bool all = true;
  for (size_t i = 0; i < outputs_.size(); ++i) {
    size_t different = 0;
    for (size_t p = 0; p < one[i].pixels.size(); ++p) {
      const auto bits = [&](const image::Image& image) {
        return std::bit_cast<uint32_t>(image.pixels[p]);
      };
      const float a = one[i].pixels[p], b = other[i].pixels[p];
      const bool close = std::abs(a - b) <= allowed * std::max(1.0f, std::abs(a));
      if (bits(one[i]) != bits(other[i]) && !(allowed > 0 && close)) ++different;
    }
    report_.expect(different == 0,
                   fmt::format("{}{} of {} values of {}: the output {}", title_, different,
                               one[i].pixels.size(), outputs_[i], fault),
                   outputs_[i] + cause);
    all = all && different == 0;
  }
  return all;
}

// On a device without a driver: drivers and their validation keep memory of their own.
void SteadyCheck::checkGrowth() {
  const std::unique_ptr<gpu::NullDevice> null = gpu::makeNullDevice();
  const effect::StartedChain started(chain_, *null);
  size_t moreResources = 0, moreBytes = 0;
  {
    frame::Renderer renderer(*null, scene_);
    render(renderer, kWarm);
    const size_t resources = chain_.resources(), bytes = heapBytes();
    render(renderer, kSteady);
    moreResources = chain_.resources() - resources;
    const size_t now = heapBytes();
    moreBytes = now > bytes ? now - bytes : 0;
    chain_.end();
  }
  report_.expect(
      moreResources == 0,
      fmt::format("{}it keeps {} more textures, buffers, samplers and pipelines after {} "
                  "equal frames: destroy them, or make them once",
                  title_, moreResources, kSteady),
      "resources");
  if (moreResources != 0) return;
  report_.expect(
      moreBytes < kMostGrowth,
      fmt::format("{}the memory of the process grows by {} KiB in {} equal frames, {} KiB a frame: "
                  "free what record() allocates",
                  title_, moreBytes / 1024, kSteady, moreBytes / 1024 / kSteady),
      "memory");
}

void SteadyCheck::run() {
  const effect::Selection::Entry& entry = chain_.selection.entries()[0];
  const bool history = (entry.effect().desc->flags & GRISAILLE_EFFECT_HISTORY) != 0;
  try {
    report_.step(title_ + "drawing equal frames");
    const Pictures first = drawAfresh(!history);
    if (!first.empty()) {
      std::this_thread::sleep_for(kLater);
      const Pictures again = drawAfresh(false);
      compare(first, again,
              "differs when the same frames are drawn again: it depends on the clock, or on memory "
              "that nothing wrote");
    }
    report_.conclude(title_ + "draws equal frames equally");
    if (!first.empty() && device_.info().backend == "opengl") checkVariants(first);
    report_.step(title_ + "drawing many frames");
    checkGrowth();
  } catch (const Error& error) {
    if (error.id() == ErrorId::kDeviceLost) throw;
    report_.expect(false, title_ + error.detail(), error.detail());
  }
  report_.conclude(title_ + "keeps no more after many frames");
  chain_.start(device_);
}

}  // namespace grisaille::app
