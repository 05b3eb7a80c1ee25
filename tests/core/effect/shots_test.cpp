// SPDX-License-Identifier: MIT
// What version 1.1 of the interface brought: shots, rays, patience, what waits.
#include <cmath>
#include <cstring>

#include "tests/core/effect/instance_fixture.h"
#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

// Answers with a distance by the ray's place in the batch.
struct Answers : RayService {
  std::vector<grisaille_ray> asked;
  bool fails = false;

  void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) override {
    if (fails) throw Error(ErrorId::kOutOfMemory, "no room");
    ASSERT_EQ(rays.size(), hits.size());
    asked.assign(rays.begin(), rays.end());
    for (size_t i = 0; i < hits.size(); ++i) {
      hits[i] = {GRISAILLE_HIT_SURFACE, static_cast<float>(i + 1), {0, 1, 0}};
    }
  }
};

struct ShotsTest : InstanceTest {
  const Effect& effect = registry.find("shooter");
  const std::vector<gpu::Texture> outputs = {makeTexture("told", gpu::Format::kR32Float)};
  Values values{effect};
  Instance instance{*device, effect};

  std::vector<float> told(const FrameInputs& inputs) {
    record(instance, values, outputs, inputs);
    const std::vector<std::byte> bytes = device->read(outputs[0]);
    std::vector<float> texels(bytes.size() / sizeof(float));
    std::memcpy(texels.data(), bytes.data(), bytes.size());
    return texels;
  }
};

TEST_F(ShotsTest, ReachTheEffectsThatTakeThem) {
  std::vector<grisaille_shot> shots(3);
  shots[2].origin[0] = 42;
  FrameInputs inputs;
  inputs.shots = shots;
  inputs.patience = 0.25;
  std::vector<float> texels = told(inputs);
  EXPECT_EQ(texels[0], 3);
  EXPECT_EQ(texels[2], 0.25f);
  EXPECT_EQ(texels[3], 42);
  texels = told({});
  EXPECT_EQ(texels[0], 0);
  EXPECT_EQ(texels[2], INFINITY);
}

TEST_F(ShotsTest, KeptCountsFromTheInstancesOwnFrameBefore) {
  const std::vector<grisaille_shot> shots(10);
  FrameInputs inputs;
  inputs.shots = shots;
  const auto kept = [&](size_t sinceTheFrameBefore) {
    inputs.shotsKept = sinceTheFrameBefore;
    return told(inputs)[1];
  };
  EXPECT_EQ(kept(10), 0);  // it had none before
  EXPECT_EQ(kept(9), 9);
  EXPECT_EQ(kept(10), 10);
  // Frames without it, then one that it fails.
  instance.limitShotsKept(7);
  instance.limitShotsKept(8);
  EXPECT_EQ(kept(10), 7);
  values.set("casts", "null");
  Answers rays;
  inputs.rays = &rays;
  EXPECT_ERROR(ErrorId::kEffectRecord, kept(4));
  values.set("casts", "none");
  EXPECT_EQ(kept(10), 4);
  EXPECT_EQ(kept(10), 10);
  EXPECT_EQ(kept(11), 10);  // of no more than there are
}

TEST_F(ShotsTest, WhatWaitsIsToldUntilTheNextFrame) {
  EXPECT_EQ(instance.waiting(), 0u);
  values.set("waits", "17");
  told({});
  EXPECT_EQ(instance.waiting(), 17u);
  values.set("waits", "0");
  told({});
  EXPECT_EQ(instance.waiting(), 0u);
  values.set("waits", "3");
  told({});
  values.set("waits", "-1");
  told({});
  EXPECT_EQ(instance.waiting(), 0u);
}

TEST_F(ShotsTest, RaysAreCastWhereThereIsAService) {
  values.set("casts", "two");
  EXPECT_EQ(told({})[4], 0);  // none: the effect is told so, and goes on
  Answers rays;
  FrameInputs inputs;
  inputs.rays = &rays;
  const std::vector<float> texels = told(inputs);
  EXPECT_EQ(texels[4], 1);
  EXPECT_EQ(texels[5], GRISAILLE_HIT_SURFACE);
  EXPECT_EQ(texels[6], 1);
  EXPECT_EQ(texels[8], 2);
  ASSERT_EQ(rays.asked.size(), 2u);
  EXPECT_EQ(rays.asked[0].origin[2], 3);
  EXPECT_EQ(rays.asked[0].reach, INFINITY);
  EXPECT_EQ(rays.asked[1].reach, 5);
}

TEST_F(ShotsTest, BadRaysAreRefusedByTheirPlace) {
  Answers rays;
  FrameInputs inputs;
  inputs.rays = &rays;
  for (const char* fault :
       {"nan_origin", "long_direction", "nan_direction", "no_reach", "nan_reach", "null"}) {
    values.set("casts", fault);
    try {
      told(inputs);
      ADD_FAILURE() << fault << " was cast";
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kEffectRecord);
      EXPECT_NE(error.detail().find("cast_rays"), std::string::npos) << error.what();
      const bool isNull = fault == std::string_view("null");
      EXPECT_NE(error.detail().find(isNull ? "null" : "ray 1"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(rays.asked.empty());
  }
  values.set("casts", "two");
  rays.fails = true;
  EXPECT_ERROR(ErrorId::kEffectRecord, told(inputs));
  rays.fails = false;
  EXPECT_EQ(told(inputs)[4], 1);
}

TEST_F(InstanceTest, AnEffectOfVersion10Runs) {
  const Effect& old = registry.find("old");
  const std::vector<gpu::Texture> outputs = {makeTexture("plain", gpu::Format::kR32Float)};
  const Values values(old);
  Instance instance(*device, old);
  const std::vector<grisaille_shot> shots(1);
  FrameInputs inputs;
  inputs.shots = shots;
  record(instance, values, outputs, inputs);
  EXPECT_EQ(instance.waiting(), 0u);
  EXPECT_EQ(recorded<gpu::RecordedUpload>().size(), 1u);
}

}  // namespace
}  // namespace grisaille::effect
