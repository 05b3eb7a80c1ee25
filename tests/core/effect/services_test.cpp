// SPDX-License-Identifier: MIT
// Services of the host while an effect records: rays, pictures, patience, pending work.
#include <cmath>
#include <numeric>

#include "tests/core/effect/instance_fixture.h"
#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

// Answers each ray with a distance derived from its index in the batch.
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

// Draws depths that count up from 1.
struct Counting : DepthService {
  std::vector<grisaille_depth_view> asked;

  void draw(const grisaille_depth_view& view, std::span<float> depth) override {
    asked.push_back(view);
    std::iota(depth.begin(), depth.end(), 1.0f);
  }
};

// Has exactly one picture.
struct OnePicture : PictureService {
  std::vector<std::string> asked;

  void read(const char* path, grisaille_picture& out) override {
    asked.emplace_back(path);
    if (asked.back() != "moss.png") throw Error(ErrorId::kImageUnreadable, "{} is missing", path);
    static constexpr uint8_t kPixels[] = {200, 0, 0, 255, 0, 0, 0, 255};
    out.width = 2;
    out.height = 1;
    out.rgba = kPixels;
  }
};

struct ServicesTest : InstanceTest {
  const Effect& effect = registry.find("teller");
  const std::vector<gpu::Texture> outputs = {makeTexture("told", gpu::Format::kR32Float)};
  Values values{effect};
  Instance instance{*device, effect};
  objects::Objects marks{*effect.objects()};

  std::vector<float> told(FrameInputs inputs) {
    inputs.objects = marks.view();
    record(instance, values, outputs, inputs);
    return texelsOf(outputs[0]);
  }
};

TEST_F(ServicesTest, PatienceIsToldAndHasNoEndOtherwise) {
  FrameInputs inputs;
  inputs.patience = 0.25;
  EXPECT_EQ(told(inputs)[2], 0.25f);
  EXPECT_EQ(told({})[2], INFINITY);
}

TEST_F(ServicesTest, WhatIsGivenUpIsToldUntilTheNextFrame) {
  values.set("gives_up", "5");
  values.set("coarser", "7");
  told({});
  EXPECT_EQ(instance.report().givenUp, 5u);
  EXPECT_EQ(instance.report().coarser, 7u);
  EXPECT_EQ(instance.report().waiting, 0u);
  values.set("gives_up", "-1");
  values.set("coarser", "-1");
  told({});
  EXPECT_EQ(instance.report().givenUp, 0u);
  EXPECT_EQ(instance.report().coarser, 0u);
}

TEST_F(ServicesTest, WhatWaitsIsToldUntilTheNextFrame) {
  EXPECT_EQ(instance.report().waiting, 0u);
  values.set("waits", "17");
  told({});
  EXPECT_EQ(instance.report().waiting, 17u);
  values.set("waits", "0");
  told({});
  EXPECT_EQ(instance.report().waiting, 0u);
  values.set("waits", "3");
  told({});
  values.set("waits", "-1");
  told({});
  EXPECT_EQ(instance.report().waiting, 0u);
}

TEST_F(ServicesTest, RaysAreCastWhereThereIsAService) {
  values.set("casts", "two");
  EXPECT_EQ(told({})[4], 0);  // no ray service: the effect is told, and continues
  Answers rays;
  FrameInputs inputs;
  inputs.services.rays = &rays;
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

TEST_F(ServicesTest, BadRaysAreRefusedByTheirPlace) {
  Answers rays;
  FrameInputs inputs;
  inputs.services.rays = &rays;
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

TEST_F(ServicesTest, DepthPicturesAreDrawnWhereThereIsAService) {
  values.set("depth", "two");
  EXPECT_EQ(told({})[12], 0);
  Counting depths;
  FrameInputs inputs;
  inputs.services.depths = &depths;
  const std::vector<float> texels = told(inputs);
  EXPECT_EQ(texels[12], 1);
  EXPECT_EQ(texels[13], 4);
  ASSERT_EQ(depths.asked.size(), 1u);
  EXPECT_EQ(depths.asked[0].origin[2], 3);
  EXPECT_EQ(depths.asked[0].size, 2u);
  for (const char* fault : {"nan_origin", "long_direction", "tilted_up", "long_up", "no_slope",
                            "no_size", "large_size", "null"}) {
    values.set("depth", fault);
    try {
      told(inputs);
      ADD_FAILURE() << fault << " was drawn";
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kEffectRecord);
      EXPECT_NE(error.detail().find("draw_depth"), std::string::npos) << error.what();
    }
    EXPECT_EQ(depths.asked.size(), 1u);
  }
}

TEST_F(ServicesTest, PicturesAreReadWhereThereIsAServiceAndAnEffectGoesOnWithoutThem) {
  objects::Object mark(*effect.objects());
  mark.at(*effect.objects(), "picture").text = "moss.png";
  marks.append(mark);
  values.set("picture", "last");
  EXPECT_EQ(told({})[9], -1);
  OnePicture pictures;
  FrameInputs inputs;
  inputs.services.pictures = &pictures;
  const std::vector<float> texels = told(inputs);
  EXPECT_EQ(texels[9], 2);
  EXPECT_EQ(texels[10], 200);
  mark.at(*effect.objects(), "picture").text = "sand.png";
  marks.append(mark);
  EXPECT_EQ(told(inputs)[9], -1);
  EXPECT_EQ(pictures.asked, (std::vector<std::string>{"moss.png", "sand.png"}));
  values.set("picture", "null");
  EXPECT_EQ(told(inputs)[9], -1);
  EXPECT_EQ(pictures.asked.size(), 2u);
}

}  // namespace
}  // namespace grisaille::effect
