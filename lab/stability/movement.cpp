// SPDX-License-Identifier: MIT
#include "lab/stability/movement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "core/trace/flicker.h"
#include "lab/oracle/occlusion.h"

namespace grisaille::lab::stability {
namespace {

constexpr int kFrames = 6;
constexpr glm::ivec2 kMiddle(48, 32);  // size of the measured middle, pixels
constexpr double kHeight = 720;        // height of the full picture, pixels
constexpr double kRadius = 0.5;        // metres
constexpr double kUsualBias = 0.01;    // metres
constexpr double kIntensity = 2;       // recommended for classic, see effects/ssao/README.md

// The width of a pixel at a view depth of 1.
double pixelWidth() {
  return 2 * std::tan(glm::radians(scene::Camera().fovyDegrees / 2)) / kHeight;
}

// Width of the rim drawn around the middle, in pixels: the radius as seen there, but not beyond a
// picture of height kHeight.
int rimOf(const MovementRow& row) {
  const double reach = std::ceil(kRadius / (row.distance * pixelWidth())) + 1;
  return static_cast<int>(std::min(reach, (kHeight - kMiddle.y) / 2));
}

glm::uvec2 sizeOf(const MovementRow& row) {
  return kMiddle + 2 * rimOf(row);
}

scene::Camera cameraOf(const MovementRow& row, Movement movement, int frame) {
  scene::Camera camera = planeCamera(row.degrees, row.distance);
  const double pixel = pixelWidth();
  camera.fovyDegrees = glm::degrees(2 * std::atan(pixel * sizeOf(row).y / 2));
  camera.nearPlane = std::min(0.01, row.distance / 10);
  const glm::dmat3 axes = scene::worldFromView(camera);
  const double width = row.distance * pixel;
  if (movement == Movement::kDolly) camera.eye *= 1 - 0.002 * frame;
  if (movement == Movement::kTurn) camera.target += 3.7 * frame * width * axes[0];
  if (movement == Movement::kJitter) {
    // Points of the R2 sequence (Roberts 2018).
    const glm::dvec2 at = glm::fract(glm::dvec2(0.7548776662466927, 0.5698402909980532) *
                                     static_cast<double>(frame)) -
                          0.5;
    camera.target += width * (at.x * axes[0] + at.y * axes[1]);
  }
  return camera;
}

Case caseOf(const MovementRow& row, Movement movement, int frame) {
  Case one;
  one.scenery = {.kind = Scenery::Kind::kPlane, .scale = std::max(1.0, row.distance)};
  one.camera = cameraOf(row, movement, frame);
  one.size = sizeOf(row);
  one.effect = "ssao";
  one.settings = {{"estimator", "classic"},
                  {"kernel_size", "64"},
                  {"blur_size", "4"},
                  {"radius", fmt::format("{}", kRadius)},
                  {"intensity", fmt::format("{}", kIntensity)},
                  {"bias", "0"}};
  return one;
}

std::vector<glm::uvec2> middleOf(const MovementRow& row) {
  std::vector<glm::uvec2> pixels;
  for (int y = 0; y < kMiddle.y; ++y) {
    for (int x = 0; x < kMiddle.x; ++x) pixels.emplace_back(glm::ivec2(x, y) + rimOf(row));
  }
  return pixels;
}

// A picture with one channel: `at` in the middle, NaN elsewhere.
image::Image pictureOf(const MovementRow& row, const std::function<float(const glm::uvec2&)>& at) {
  const glm::uvec2 size = sizeOf(row);
  image::Image image{.width = size.x, .height = size.y, .channels = 1, .pixels = {}};
  image.pixels.assign(size_t{size.x} * size.y, std::numeric_limits<float>::quiet_NaN());
  for (const glm::uvec2& pixel : middleOf(row))
    image.pixels[size_t{pixel.y} * size.x + pixel.x] = at(pixel);
  return image;
}

// The method with a constant bias only, on the input of a frame.
std::unique_ptr<oracle::Occlusion> aloneOf(const oracle::View& view, double bias) {
  return oracle::makeOcclusion(view, {.classic = true,
                                      .radius = kRadius,
                                      .kernelSize = 64,
                                      .blurSize = 4,
                                      .intensity = kIntensity,
                                      .depthBias = bias});
}

// The smallest bias that is safe in all views, to within 5 %, by bisection. The upper end exceeds
// all view depths: no surface can be nearer by that much.
double safeBiasOf(const MovementRow& row, const std::vector<oracle::View>& views) {
  const std::vector<glm::uvec2> pixels = middleOf(row);
  const auto safe = [&](double bias) {
    return std::ranges::all_of(views, [&](const oracle::View& view) {
      const auto alone = aloneOf(view, bias);
      return std::ranges::all_of(pixels, [&](const glm::uvec2& pixel) {
        return alone->visibility(glm::ivec2(pixel)) > kLeastOpen;
      });
    });
  };
  double low = 1e-7, high = 2 * (row.distance + kRadius);
  if (safe(low)) return 0;
  while (high > 1.05 * low) {
    const double middle = std::sqrt(low * high);
    (safe(middle) ? high : low) = middle;
  }
  return high;
}

// A frame with the truth of a plane, a visibility of 1 everywhere. Its `ao` is still empty.
trace::FlickerFrame frameOf(const MovementRow& row, const trace::RayTracer& tracer,
                            const scene::Camera& camera) {
  const glm::uvec2 size = sizeOf(row);
  const std::vector<glm::uvec2> pixels = middleOf(row);
  const std::vector<trace::Hit> cast = tracer.castPrimary(camera, size.x, size.y, pixels);
  trace::FlickerFrame frame{.camera = camera, .hits = {}, .ao = {}, .truth = {}};
  frame.hits.resize(size_t{size.x} * size.y);
  for (size_t i = 0; i < pixels.size(); ++i) {
    frame.hits[size_t{pixels[i].y} * size.x + pixels[i].x] = cast[i];
  }
  frame.truth = pictureOf(row, [](const glm::uvec2&) { return 1; });
  return frame;
}

}  // namespace

const char* nameOf(Movement movement) {
  switch (movement) {
    case Movement::kDolly:
      return "dolly";
    case Movement::kJitter:
      return "jitter";
    case Movement::kTurn:
      return "turn";
  }
  return "";
}

std::vector<std::string> faultsOf(const MovementRow& row) {
  std::vector<std::string> faults;
  for (const Steadiness& now : row.now) {
    if (!(now.leastOpen > kLeastOpen)) {
      faults.push_back(fmt::format("{}: a plane has a visibility of {:.3f} at a bias of 0",
                                   now.backend, now.leastOpen));
    }
    for (const Movement movement : kMovements) {
      const double flicker = now.flicker.at(static_cast<size_t>(movement));
      if (flicker <= kMostFlicker) continue;
      faults.push_back(fmt::format("{}: a plane flickers by {:.5f} in a {} at a bias of 0",
                                   now.backend, flicker, nameOf(movement)));
    }
  }
  return faults;
}

std::vector<MovementRow> movementRows(bool quick) {
  std::vector<MovementRow> rows;
  for (const double degrees : {5.0, 30.0, 60.0}) {
    for (const double distance : {0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0}) {
      if (quick && (degrees != 30 || (distance != 1 && distance != 1000))) continue;
      rows.push_back({.degrees = degrees, .distance = distance, .now = {}});
    }
  }
  return rows;
}

void measureMovement(Runner& runner, MovementRow& row) {
  row.now.clear();
  row.flickerAlone = 0;
  for (size_t backend = 0; backend < runner.backends(); ++backend) {
    row.now.push_back({.backend = runner.backend(backend), .flicker = {}});
  }
  const scene::Scene scene = makeScene(caseOf(row, Movement::kDolly, 0).scenery);
  const trace::RayTracer tracer(scene, glm::dvec3(0));
  std::vector<oracle::View> views;
  for (const Movement movement : kMovements) {
    std::vector<trace::FlickerFrame> frames;
    for (int frame = 0; frame < kFrames; ++frame) {
      frames.push_back(frameOf(row, tracer, cameraOf(row, movement, frame)));
    }
    std::vector<oracle::View> seen;
    for (size_t backend = 0; backend < runner.backends(); ++backend) {
      Steadiness& now = row.now[backend];
      seen.clear();
      for (size_t frame = 0; frame < frames.size(); ++frame) {
        Seen picture = runner.see(backend, caseOf(row, movement, static_cast<int>(frame)));
        frames[frame].ao = pictureOf(row, [&](const glm::uvec2& pixel) {
          const float open = picture.ao.at(pixel.x, pixel.y);
          now.leastOpen = std::min(now.leastOpen, std::isfinite(open) ? double{open} : 0.0);
          return open;
        });
        seen.push_back(std::move(picture.view));
      }
      now.flicker.at(static_cast<size_t>(movement)) = trace::flicker(frames).rms;
    }
    for (size_t frame = 0; frame < seen.size(); ++frame) {
      const auto alone = aloneOf(seen[frame], kUsualBias);
      frames[frame].ao = pictureOf(row, [&](const glm::uvec2& pixel) {
        return static_cast<float>(alone->visibility(glm::ivec2(pixel)));
      });
      views.push_back(std::move(seen[frame]));
    }
    row.flickerAlone = std::max(row.flickerAlone, trace::flicker(frames).rms);
  }
  row.safeBias = safeBiasOf(row, views);
}

}  // namespace grisaille::lab::stability
