// SPDX-License-Identifier: MIT
// Effects over many frames: several at a time, of changing sizes, without an allocation.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/image/image.h"
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

std::vector<float> viewOf(const Seen& seen) {
  return {seen.view.begin(), seen.view.end()};
}

class Frames : public ::testing::TestWithParam<std::string> {
 protected:
  explicit Frames(bool validate = true)
      : host_(makeHost(GetParam(), validate)), device_(host_->device()) {}
  ~Frames() override { EXPECT_EQ(host_->complaints(), 0); }

  host::Texture depth(uint32_t width, uint32_t height) {
    return host_->texture(device_, Texels::kFloat1, width, height,
                          viewOf(see(eye(), width, height)));
  }
  void record(host::Effect& effect, const host::Texture& depth,
              const host::Texture* colour = nullptr, const host::Texture* back = nullptr) {
    host_->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = camera_,
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                     .backDepth = back,
                     .baseColour = colour});
    });
  }
  host::Effect ssao(uint32_t width, uint32_t height) {
    host::Effect effect(device_, {.effect = "ssao", .width = width, .height = height});
    effect.set("radius", 0.6);
    return effect;
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
  host::Camera camera_ = host::Camera::pinhole(&eye().viewFromWorld[0][0], 0.8, 0.25);
};
INSTANTIATE_TEST_SUITE_P(, Frames, ::testing::Values("vulkan", "opengl"),
                         [](const auto& test) { return test.param; });

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

// In one frame, each with a size and values of its own.
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

// Light that base colours throw back tints what is dark.
TEST_P(Frames, EveryOutputIsThere) {
  host::Effect effect(device_, {.effect = "ssao",
                                .width = 64,
                                .height = 48,
                                .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM,
                                .outputs = {"ao", "bent_normal", "tint"}});
  effect.set("bounce", "base_colour");
  effect.set("back_faces", 1);
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
  // Matter that ends right behind what is seen hides less.
  std::vector<float> behind = viewOf(see(eye(), 64, 48));
  std::reverse(behind.begin(), behind.end());  // rows from the bottom; columns do not matter here
  for (float& metres : behind) metres = metres > 0 ? metres + 0.01f : 0;
  const host::Texture back = host_->texture(device_, Texels::kFloat1, 64, 48, behind);
  record(effect, seen, &colour, &back);
  EXPECT_NE(host_->read(effect.output("ao")), open);
}

// From the second frame on: neither memory of the host's nor any object of the API's, which would
// come with memory of the host's.
class UnwatchedFrames : public Frames {
 protected:
  UnwatchedFrames() : Frames(false) {}
};
INSTANTIATE_TEST_SUITE_P(, UnwatchedFrames, ::testing::Values("vulkan", "opengl"),
                         [](const auto& test) { return test.param; });

TEST_P(UnwatchedFrames, RecordingAgainAllocatesNothing) {
  if (SANITIZED) GTEST_SKIP() << "the sanitizers allocate themselves";
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
