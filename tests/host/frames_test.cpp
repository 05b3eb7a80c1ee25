// SPDX-License-Identifier: MIT
// Effects over many frames: several effects per frame, changing sizes, no allocations.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <numeric>

#include "core/image/image.h"
#include "effects/sspm/shot.h"
#include "tests/core/effect/plugins/mark.h"
#include "tests/host/allocations.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"

namespace grisaille::tests {
namespace {

Eye eye() {
  return {.viewFromWorld = glm::lookAt(glm::dvec3(1.2, 1.6, 3.1), glm::dvec3(0.1, 0.5, -0.3),
                                       glm::dvec3(0, 1, 0)),
          .angle = 0.8};
}

TEST(HostDevices, AreInstalled) {
  for (const TestDevice& device : testDevices()) {
    const std::string why = whyMissing(device);
    if (!why.empty()) GTEST_SKIP() << why;
  }
}

std::vector<float> viewOf(const Seen& seen) {
  return {seen.view.begin(), seen.view.end()};
}

class Frames : public ::testing::TestWithParam<TestDevice> {
 protected:
  explicit Frames(bool validate = true)
      : host_(makeHost(GetParam(), validate)), device_(host_->device()) {}
  ~Frames() override { EXPECT_EQ(host_->complaints(), 0); }

  host::Texture depth(uint32_t width, uint32_t height) {
    return host_->texture(device_, Texels::kFloat1, width, height,
                          viewOf(see(eye(), width, height)));
  }
  void record(host::Effect& effect, const host::Texture& depth,
              const host::Texture* colour = nullptr, const host::Texture* back = nullptr,
              const host::Texture* thickness = nullptr, const host::Texture* next = nullptr,
              double patience = 0) {
    host_->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = camera_,
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                     .backDepth = back,
                     .baseColour = colour,
                     .thickness = thickness,
                     .nextDepth = next,
                     .patience = patience});
    });
  }
  host::Effect ssao(uint32_t width, uint32_t height) {
    host::Effect effect(device_, {.effect = "ssao", .width = width, .height = height});
    effect.set("radius", 0.6);
    return effect;
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
  const glm::dmat4 projection_ = projectionOf(eye(), 4.0 / 3, {.near = 0.25});
  host::Camera camera_{&eye().viewFromWorld[0][0], &projection_[0][0]};
};
GRISAILLE_IN_EVERY_HOST(Frames);

TEST_P(Frames, EffectsAreListedWithTheirTables) {
  ASSERT_EQ(device_.effects().size(), 2u);
  const grisaille_effect_desc& first = *device_.effects()[0];
  EXPECT_STREQ(first.key, "ssao");
  EXPECT_STREQ(first.outputs[0].key, "ao");
  EXPECT_GT(first.param_count, 5u);
}

TEST_P(Frames, ParametersHoldFromTheNextRecording) {
  host::Effect effect = ssao(64, 48);
  const host::Texture seen = depth(64, 48);
  EXPECT_EQ(effect.get("radius"), 0.6);
  record(effect, seen);
  const std::vector<float> wide = host_->read(effect.output("ao"));
  effect.set("radius", "0.05");
  EXPECT_EQ(effect.get("radius"), 0.05);
  record(effect, seen);
  EXPECT_NE(host_->read(effect.output("ao")), wide);
  effect.set("radius", 0.6);
  record(effect, seen);
  EXPECT_EQ(host_->read(effect.output("ao")), wide);
}

TEST_P(Frames, OtherSizesAreOtherTextures) {
  host::Effect effect = ssao(64, 48);
  record(effect, depth(64, 48));
  const grisaille_host_output before = effect.output("ao");
  const std::vector<float> expected = host_->read(before);
  effect.resize(33, 71);
  EXPECT_EQ(effect.output("ao").width, 33u);
  EXPECT_EQ(effect.output("ao").height, 71u);
  record(effect, depth(33, 71));
  EXPECT_EQ(host_->read(effect.output("ao")).size(), size_t{33} * 71);
  effect.resize(64, 48);
  record(effect, depth(64, 48));
  EXPECT_EQ(host_->read(effect.output("ao")), expected);
  EXPECT_EQ(effect.output("ao").format, GRISAILLE_FORMAT_R16F);
}

// In one frame, each with its own size and values.
TEST_P(Frames, EffectsOfOneDeviceLeaveEachOtherAlone) {
  host::Effect one = ssao(64, 48), other = ssao(40, 30);
  other.set("radius", 0.3);
  const host::Texture large = depth(64, 48), small = depth(40, 30);
  record(one, large);
  record(other, small);
  const std::vector<float> first = host_->read(one.output("ao"));
  const std::vector<float> second = host_->read(other.output("ao"));
  for (int frame = 0; frame < 3; ++frame) {
    host_->frame([&](void* commands, uint64_t number) {
      host::Frame wanted = {.number = number,
                            .commandBuffer = commands,
                            .camera = camera_,
                            .depth = large,
                            .depthKind = GRISAILLE_HOST_DEPTH_VIEW};
      one.record(wanted);
      other.record({.number = number,
                    .commandBuffer = commands,
                    .camera = camera_,
                    .depth = small,
                    .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
    });
  }
  EXPECT_EQ(host_->read(one.output("ao")), first);
  EXPECT_EQ(host_->read(other.output("ao")), second);
}

// Light bounced by base colours tints dark areas.
TEST_P(Frames, EveryOutputIsThere) {
  host::Effect effect(device_, {.effect = "ssao",
                                .width = 64,
                                .height = 48,
                                .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM,
                                .outputs = {"ao", "bent_normal", "tint"}});
  effect.set("bounce", "base_colour");
  effect.set("backs", 2);
  std::vector<float> red;
  for (size_t i = 0; i < size_t{64} * 48; ++i) red.insert(red.end(), {0.8f, 0.2f, 0.2f, 1});
  const host::Texture colour = host_->texture(device_, Texels::kUnorm8x4, 64, 48, red);
  const host::Texture seen = depth(64, 48);
  record(effect, seen, &colour);
  const std::vector<float> open = host_->read(effect.output("ao"));
  const std::vector<float> bent = host_->read(effect.output("bent_normal"));
  const std::vector<float> tint = host_->read(effect.output("tint"));
  size_t tinted = 0, lit = 0;
  for (size_t i = 0; i < open.size(); ++i) {
    EXPECT_GE(tint[4 * i] + 2e-3f, open[i]);
    if (tint[4 * i] > tint[4 * i + 1] + 0.01f) ++tinted;
    const double length = std::hypot(bent[4 * i], bent[4 * i + 1], bent[4 * i + 2]);
    if (length > 0) ++lit;
    EXPECT_TRUE(length == 0 || std::abs(length - 1) < 0.01) << length;
  }
  EXPECT_GT(tinted, 50u);
  EXPECT_GT(lit, 1000u);
  // Matter that ends right behind the visible surface occludes less.
  std::vector<float> behind = viewOf(see(eye(), 64, 48));
  std::reverse(behind.begin(), behind.end());  // rows from the bottom; columns may be mirrored
  for (float& metres : behind) metres = metres > 0 ? metres + 0.01f : 0;
  const host::Texture back = host_->texture(device_, Texels::kFloat1, 64, 48, behind);
  record(effect, seen, &colour, &back);
  EXPECT_NE(host_->read(effect.output("ao")), open);
}

// Without the surface behind the back, matter ends at the back; with it, more is occluded.
TEST_P(Frames, TheSurfaceBehindTheBackOccludesIfItIsKnown) {
  host::Effect effect = ssao(64, 48);
  const host::Texture seen = depth(64, 48);
  const auto moved = [&](float by) {
    std::vector<float> all = viewOf(see(eye(), 64, 48));
    std::reverse(all.begin(), all.end());  // rows from the bottom; columns may be mirrored
    for (float& metres : all) metres = metres > 0 ? metres + by : 0;
    return host_->texture(device_, Texels::kFloat1, 64, 48, all);
  };
  const host::Texture back = moved(0.01f), behind = moved(0.05f);
  const auto open = [&](double backs, const host::Texture* next) {
    effect.set("backs", backs);
    record(effect, seen, nullptr, &back, nullptr, next);
    return host_->read(effect.output("ao"));
  };
  const std::vector<float> drawn = open(2, nullptr);
  EXPECT_EQ(open(3, nullptr), drawn);
  EXPECT_NE(open(3, &behind), drawn);
}

// Without a thickness, matter is as thick as assumed; sheets occlude less.
TEST_P(Frames, AThicknessSaysWhatIsASheet) {
  host::Effect effect = ssao(64, 48);
  const host::Texture seen = depth(64, 48);
  const auto mean = [&](double backs, const host::Texture* thickness) {
    effect.set("backs", backs);
    record(effect, seen, nullptr, nullptr, thickness);
    const std::vector<float> open = host_->read(effect.output("ao"));
    return std::accumulate(open.begin(), open.end(), 0.0) / static_cast<double>(open.size());
  };
  const host::Texture sheets =
      host_->texture(device_, Texels::kFloat1, 64, 48, std::vector<float>(size_t{64} * 48, 0.0f));
  const double assumed = mean(0, nullptr);
  EXPECT_EQ(mean(1, nullptr), assumed);
  EXPECT_GT(mean(1, &sheets), assumed + 0.002);
}

// Casts rays in the world and adds their number to `context`.
void castWorld(void* context, const grisaille_ray* rays, uint64_t count, grisaille_hit* hits) {
  *static_cast<uint64_t*>(context) += count;
  for (uint64_t i = 0; i < count; ++i) {
    const glm::dvec3 origin(rays[i].origin[0], rays[i].origin[1], rays[i].origin[2]);
    const glm::dvec3 way(rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]);
    const Met met = meet(origin, way);
    if (!(met.along < rays[i].reach)) continue;
    const glm::dvec3 normal = glm::dot(met.normal, way) > 0 ? -met.normal : met.normal;
    hits[i] = {.kind = GRISAILLE_HIT_SURFACE,
               .distance = static_cast<float>(met.along),
               .normal = {static_cast<float>(normal.x), static_cast<float>(normal.y),
                          static_cast<float>(normal.z)}};
  }
}

// Draws depth pictures of the world and counts them in `context`. It does not know the first one
// yet.
void drawWorld(void* context, const grisaille_depth_view* view, float* depth) {
  if ((*static_cast<uint64_t*>(context))++ == 0) return;
  const glm::dvec3 origin(view->origin[0], view->origin[1], view->origin[2]);
  const glm::dvec3 way(view->direction[0], view->direction[1], view->direction[2]);
  const glm::dvec3 up(view->up[0], view->up[1], view->up[2]), right = glm::cross(way, up);
  const double half = 0.5 * view->size;
  for (uint32_t y = 0; y < view->size; ++y) {
    for (uint32_t x = 0; x < view->size; ++x) {
      const double toRight = view->slope * (x + 0.5 - half) / half;
      const double downwards = view->slope * (y + 0.5 - half) / half;
      const glm::dvec3 along = way + toRight * right - downwards * up;
      depth[y * view->size + x] = static_cast<float>(meet(origin, along).along);
    }
  }
}

void drawNonsense(void*, const grisaille_depth_view*, float* depth) {
  depth[5] = -1;
}

void castNonsense(void*, const grisaille_ray*, uint64_t count, grisaille_hit* hits) {
  for (uint64_t i = 0; i < count; ++i) hits[i].kind = 7;
}

sspm::Shot shotAt(const glm::dvec3& origin, const glm::dvec3& target) {
  const glm::vec3 way(glm::normalize(target - origin));
  return {.origin = {origin.x, origin.y, origin.z},
          .direction = {way.x, way.y, way.z},
          .color = {1, 0.2f, 0},
          .range = 0.25};
}

using Shots = std::vector<sspm::Shot>;

// Paint covers surfaces that the shot's muzzle sees: the ball, but not the wall behind it.
TEST_P(Frames, ShotsPaintWhatTheHostsRaysFind) {
  host::Effect effect(device_, {.effect = "sspm", .width = 96, .height = 72});
  effect.set("edge_fade", 0.0);
  const Seen world = see(eye(), 96, 72);
  const host::Texture seen = depth(96, 72);
  const glm::dmat4 placed = glm::inverse(eye().viewFromWorld);
  const auto painted = [&](const glm::dvec3& axisOrigin, const glm::dvec3& way) {
    record(effect, seen);
    const std::vector<float> paint = host_->read(effect.output("paint"));
    std::pair<size_t, size_t> count = {0, 0};  // pixels that the muzzle sees; other pixels
    for (size_t i = 0; i < world.view.size(); ++i) {
      if (paint[4 * i + 3] < 0.5f) continue;
      const double half = std::tan(0.4);
      const glm::dvec3 ray(2 * half / 72 * (static_cast<double>(i % 96) + 0.5 - 48),
                           2 * half / 72 * (36 - static_cast<double>(i / 96) - 0.5), -1);
      const glm::dvec3 place(placed * glm::dvec4(ray * world.view[i], 1));
      const glm::dvec3 from = place - axisOrigin;
      const bool near = glm::length(from - way * glm::dot(from, way)) < 0.3;
      const bool sees = meet(axisOrigin, from).along > 0.98;
      ++(near && sees ? count.first : count.second);
    }
    return count;
  };
  const sspm::Shot shot = shotAt({0.3, 0.6, 2.5}, {0.2, 0.5, -0.2});
  const glm::dvec3 origin(shot.origin[0], shot.origin[1], shot.origin[2]);
  const glm::dvec3 way(shot.direction[0], shot.direction[1], shot.direction[2]);
  effect.setObjects<sspm::Shot>(Shots{shot});
  EXPECT_EQ(painted(origin, way).first, 0u) << "no ray caster is set yet";
  uint64_t asked = 0;
  device_.setRays(castWorld, &asked);
  auto [on, off] = painted(origin, way);
  EXPECT_GT(on, 20u);
  EXPECT_EQ(off, 0u);
  EXPECT_GT(asked, 0u);
  // Adding a shot keeps the paint of earlier shots; an empty list removes all paint.
  const uint64_t first = asked;
  effect.setObjects<sspm::Shot>(Shots{shot, shotAt({-1, 1, 2}, {-0.8, 0, 0.2})});
  EXPECT_EQ(painted(origin, way).first, on);
  EXPECT_GT(asked, first);
  const uint64_t second = asked;
  record(effect, seen);
  EXPECT_EQ(asked, second);
  effect.setObjects<sspm::Shot>(Shots{});
  EXPECT_EQ(painted(origin, way), std::pair(size_t{0}, size_t{0}));
  // `per_shot` mode paints every surface in range and needs no rays.
  effect.set("mode", "per_shot");
  effect.setObjects<sspm::Shot>(Shots{shot});
  EXPECT_GE(painted(origin, way).first, on);
  EXPECT_EQ(asked, second);
}

// Depth pictures tell the same as rays. A shot whose picture is not there yet waits for it.
TEST_P(Frames, ShotsPaintWhatTheHostsDepthPicturesShow) {
  host::Effect byRays(device_, {.effect = "sspm", .width = 96, .height = 72});
  host::Effect byDepths(device_, {.effect = "sspm", .width = 96, .height = 72});
  const host::Texture seen = depth(96, 72);
  const Shots shots = {shotAt({0.3, 0.6, 2.5}, {0.2, 0.5, -0.2}),
                       shotAt({-1, 1, 2}, {-0.8, 0, 0.2})};
  const auto paintOf = [&](host::Effect& effect) {
    effect.set("edge_fade", 0.0);
    effect.setObjects<sspm::Shot>(shots);
    record(effect, seen);
    return host_->read(effect.output("paint"));
  };
  const auto apart = [](const std::vector<float>& a, const std::vector<float>& b) {
    size_t count = 0;
    for (size_t i = 3; i < a.size(); i += 4) count += a[i] != b[i] ? 1 : 0;
    return count;
  };
  const std::vector<float> none = paintOf(byRays);
  uint64_t rays = 0, pictures = 0;
  device_.setRays(castWorld, &rays);
  const std::vector<float> traced = paintOf(byRays);
  EXPECT_GT(apart(traced, none), 50u);
  const uint64_t cast = rays;
  device_.setDepths(drawWorld, &pictures);
  const std::vector<float> early = paintOf(byDepths);
  EXPECT_GT(apart(early, traced), 10u);
  EXPECT_LE(apart(paintOf(byDepths), traced), apart(traced, none) / 20);
  EXPECT_EQ(rays, cast);
  EXPECT_GT(pictures, 5u);
  // A drawer of nonsense is refused.
  device_.setDepths(drawNonsense, nullptr);
  host::Effect refused(device_, {.effect = "sspm", .width = 96, .height = 72});
  refused.setObjects<sspm::Shot>(shots);
  host_->frame([&](void* commands, uint64_t number) {
    EXPECT_THROW(refused.record({.number = number,
                                 .commandBuffer = commands,
                                 .camera = camera_,
                                 .depth = seen,
                                 .depthKind = GRISAILLE_HOST_DEPTH_VIEW}),
                 host::Failure);
    EXPECT_NE(std::string(grisaille_host_last_error()).find("depth 5 of"), std::string::npos)
        << grisaille_host_last_error();
  });
  device_.setDepths(nullptr, nullptr);
  device_.setRays(nullptr, nullptr);
}

// The score of a floor of 4 x 4 m: the disc of a shot, without what another object shades.
TEST_P(Frames, PointsTellWhatShotsCover) {
  host::Effect effect(device_, {.effect = "sspm", .width = 96, .height = 72});
  effect.set("edge_fade", 0.0);
  uint64_t asked = 0;
  device_.setRays(castWorld, &asked);
  const host::Texture seen = depth(96, 72);
  Shots shots = {shotAt({-1.2, 1, 1.2}, {-1.2, 0, 1.2}), shotAt({-1.2, 1, 1.3}, {-1.2, 0, 1.3})};
  shots[0].range = shots[1].range = 0.5;
  std::vector<grisaille_point> points;
  for (int i = 0; i < 400 * 400; ++i) {
    points.push_back({.position = {-2 + 0.01 * (i % 400 + 0.5), 0, -2 + 0.01 * (i / 400 + 0.5)},
                      .normal = {0, 1, 0},
                      .reserved = 0});
  }
  const auto shares = [&] {
    std::array<double, 3> sums = {};
    for (const grisaille_drawn& drawn : effect.drawAt(points)) {
      sums[drawn.owner] += drawn.owner == 0 ? 0.01 * 0.01 : double{drawn.alpha} * 0.01 * 0.01;
    }
    return sums;
  };
  effect.setObjects<sspm::Shot>(shots);
  EXPECT_NEAR(shares()[0], 16, 1e-6) << "no recording has placed the shots";
  record(effect, seen);
  const uint64_t placed = asked;
  const auto [none, first, second] = shares();
  EXPECT_GT(asked, placed);
  const double disc = 0.25 * std::numbers::pi;
  const double lens = 0.5 * std::acos(0.1) - 0.05 * std::sqrt(1 - 0.01);  // discs 0.1 m apart
  EXPECT_NEAR(second, disc, 0.01);
  EXPECT_NEAR(first, disc - lens, 0.01);
  EXPECT_NEAR(none, 16 - 2 * disc + lens, 0.01);
}

// With little patience, shots wait for later recordings. What a limit leaves no room for is told.
TEST_P(Frames, ShotsThatWaitOrAreGivenUpAreTold) {
  host::Effect effect(device_, {.effect = "sspm", .width = 96, .height = 72});
  effect.set("memory", 16.0);
  const host::Texture seen = depth(96, 72);
  uint64_t asked = 0;
  device_.setRays(castWorld, &asked);
  Shots shots;
  for (int i = 0; i < 9000; ++i) {
    const glm::dvec3 target(-1.5 + 0.03 * (i % 100), 0, -1.5 + 0.03 * (i / 100));
    shots.push_back(shotAt(target + glm::dvec3(0.1, 1, 0.2), target));
    shots.back().range = 0.01;
  }
  effect.setObjects<sspm::Shot>(shots);
  const auto recorded = [&](double patience) {
    record(effect, seen, nullptr, nullptr, nullptr, nullptr, patience);
    grisaille_host_report report{};
    report.struct_size = sizeof(report);
    EXPECT_EQ(grisaille_host_effect_report(effect.handle(), &report), 0);
    return report;
  };
  const uint64_t first = recorded(1e-6).waiting;
  EXPECT_GT(first, 0u);
  EXPECT_LE(first, shots.size());
  EXPECT_LT(recorded(0.1).waiting, first);
  const grisaille_host_report whole = recorded(0);
  EXPECT_EQ(whole.waiting, 0u);
  EXPECT_GT(whole.given_up, 0u);
  EXPECT_LT(whole.given_up, shots.size());
  effect.setObjects<sspm::Shot>(std::span(shots).first(10));
  EXPECT_EQ(recorded(0).given_up, 0u);
  EXPECT_THROW(recorded(-1), host::Failure);
}

TEST_P(Frames, RaysThatTellNonsenseAreRefused) {
  host::Effect effect(device_, {.effect = "sspm", .width = 32, .height = 24});
  effect.setObjects<sspm::Shot>(Shots{shotAt({0.3, 0.6, 2.5}, {0.2, 0.5, -0.2})});
  device_.setRays(castNonsense, nullptr);
  const host::Texture seen = depth(32, 24);
  // The command buffer is still submitted.
  host_->frame([&](void* commands, uint64_t number) {
    EXPECT_THROW(effect.record({.number = number,
                                .commandBuffer = commands,
                                .camera = camera_,
                                .depth = seen,
                                .depthKind = GRISAILLE_HOST_DEPTH_VIEW}),
                 host::Failure);
    EXPECT_NE(std::string(grisaille_host_last_error()).find("has the kind 7"), std::string::npos)
        << grisaille_host_last_error();
  });
  device_.setRays(nullptr, nullptr);
  record(effect, seen);
}

TEST_P(Frames, ObjectsOfAFileAreThoseThatAreSet) {
  host::Effect set(device_, {.effect = "sspm", .width = 96, .height = 72});
  host::Effect loaded(device_, {.effect = "sspm", .width = 96, .height = 72});
  uint64_t asked = 0;
  device_.setRays(castWorld, &asked);
  set.setObjects<sspm::Shot>(Shots{shotAt({0.5, 1, 2}, {0.5, 0, -2})});
  const sspm::Shot shot = shotAt({0.5, 1, 2}, {0.5, 0, -2});
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("grisaille_host_" + std::to_string(getpid()));
  std::ofstream(path) << std::setprecision(17)
                      << R"({"version": 1, "shots": [{"origin": [0.5, 1, 2],
    "direction": [)" << shot.direction[0]
                      << ", " << shot.direction[1] << ", " << shot.direction[2]
                      << R"(], "color": [1, 0.2, 0], "range": 0.25}]})";
  loaded.loadObjects(path.c_str());
  std::filesystem::remove(path);
  const host::Texture seen = depth(96, 72);
  record(set, seen);
  record(loaded, seen);
  const std::vector<float> paint = host_->read(set.output("paint"));
  EXPECT_EQ(host_->read(loaded.output("paint")), paint);
  EXPECT_TRUE(std::ranges::any_of(paint, [](float x) { return x > 0; }));
}

// A host drops a command buffer, for example when its window is resized, and records anew.
TEST_P(Frames, ADroppedRecordingLeavesNoTrace) {
  const host::Texture seen = depth(64, 48);
  host::Effect expected = ssao(64, 48);
  expected.set("estimator", "classic");
  record(expected, seen);
  const std::vector<float> open = host_->read(expected.output("ao"));
  for (const int before : {0, 2}) {  // recordings that were submitted
    host::Effect effect = ssao(64, 48);
    effect.set("estimator", "classic");  // uploads its noise in the first recording
    for (int i = 0; i < before; ++i) record(effect, seen);
    for (int i = 0; i < 2; ++i) {
      host_->drop([&](void* commands, uint64_t number) {
        effect.record({.number = number,
                       .commandBuffer = commands,
                       .camera = camera_,
                       .depth = seen,
                       .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
      });
      effect.dropped();
    }
    record(effect, seen);
    EXPECT_EQ(host_->read(effect.output("ao")), open) << before;
  }
}

// An effect that writes its inputs to its output.
class Told : public Frames {
 protected:
  Told() : own_(host_->device(TELLER_FOLDER)) {}

  std::vector<float> told(host::Effect& effect) {
    const host::Texture seen =
        host_->texture(own_, Texels::kFloat1, 16, 8, std::vector<float>(16 * 8, 2.0f));
    record(effect, seen);
    return host_->read(effect.output("told"));
  }

  host::Device own_;
};
GRISAILLE_IN_EVERY_HOST(Told);

TEST_P(Told, LeadingObjectsThatAreEqualAreKept) {
  host::Effect effect(own_, {.effect = "teller", .width = 16, .height = 8});
  std::vector<Mark> marks(5, {{1, 2, 3}, {0, 1, 0}, {1, 1, 1}, 0.5, "note", ""});
  const auto kept = [&] {
    effect.setObjects<Mark>(marks);
    const std::vector<float> texels = told(effect);
    EXPECT_EQ(texels[0], static_cast<float>(marks.size()));
    return texels[1];
  };
  EXPECT_EQ(kept(), 0);
  EXPECT_EQ(kept(), 5);
  marks.push_back(marks[0]);
  EXPECT_EQ(kept(), 5);
  // Texts are compared by content, not by address.
  const std::string same = "note";
  for (Mark& mark : marks) mark.note = same.c_str();
  EXPECT_EQ(kept(), 6);
  marks[3].note = "another";
  EXPECT_EQ(kept(), 3);
  marks.clear();
  EXPECT_EQ(kept(), 0);
}

struct Decoder {
  std::vector<std::string> asked;
  std::vector<uint8_t> pixels = std::vector<uint8_t>(3 * 2 * 4, 200);
};

grisaille_result readPicture(void* context, const char* path, grisaille_picture* out) {
  auto& decoder = *static_cast<Decoder*>(context);
  decoder.asked.emplace_back(path);
  if (decoder.asked.back() == "missing.png") return GRISAILLE_FAILED;
  out->width = decoder.asked.back() == "empty.png" ? 0 : 3;
  out->height = 2;
  out->rgba = decoder.pixels.data();
  return GRISAILLE_OK;
}

TEST_P(Told, PicturesAreReadByTheHost) {
  host::Effect effect(own_, {.effect = "teller", .width = 16, .height = 8});
  effect.set("picture", "last");
  const auto width = [&](const char* path) {
    effect.setObjects<Mark>(
        std::vector<Mark>{{{1, 2, 3}, {0, 1, 0}, {1, 1, 1}, 0.5, "note", path}});
    return told(effect)[9];
  };
  EXPECT_EQ(width("moss.png"), -1) << "no picture reader is set yet";
  Decoder decoder;
  own_.setPictures(readPicture, &decoder);
  EXPECT_EQ(width("moss.png"), 3);
  EXPECT_EQ(width("missing.png"), -1);
  EXPECT_EQ(width("empty.png"), -1);
  EXPECT_EQ(decoder.asked, (std::vector<std::string>{"moss.png", "missing.png", "empty.png"}));
  own_.setPictures(nullptr, nullptr);
  EXPECT_EQ(width("moss.png"), -1);
  EXPECT_EQ(decoder.asked.size(), 3u);
}

// From the second frame on, recording allocates no memory of the host's and creates no API objects,
// which would allocate such memory.
class UnwatchedFrames : public Frames {
 protected:
  UnwatchedFrames() : Frames(false) {}
};
GRISAILLE_IN_EVERY_HOST(UnwatchedFrames);

TEST_P(UnwatchedFrames, RecordingAgainAllocatesNothing) {
  if (SANITIZED) GTEST_SKIP() << "sanitizers allocate memory themselves";
  host::Effect one = ssao(64, 48), other = ssao(40, 30);
  const host::Texture large = depth(64, 48), small = depth(40, 30);
  size_t first = 0, last = 0;
  for (int i = 0; i < 6; ++i) {
    host_->frame([&](void* commands, uint64_t number) {
      const AllocationCount count;
      for (host::Effect* effect : {&one, &other}) {
        effect->record({.number = number,
                        .commandBuffer = commands,
                        .camera = camera_,
                        .depth = effect == &one ? large : small,
                        .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
      }
      last = count.soFar();
    });
    if (i == 0) first = last;
  }
  EXPECT_GT(first, 0u) << "allocations are not counted";
  EXPECT_EQ(last, 0u);
}

}  // namespace
}  // namespace grisaille::tests
