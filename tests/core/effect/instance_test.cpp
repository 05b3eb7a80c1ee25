// SPDX-License-Identifier: MIT
// Instances of effects on a checked null device.
#include <algorithm>
#include <cstring>

#include "shaders/copy.h"
#include "tests/core/effect/instance_fixture.h"

namespace grisaille::effect {
namespace {

TEST_F(InstanceTest, SoundEffectRecordsItsPasses) {
  const Effect& effect = registry.find("copy");
  const std::vector<gpu::Texture> outputs = {makeTexture("copy", gpu::Format::kR32Float),
                                             makeTexture("second", gpu::Format::kRgba16Float)};
  Values values(effect);
  values.set("gain", "2.5");
  Instance instance(*device, effect);
  record(instance, values, outputs);

  std::vector<std::string> begun;
  for (const gpu::RecordedPass& pass : recorded<gpu::RecordedPass>()) {
    if (pass.begins) begun.push_back(pass.label);
  }
  EXPECT_EQ(begun, (std::vector<std::string>{"copy/in", "copy/out"}));
  EXPECT_EQ(recorded<gpu::RecordedPass>().size(), 4u);

  const auto dispatches = recorded<gpu::RecordedDispatch>();
  ASSERT_EQ(dispatches.size(), 2u);
  for (const gpu::RecordedDispatch& dispatch : dispatches) {
    EXPECT_EQ(dispatch.pipeline, "copy/copy");
    EXPECT_EQ(dispatch.groups, (std::array<uint32_t, 3>{3, 2, 1}));  // 20x12 in 8x8
    EXPECT_EQ(dispatch.bindings.size(), 5u);
  }
  const auto uploads = recorded<gpu::RecordedUpload>();
  ASSERT_EQ(uploads.size(), 3u);
  EXPECT_EQ(uploads[0].resource, "copy/table");
  EXPECT_EQ(uploads[0].bytes, 64u);
  EXPECT_EQ(uploads[1].resource, "copy/scratch");
  EXPECT_EQ(uploads[1].bytes, 16u);
  EXPECT_EQ(uploads[2].bytes, kWidth * kHeight * 8u);
}

TEST_F(InstanceTest, UnwantedOutputsAreNotWritten) {
  const Effect& effect = registry.find("copy");
  const std::vector<gpu::Texture> outputs(2);
  Values values(effect);
  Instance instance(*device, effect);
  record(instance, values, outputs);
  EXPECT_EQ(recorded<gpu::RecordedDispatch>().size(), 1u);
  values.set("skip", "true");
  record(instance, values, outputs);
  EXPECT_TRUE(null->recorded().empty());
}

// The effect keeps one pipeline and drops others that the frame still uses. The device refuses to
// destroy a pipeline in use before the frame ends, and reports leaks.
TEST_F(InstanceTest, WhatIsDestroyedLivesUntilTheFrameEnds) {
  const Effect& effect = registry.find("copy");
  const std::vector<gpu::Texture> outputs = {makeTexture("copy", gpu::Format::kR32Float), {}};
  Values values(effect);
  values.set("upload", "every-frame");
  Instance first(*device, effect), second(*device, effect);
  for (int frame = 0; frame < 40; ++frame) {
    values.set("entry", frame % 5);
    record(first, values, outputs);
    record(second, values, outputs);
  }
  // The pool reuses slots, so the index of a new pipeline bounds the number alive: each instance
  // keeps one and has recently dropped two.
  const gpu::ComputePipeline probe =
      device->createComputePipeline({.label = "probe", .shader = &grisaille_shader_copy});
  EXPECT_LE(probe.index(), 8u);
  device->destroy(probe);
}

TEST_F(InstanceTest, PlainCEffectWritesItsOutput) {
  const Effect& effect = registry.find("plain");
  const std::vector<gpu::Texture> outputs = {makeTexture("plain", gpu::Format::kR32Float)};
  Values values(effect);
  values.set("first", "0.75");
  Instance instance(*device, effect);
  record(instance, values, outputs);
  const std::vector<std::byte> bytes = device->read(outputs[0]);
  ASSERT_EQ(bytes.size(), kWidth * kHeight * sizeof(float));
  float first = 0;
  std::memcpy(&first, bytes.data(), sizeof first);
  EXPECT_EQ(first, 0.75f);
  record(instance, values, std::vector<gpu::Texture>(1));
  EXPECT_TRUE(null->recorded().empty());
}

// --- Failing effects -----------------------------------------------------------------------------

struct Failing {
  const char* key;
  const char* words;  // part of the error's detail
};

TEST_F(InstanceTest, FailuresInCreateGiveTheReason) {
  for (const Failing& failing :
       {Failing{"throws_in_create", "no luck in create"}, Failing{"refused_in_create", "E1105"},
        Failing{"says_nothing", "no reason"}}) {
    SCOPED_TRACE(failing.key);
    try {
      Instance instance(*device, registry.find(failing.key));
      ADD_FAILURE() << "the instance was created";
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), ErrorId::kEffectCreate);
      EXPECT_NE(error.detail().find(failing.key), std::string::npos) << error.what();
      EXPECT_NE(error.detail().find(failing.words), std::string::npos) << error.what();
    }
  }
}

TEST_F(InstanceTest, FailuresInRecordGiveTheReasonAndTheInstanceGoesOn) {
  const std::vector<gpu::Texture> outputs(1);
  for (const Failing& failing :
       {Failing{"throws_in_record", "not a std::exception"},
        Failing{"fails_at_times", "an even frame"}, Failing{"forgets_bindings", "E1205"},
        Failing{"dispatches_outside", "E1204"}, Failing{"nests_passes", "E1203"},
        Failing{"writes_attachment", "read-only"}, Failing{"leaves_pass_open", "left a pass open"},
        Failing{"ends_no_pass", "E1203"}, Failing{"wrong_size", "struct_size"},
        Failing{"zero_size", "struct_size"}, Failing{"null_data", "null"},
        Failing{"destroys_foreign", "does not own"},
        Failing{"uses_destroyed", "not this effect's"}}) {
    SCOPED_TRACE(failing.key);
    const Effect& effect = registry.find(failing.key);
    const Values values(effect);
    Instance instance(*device, effect);
    for (int frame = 0; frame < 4; ++frame) {
      const bool fails = effect.desc->key != std::string_view("fails_at_times") || frame % 2 == 0;
      try {
        record(instance, values, outputs);
        EXPECT_FALSE(fails) << "the effect recorded";
      } catch (const Error& error) {
        EXPECT_TRUE(fails);
        EXPECT_EQ(error.id(), ErrorId::kEffectRecord);
        EXPECT_NE(error.detail().find(failing.key), std::string::npos) << error.what();
        EXPECT_NE(error.detail().find(failing.words), std::string::npos) << error.what();
        // When an exception leaves a pass open, the C++ wrapper ends the pass.
        EXPECT_EQ(error.detail().find("left a pass open") != std::string::npos,
                  failing.key == std::string_view("leaves_pass_open"));
      }
      // Every pass that has begun has ended.
      const auto passes = recorded<gpu::RecordedPass>();
      EXPECT_EQ(std::ranges::count(passes, true, &gpu::RecordedPass::begins) * 2,
                static_cast<ptrdiff_t>(passes.size()));
    }
  }
}

TEST(Formats, EveryNumberOfTheInterfaceHasOne) {
  for (uint32_t format = GRISAILLE_FORMAT_R8; format <= GRISAILLE_FORMAT_R32UI; ++format) {
    EXPECT_NE(formatOf(format), gpu::Format::kNone) << format;
  }
  EXPECT_EQ(formatOf(0), gpu::Format::kNone);
  EXPECT_EQ(formatOf(9), gpu::Format::kNone);
  EXPECT_STREQ(gpu::formatInfo(formatOf(GRISAILLE_FORMAT_RGBA16F)).name, "rgba16f");
}

}  // namespace
}  // namespace grisaille::effect
