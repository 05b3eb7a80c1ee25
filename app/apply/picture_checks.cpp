// SPDX-License-Identifier: MIT
#include "app/apply/picture_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/error.h"
#include "core/scene/camera_matrices.h"
#include "core/scene/view.h"

namespace grisaille::app {
namespace {

bool inMetres(const DepthSource& depth) {
  return depth.kind == "view" || depth.kind == "distance";
}

double share(ptrdiff_t count, size_t all) {
  return all == 0 ? 0 : static_cast<double>(count) / static_cast<double>(all);
}

// Sorted view depths of the surface pixels, in a large picture of a sample of them.
std::vector<float> sortedDepths(const image::Image& viewDepth) {
  constexpr size_t kMost = 200000;
  std::vector<float> depths;
  std::ranges::copy_if(viewDepth.pixels, std::back_inserter(depths), [](float z) { return z > 0; });
  const size_t step = depths.size() / kMost + 1;
  size_t kept = 0;
  for (size_t i = 0; i < depths.size(); i += step) depths[kept++] = depths[i];
  depths.resize(kept);
  std::ranges::sort(depths);
  return depths;
}

double quantile(const std::vector<float>& sorted, double part) {
  const auto last = static_cast<double>(sorted.size() - 1);
  return double{sorted[static_cast<size_t>(part * last)]};
}

// "" if metres are plausible.
std::string doubtOfMetres(const DepthSource& depth, const std::vector<float>& sorted, double near) {
  constexpr double kFar = 1000;  // metres; ambient occlusion of landscapes is rare
  const double median = quantile(sorted, 0.5);
  const bool upToOne = std::ranges::max(depth.stored.pixels) <= 1;
  const auto ones = std::ranges::count(depth.stored.pixels, 1.0f);
  if (upToOne && share(ones, depth.stored.pixels.size()) > 0.01) {
    return fmt::format(
        "{:.0f} % of the pixels have the depth 1 and none has more, like the sky of a depth "
        "buffer; for that, pass --depth-kind clip",
        100 * share(ones, depth.stored.pixels.size()));
  }
  if (upToOne && quantile(sorted, 0.05) > 0.9) {
    return fmt::format(
        "95 % of the surface pixels have depths of {:.3g} to 1, like a depth buffer; for that, "
        "pass --depth-kind clip",
        quantile(sorted, 0.05));
  }
  if (median < near) {
    return fmt::format(
        "half of the surface pixels are nearer than {:.3g} m, in front of the near plane at {:.3g} "
        "m; for a depth buffer, pass --depth-kind clip-reversed, and write other depths in metres",
        median, near);
  }
  if (median > kFar) {
    return fmt::format(
        "half of the surface pixels are farther than {:.4g} m; if the depth counts in another "
        "unit, write it in metres",
        median);
  }
  return "";
}

// "" if the depth buffer's direction is plausible.
std::string doubtOfBuffer(const DepthSource& depth, const std::vector<float>& sorted, double near) {
  constexpr double kClose = 1.25;  // near planes
  if (quantile(sorted, 0.95) >= kClose * near) return "";
  return fmt::format(
      "95 % of the surface pixels are within {} times the near plane; if 1 stands for the {} "
      "plane, pass --depth-kind {}",
      kClose, depth.kind == "clip" ? "near" : "far",
      depth.kind == "clip" ? "clip-reversed" : "clip");
}

}  // namespace

void Warnings::once(const std::string& kind, const std::string& text) {
  if (kinds_.insert(kind).second) fmt::print(stderr, "warning: {}\n", text);
}

void checkStoredDepth(const DepthSource& depth) {
  const std::vector<float>& values = depth.stored.pixels;
  if (inMetres(depth)) {
    if (!depth.integers) return;
    throw Error(ErrorId::kPictureDepth,
                "{}: the file stores integers, which read as 0 to 1, but --depth-kind {} needs "
                "metres in floats",
                depth.file, depth.kind);
  }
  const float sky = depth.kind == "clip" ? 1 : 0, near = 1 - sky;
  const double wrong = share(std::ranges::count(values, near), values.size());
  if (wrong < 0.01 || std::ranges::find(values, sky) != values.end()) return;
  throw Error(ErrorId::kPictureDepth,
              "{}: {:.0f} % of the pixels are {}, the near plane of --depth-kind {}, and none is "
              "{}; the picture looks like --depth-kind {}",
              depth.file, 100 * wrong, near, depth.kind, sky,
              depth.kind == "clip" ? "clip-reversed" : "clip");
}

void checkViewDepth(const DepthSource& depth, const Surfaces& surfaces, Warnings& warnings) {
  const std::vector<float> sorted = sortedDepths(surfaces.viewDepth);
  if (sorted.empty()) {
    warnings.once("sky", depth.file +
                             ": no pixel shows a surface: every depth is 0, at least 1e9 m, or at "
                             "least --far");
    return;
  }
  if (sorted.size() > 1 && sorted.front() == sorted.back()) {
    warnings.once("constant", fmt::format("{}: every surface pixel has the same depth, {:.6g} m",
                                          depth.file, sorted.front()));
    return;
  }
  const double near = surfaces.camera.nearPlane;
  const std::string doubt =
      inMetres(depth) ? doubtOfMetres(depth, sorted, near) : doubtOfBuffer(depth, sorted, near);
  if (!doubt.empty()) warnings.once("depth", depth.file + ": " + doubt);
}

void checkCamera(const scene::Camera& camera, const image::Picture& depth, const std::string& file,
                 Warnings& warnings) {
  if (!depth.matrices) return;
  scene::Camera own;
  try {
    own = scene::cameraOf(*depth.matrices, depth.image.width, depth.image.height, file);
  } catch (const Error&) {
    return;  // --camera stands in for matrices that cannot be used
  }
  const glm::dmat3 a = scene::worldFromView(camera), b = scene::worldFromView(own);
  // The angle of the rotation between both.
  const glm::dmat3 turn = glm::transpose(a) * b;
  const double cosine = (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2;
  const double turned = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
  constexpr double kDegrees = 0.5;
  const bool parallel = camera.orthographicHeight > 0;
  if (parallel != (own.orthographicHeight > 0)) {
    warnings.once("camera", fmt::format("{}: --camera is {}, but not the camera in the file; leave "
                                        "out --camera to take that of the file",
                                        file, parallel ? "orthographic" : "perspective"));
    return;
  }
  const glm::uvec2 size(depth.image.width, depth.image.height);
  const scene::View given = scene::viewOf(camera, size), stored = scene::viewOf(own, size);
  // Pixels by which the pictures' corners are shifted against each other.
  const glm::dvec2 moved = (given.offset - stored.offset) / stored.scale;
  const glm::dvec2 ended = moved + glm::dvec2(size) * (given.scale - stored.scale) / stored.scale;
  constexpr double kShare = 0.01;  // of the picture
  const bool shifted =
      std::max(glm::length(moved), glm::length(ended)) > kShare * glm::length(glm::dvec2(size));
  if (turned < kDegrees && std::abs(camera.fovyDegrees - own.fovyDegrees) < kDegrees) {
    if (!shifted) return;
    warnings.once("camera", fmt::format("{}: --camera shows another part than the camera in the "
                                        "file; leave out --camera to take that of the file",
                                        file));
    return;
  }
  warnings.once("camera",
                fmt::format("{}: --camera is turned by {:.1f} degrees from the camera in the file, "
                            "and its angle of view is {:.1f} instead of {:.1f} degrees; leave out "
                            "--camera to take that of the file",
                            file, turned, camera.fovyDegrees, own.fovyDegrees));
}

void checkBaseColour(const image::Image& colour, const std::string& file, Warnings& warnings) {
  const std::vector<float>& values = colour.pixels;
  const auto odd = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
  if (odd != values.end()) {
    const auto pixel = static_cast<size_t>(odd - values.begin()) / colour.channels;
    throw Error(ErrorId::kPictureColour, "{}: the base colour at ({}, {}) is not finite", file,
                pixel % colour.width, pixel / colour.width);
  }
  const auto outside = std::ranges::count_if(values, [](float v) { return v < 0 || v > 1; });
  if (outside == 0) return;
  const auto [least, most] = std::ranges::minmax(values);
  warnings.once("colour",
                fmt::format("{}: {:.2g} % of the base colours' values are outside 0 to 1, from "
                            "{:.4g} to {:.4g}; they are clamped",
                            file, 100 * share(outside, values.size()), least, most));
}

}  // namespace grisaille::app
