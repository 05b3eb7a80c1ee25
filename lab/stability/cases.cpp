// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "lab/stability/case.h"
#include "lab/stability/combinations.h"

namespace grisaille::lab::stability {
namespace {

using Kind = Scenery::Kind;

constexpr double kScales[] = {1e-4, 1e-3, 1e-2, 0.1, 1, 10, 100, 1e3, 1e4, 1e5, 1e6};

class Cases {
 public:
  // Adds one case per variant: the default case, modified by `change`.
  template <typename F>
  void add(const std::string& group, const std::string& name,
           std::initializer_list<const char*> variants, const F& change) {
    for (const char* variant : variants) {
      Case one = usualCase(variant, {});
      one.group = group;
      one.name = name;
      change(one);
      finish(one);
    }
  }
  // Same in a scenery; lengths are in proportion to its scale.
  template <typename F>
  void add(const std::string& group, const std::string& name, const Scenery& scenery,
           std::initializer_list<const char*> variants, const F& change) {
    for (const char* variant : variants) {
      Case one = usualCase(variant, scenery);
      one.group = group;
      one.name = name;
      change(one);
      finish(one);
    }
  }
  std::vector<Case> take() { return std::move(all_); }

 private:
  void finish(Case& one) {
    if (one.variant == "history") {
      // The camera moves by a few pixels per frame.
      for (int i = 6; i > 0; --i) {
        one.before.push_back(one.camera);
        one.before.back().eye += i * one.scenery.scale * glm::dvec3(0.03, 0.004, -0.012);
      }
    }
    one.every = one.size.x < 1000 &&
                (one.group.starts_with("odd") || one.group == "size" ||
                 one.group == "scene's scale" || one.group == "near a wall") &&
                one.before.empty();
    one.edge = edgeOf(one);
    all_.push_back(std::move(one));
  }
  std::vector<Case> all_;
};

std::string number(double value) {
  return fmt::format("{:g}", value);
}

void addCameras(Cases& cases) {
  // Cut at 2.5 m, the room ends exactly at a row of pixels in one frame of the history. Rounding in
  // the driver then decides whether it draws the row: two scenes, which no effect can make alike.
  for (const double near : {1e-4, 1e-3, 1e-2, 0.1, 1.0, 2.51, 10.0}) {
    cases.add("near plane", number(near) + " m",
              {"slices", "slices, backs", "slices, assumed", "slices, refined", "history",
               "open directions", "tint", "classic", "paint"},
              [&](Case& one) {
                one.camera.nearPlane = near;
                one.quick = near == 1e-4;
              });
  }
  for (const double fov : {0.01, 0.1, 1.0, 10.0, 120.0, 170.0}) {
    cases.add("field of view", number(fov) + " degrees",
              {"slices", "slices, refined", "classic", "paint"}, [&](Case& one) {
                one.camera.fovyDegrees = fov;
                // A guard band's camera would see more than a camera may.
                if (fov == 170 && one.effect == "ssao") {
                  one.settings.emplace_back("guard_band", "0");
                }
                one.quick = fov == 0.01 || fov == 1 || fov == 170;
              });
  }
  // At 17 m, the texels below the floor's end are sky where the floor's plane would be at depth 0.
  for (const double height : {0.3, 2.5, 17.0, 20.0}) {
    cases.add("orthographic", number(height) + " m high",
              {"slices", "slices, refined", "classic", "paint"}, [&](Case& one) {
                one.camera.orthographicHeight = height;
                one.camera.farPlane = 8;
                one.quick = height == 2.5;
              });
  }
  for (const auto& [shift, name] :
       {std::pair(glm::dvec2(0.5, -0.25), "half a picture"), {{0.3 / 96, -0.4 / 96}, "jitter"}}) {
    cases.add("view axis off centre", name,
              {"slices", "slices, refined", "history", "classic", "paint"},
              [&, by = shift](Case& one) { one.camera.shift = by; });
  }
  for (const double away : {1e3, 1e5, 1e6, 1e7}) {
    const Scenery scenery{.origin = {away, -0.3 * away, 0.7 * away}};
    cases.add("camera far from the world's origin", number(away) + " m", scenery,
              {"slices", "slices, backs", "slices, assumed", "slices, refined", "history",
               "open directions", "tint", "classic", "paint"},
              [&](Case& one) { one.quick = away == 1e7; });
    const Scenery corner{.kind = Kind::kCorner, .origin = scenery.origin};
    cases.add("camera far from the world's origin", number(away) + " m", corner,
              {"paint on surfaces"}, [&](Case& one) { one.quick = away == 1e7; });
  }
  for (const double distance : {1e-2, 1e-3, 1e-4}) {
    cases.add("near a wall", number(1000 * distance) + " mm", {.kind = Kind::kCorner},
              {"slices", "slices, raw", "slices, refined", "classic", "paint", "paint on surfaces"},
              [&](Case& one) {
                one.camera.eye = {0.1, 0.5, distance};
                one.camera.target = {0.1 + distance, 0.5, 0};
                one.camera.nearPlane = distance / 10;
                one.quick = distance == 1e-3;
              });
  }
}

void addScales(Cases& cases) {
  for (const double scale : kScales) {
    cases.add("scene's scale", number(scale), {.scale = scale},
              {"slices", "slices, raw", "slices, backs", "slices, next", "slices, assumed",
               "slices, refined", "history", "open directions", "tint", "classic", "paint"},
              [&](Case& one) { one.quick = scale == 1e-4 || scale == 1e6; });
    cases.add("scene's scale", number(scale), {.kind = Kind::kCorner, .scale = scale},
              {"paint on surfaces"}, [&](Case& one) { one.quick = scale == 1e6; });
  }
}

void addPlanes(Cases& cases) {
  for (const double degrees : {0.01, 0.1, 1.0, 5.0, 30.0, 60.0, 90.0}) {
    for (const double distance : {0.1, 1.0, 10.0, 100.0, 1000.0, 10000.0}) {
      const Scenery plane{.kind = Kind::kPlane, .scale = std::max(1.0, distance)};
      cases.add("plane", fmt::format("tilt {} degrees, {} m", degrees, distance),
                {"slices", "slices, raw", "classic"}, [&](Case& one) {
                  one.scenery = plane;
                  one.camera = planeCamera(degrees, distance);
                  one.camera.nearPlane = std::min(0.01, distance / 10);
                  one.open = true;
                  one.quick = degrees == 1 && (distance == 0.1 || distance == 10000);
                });
    }
  }
  for (const double scale : {1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
    cases.add("right angle", fmt::format("scale {}", number(scale)),
              {.kind = Kind::kCorner, .scale = scale}, {"slices, exact"}, [&](Case& one) {
                one.corner = true;
                one.quick = scale == 1;
              });
  }
}

void addSizes(Cases& cases) {
  const glm::uvec2 sizes[] = {{1, 1}, {1, 4096}, {4096, 1}, {3, 3}, {257, 129}, {7680, 4320}};
  for (const glm::uvec2 size : sizes) {
    const auto change = [&](Case& one) {
      one.size = size;
      one.quick = size.x < 257 && size.y < 257;
    };
    const std::string name = fmt::format("{}x{}", size.x, size.y);
    cases.add(
        "size", name,
        {"slices", "slices, quarter", "slices, refined", "open directions", "classic", "paint"},
        change);
    if (size.x < 1000 && size.y < 1000) cases.add("size", name, {"history"}, change);
    cases.add("size", name, {.kind = Kind::kCorner}, {"paint on surfaces"}, change);
  }
  for (const double band : {0.05, 0.5, 1.0}) {
    cases.add("guard band", number(band), {"slices", "slices, raw"}, [&](Case& one) {
      one.settings.emplace_back("guard_band", number(band));
      one.quick = band == 0.5;
    });
  }
}

void addValues(Cases& cases) {
  const auto sweep = [&](const std::string& group, const char* key,
                         std::initializer_list<const char*> variants,
                         std::initializer_list<const char*> values) {
    for (const std::string value : values) {
      cases.add(group, value, variants, [&](Case& one) {
        one.settings.emplace_back(key, value);
        one.quick = value == *values.begin();
      });
    }
  };
  sweep("history, frames", "history", {"history"}, {"2", "256"});
  sweep("back faces: thickness, radii", "thickness", {"slices, backs"}, {"0", "1", "1000000"});
  sweep("kernel", "kernel_size", {"classic", "classic, raw"}, {"1", "2", "16", "300"});
  sweep("kernel", "kernel_size", {"slices", "slices, raw"}, {"128", "1", "4"});
  sweep("slices", "slices", {"slices", "slices, raw"}, {"64", "2", "7"});
  sweep("contrast", "contrast", {"slices, refined"}, {"0.01", "0.24", "1"});
  sweep("edge slices", "edge_slices", {"slices", "slices, raw"}, {"16", "1", "3"});
  sweep("radius, m", "radius",
        {"slices", "slices, raw", "slices, quarter", "slices, refined", "classic", "sphere"},
        {"1e-06", "0.001", "10", "1000", "1000000"});
  sweep("bias, m", "bias",
        {"slices", "slices, raw", "slices, backs", "classic", "classic, raw", "sphere"},
        {"0", "1e-06", "0.1", "1", "1000000"});
  sweep("thickness, radii", "thickness", {"slices", "slices, raw", "slices, assumed"},
        {"0", "0.001", "10", "1000000"});
  const auto filter = [&](const std::string& group, const char* key,
                          std::initializer_list<const char*> variants) {
    sweep(group + ", px", key, variants, {"0", "1", "2", "20"});
    for (const std::string value : {"2", "20"}) {
      cases.add(group + " larger than the picture, px", value, variants, [&](Case& one) {
        one.size = {9, 5};
        one.settings.emplace_back(key, value);
        one.quick = true;
      });
    }
  };
  filter("blur along edges", "edge_denoise", {"slices", "slices, quarter", "slices, refined"});
  filter("blur", "blur_size",
         {"slices", "slices, quarter", "slices, refined", "classic", "edge-aware"});
  sweep("range check", "range_check", {"classic", "sphere"}, {"raw_depth", "none"});
  sweep("intensity", "intensity", {"slices", "classic"}, {"0", "10"});
  sweep("power", "power", {"slices", "classic"}, {"0.1", "10"});
}

void addOddScenes(Cases& cases) {
  for (const Kind kind : {Kind::kSky, Kind::kTriangle, Kind::kWires, Kind::kPair}) {
    cases.add(
        "odd scene", nameOf(kind), {.kind = kind},
        {"slices", "slices, raw", "slices, backs", "slices, next", "slices, assumed",
         "slices, refined", "history", "open directions", "classic", "paint", "paint on surfaces"},
        [&](Case& one) { one.quick = true; });
  }
  for (const Kind kind : {Kind::kNoNormals, Kind::kBackNormals}) {
    cases.add("odd scene", nameOf(kind), {.kind = kind},
              {"slices", "slices, raw", "slices, backs", "slices, next", "slices, assumed",
               "slices, refined", "history", "open directions", "classic"},
              [&](Case& one) { one.quick = true; });
  }
  for (const Kind kind : {Kind::kAtNear, Kind::kAtFar, Kind::kMixed, Kind::kNormless}) {
    cases.add("odd depths", nameOf(kind), {.kind = kind},
              {"slices", "slices, raw", "classic", "sphere", "edge-aware", "paint"},
              [&](Case& one) { one.quick = true; });
  }
}

void addPaint(Cases& cases) {
  for (const std::string value : {"1e-06", "0.001", "0.05", "10", "1000", "1000000"}) {
    cases.add("paint range, m", value, {.kind = Kind::kCorner}, {"paint", "paint on surfaces"},
              [&](Case& one) {
                one.settings.emplace_back("paint_range", value);
                one.quick = value == "1e-06";
              });
  }
  for (const std::string value : {"1e-06", "0.001", "1000", "1000000"}) {
    cases.add("r0, m", value, {.kind = Kind::kCorner}, {"paint", "paint on surfaces"},
              [&](Case& one) { one.settings.emplace_back("r0", value); });
    cases.add("splat scale, m", value, {.kind = Kind::kCorner}, {"paint", "paint on surfaces"},
              [&](Case& one) { one.settings.emplace_back("splat_scale", value); });
  }
  const Scenery corner{.kind = Kind::kCorner};
  // The shot goes from the eye through the centre of the middle pixel, (48, 32) of 97 x 65.
  cases.add("shot", "a pixel exactly on the ray", corner, {"paint", "paint on surfaces"},
            [&](Case& one) {
              one.size = {97, 65};
              one.shots = {shotAt(one.camera.eye, one.camera.target, {1, 0.5, 0.2})};
              one.quick = true;
            });
  cases.add("shot", "from inside geometry", {}, {"paint"}, [&](Case& one) {
    one.shots = {shotAt({-0.6, 0.25, 0.5}, {-0.6, 0.25, 3}, {1, 0.5, 0.2}),
                 shotAt({0, -1, 0}, {0, 1, 0.5}, {0, 0.5, 0.2})};
    one.quick = true;
  });
  cases.add("shot", "from the surface itself", corner, {"paint", "paint on surfaces"},
            [&](Case& one) {
              one.shots = {shotAt({0.2, 0.5, 1e-4}, {0.3, 0.4, 0}, {1, 0.5, 0.2})};
            });
  for (const double away : {1e3, 1e5, 1e6, 1e8}) {
    cases.add("shot", "from " + number(away) + " m", corner, {"paint", "paint on surfaces"},
              [&](Case& one) {
                const glm::dvec3 target(0.1, 0.5, 0);
                const glm::dvec3 way = glm::normalize(glm::dvec3(0.3, 0.2, 1));
                one.shots = {shotAt(target + away * way, target, {1, 0.5, 0.2})};
                one.quick = away == 1e6;
              });
  }
  cases.add("shot", "a million on one point", corner, {"paint on surfaces"}, [&](Case& one) {
    one.shots.assign(1000000, shotAt({0, 1, 2}, {0.1, 0.6, 0}, {1, 0.5, 0.2}));
  });
}

}  // namespace

scene::Camera planeCamera(double degrees, double distance) {
  const double tilt = glm::radians(degrees);
  return {.eye = distance * glm::dvec3(0.1 * std::cos(tilt), std::sin(tilt), std::cos(tilt)),
          .target = glm::dvec3(0),
          .up = glm::normalize(glm::dvec3(0.3, std::cos(tilt), -std::sin(tilt)))};
}

std::vector<Case> sweepCases(uint32_t combinations, uint32_t seed) {
  Cases cases;
  addCameras(cases);
  addScales(cases);
  addPlanes(cases);
  addSizes(cases);
  addValues(cases);
  addOddScenes(cases);
  addPaint(cases);
  std::vector<Case> all = cases.take();
  for (Case& one : randomCases(combinations, seed)) all.push_back(std::move(one));
  return all;
}

std::string keyOf(const Case& one) {
  std::string key = fmt::format(
      "{}\n{}\n{} {} {} {} {}\n{}\n{}x{}\n{}\n", one.group, one.name, nameOf(one.scenery.kind),
      one.scenery.scale, one.scenery.origin.x, one.scenery.origin.y, one.scenery.origin.z,
      scene::cameraJson(one.camera), one.size.x, one.size.y, one.effect + "." + one.output);
  for (const scene::Camera& camera : one.before) key += scene::cameraJson(camera) + "\n";
  for (const auto& [name, value] : one.settings) key += fmt::format("{}={}\n", name, value);
  key += fmt::format("{} shots {} {} {} {}\n", one.shots.size(), one.open, one.corner, one.edge,
                     one.variant);
  if (!one.shots.empty()) {
    const Shot& shot = one.shots.front();
    key += fmt::format("{} {} {}\n", shot.origin[0], shot.direction[0], shot.range);
  }
  return key;
}

}  // namespace grisaille::lab::stability
