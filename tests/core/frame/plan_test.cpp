// SPDX-License-Identifier: MIT
// The renderer draws, allocates and records only what the wanted outputs need. Runs on the null
// device.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/frame/renderer.h"
#include "core/gpu/checking_device.h"
#include "core/gpu/null_device.h"
#include "tests/support/expect_error.h"
#include "tests/support/scenes.h"

namespace grisaille {
namespace {

struct Recording {
  std::vector<std::string> passes;
  std::vector<gpu::RecordedRender> renders;
  size_t dispatches = 0;
};

class PlanTest : public ::testing::Test {
 protected:
  using Labels = std::vector<std::string>;

  void SetUp() override {
    registry_.scan(EFFECTS_FOLDER);
    registry_.scan(TELLER_FOLDER);
    auto null = gpu::makeNullDevice();
    null_ = null.get();
    device_ = gpu::makeCheckingDevice(
        std::move(null), [](gpu::Severity, std::string_view text) { ADD_FAILURE() << text; });
    chain_.selection = effect::Selection(registry_, Labels{"ssao"});
    values_ = &chain_.selection.values("ssao");
    values_->set("guard_band", "0");
    values_->set("backs", "assumed");
    values_->set("edge_denoise", "6");
    chain_.start(*device_);
    renderer_.emplace(*device_, scene_);
  }
  void TearDown() override {
    renderer_.reset();
    chain_.stop();
    device_.reset();
  }

  Recording record(const std::vector<std::string>& outputs, bool withSsao,
                   frame::Surface surface = frame::Surface::kWhite) {
    renderer_->render({.camera = camera_,
                       .width = 64,
                       .height = 32,
                       .surface = surface,
                       .chain = withSsao ? &chain_ : nullptr,
                       .outputs = outputs});
    Recording recording;
    for (const gpu::Recorded& entry : null_->recorded()) {
      if (const auto* pass = std::get_if<gpu::RecordedPass>(&entry);
          pass != nullptr && pass->begins) {
        recording.passes.push_back(pass->label);
      } else if (const auto* render = std::get_if<gpu::RecordedRender>(&entry)) {
        recording.renders.push_back(*render);
      } else if (std::holds_alternative<gpu::RecordedDispatch>(entry)) {
        ++recording.dispatches;
      }
    }
    return recording;
  }

  scene::Scene scene_ = tests::cornerScene();
  scene::Camera camera_ = {.eye = glm::dvec3(0, 1, 3), .target = glm::dvec3(0, 0.5, 0)};
  effect::Registry registry_;
  gpu::NullDevice* null_ = nullptr;
  std::unique_ptr<gpu::Device> device_;
  effect::Chain chain_;
  effect::Values* values_ = nullptr;  // of ssao
  std::optional<frame::Renderer> renderer_;
};

TEST_F(PlanTest, ColorAloneDrawsDepthToFindTheBackground) {
  const Recording recording = record({"color"}, false);
  EXPECT_EQ(recording.passes, (Labels{"scene/geometry", "compose/color"}));
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, Labels{"clip depth"});
}

TEST_F(PlanTest, ColorReadsTheDepthThatAGuardedEffectDraws) {
  values_->set("guard_band", "0.1");
  const Recording recording = record({"color"}, true);
  EXPECT_EQ(recording.passes.front(), "scene/guarded geometry");
  EXPECT_EQ(std::ranges::count_if(
                recording.passes,
                [](const std::string& pass) { return pass.find("geometry") != std::string::npos; }),
            1);
}

TEST_F(PlanTest, DepthDrawsDepthAlone) {
  const Recording recording = record({"depth"}, true);
  EXPECT_EQ(recording.passes, (Labels{"scene/geometry", "scene/view_depth"}));
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, Labels{"clip depth"});
}

TEST_F(PlanTest, NormalNeedsNoViewDepth) {
  const Recording recording = record({"normal"}, false);
  EXPECT_EQ(recording.passes, Labels{"scene/geometry"});
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, (Labels{"normal", "clip depth"}));
}

TEST_F(PlanTest, AoReadsDepthAndNormalButNoColour) {
  values_->set("estimator", "classic");
  const Recording recording = record({"ao"}, true);
  EXPECT_EQ(recording.passes,
            (Labels{"scene/geometry", "scene/view_depth", "ssao/occlusion", "ssao/blur"}));
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, (Labels{"normal", "clip depth"}));
}

TEST_F(PlanTest, SphereSamplingReadsNoNormal) {
  values_->set("estimator", "classic");
  values_->set("sampling", "sphere");
  const Recording recording = record({"ssao.ao"}, true);
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, Labels{"clip depth"});
}

TEST_F(PlanTest, NoBlurRecordsNoBlurPass) {
  values_->set("estimator", "classic");
  for (const char* size : {"0", "1"}) {
    values_->set("blur_size", size);
    EXPECT_EQ(record({"ao"}, true).passes,
              (Labels{"scene/geometry", "scene/view_depth", "ssao/occlusion"}));
  }
}

TEST_F(PlanTest, SlicesRecordWhatTheirResolutionAndBlurNeed) {
  values_->set("refine", "nothing");
  const auto passes = [&](const char* resolution, const char* blur) {
    values_->set("resolution", resolution);
    values_->set("blur_size", blur);
    const Recording recording = record({"ao"}, true);
    EXPECT_EQ(recording.renders.at(0).targets, (Labels{"normal", "clip depth"}));
    return Labels(recording.passes.begin() + 2, recording.passes.end());
  };
  EXPECT_EQ(passes("full", "1"), (Labels{"ssao/occlusion", "ssao/denoise columns"}));
  EXPECT_EQ(passes("full", "5"), (Labels{"ssao/occlusion", "ssao/denoise rows",
                                         "ssao/denoise columns", "ssao/denoise edges"}));
  for (const char* coarse : {"half", "quarter"}) {
    EXPECT_EQ(passes(coarse, "0"), (Labels{"ssao/occlusion", "ssao/upsample"}));
    EXPECT_EQ(passes(coarse, coarse == std::string("half") ? "2" : "4"),
              (Labels{"ssao/occlusion", "ssao/upsample"}));
    EXPECT_EQ(passes(coarse, "10"),
              (Labels{"ssao/occlusion", "ssao/denoise rows", "ssao/denoise columns",
                      "ssao/denoise edges", "ssao/upsample"}));
  }
  values_->set("edge_denoise", "0");
  EXPECT_EQ(passes("full", "5"),
            (Labels{"ssao/occlusion", "ssao/denoise rows", "ssao/denoise columns"}));
  EXPECT_EQ(passes("half", "5"), (Labels{"ssao/occlusion", "ssao/denoise rows",
                                         "ssao/denoise columns", "ssao/upsample"}));
}

TEST_F(PlanTest, TheThicknessOfBodiesIsDrawnWithTheRest) {
  values_->set("backs", "bodies");
  const Recording recording = record({"ao"}, true);
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, (Labels{"normal", "thickness", "clip depth"}));
}

TEST_F(PlanTest, HistoryOpenDirectionsAndTintCostNothingUnlessAskedFor) {
  const Labels scene = {"scene/geometry", "scene/view_depth"};
  const auto passes = [&](const Labels& outputs, frame::Surface surface = frame::Surface::kWhite) {
    const Recording recording = record(outputs, true, surface);
    return Labels(recording.passes.begin() + 2, recording.passes.end());
  };
  values_->set("resolution", "full");
  values_->set("blur_size", "0");
  const Labels visibility = {"ssao/occlusion", "ssao/denoise columns"};
  const Labels tinted = {"ssao/occlusion", "ssao/denoise columns", "ssao/tint"};
  EXPECT_EQ(passes({"bent_normal"}), visibility);
  EXPECT_EQ(passes({"tint"}), tinted);
  values_->set("history", "8");
  EXPECT_EQ(passes({"ao"}), (Labels{"scene/motion", "ssao/occlusion", "ssao/movement",
                                    "ssao/accumulate", "ssao/finish"}));
  values_->set("history", "1");
  EXPECT_EQ(passes({"ao"}), visibility);

  // A tint by base colour draws the base colours.
  values_->set("bounce", "base_colour");
  EXPECT_EQ(record({"ao"}, true).renders.at(0).targets, (Labels{"normal", "clip depth"}));
  EXPECT_EQ(record({"tint"}, true).renders.at(0).targets,
            (Labels{"normal", "base_colour", "clip depth"}));
  // A picture that shows base colours composes tints.
  EXPECT_EQ(passes({"color"}), (Labels{"ssao/occlusion", "ssao/denoise columns", "compose/color"}));
  EXPECT_EQ(passes({"color"}, frame::Surface::kBaseColour),
            (Labels{"ssao/occlusion", "ssao/denoise columns", "ssao/tint", "compose/color"}));

  // Only the slices estimator has open directions; they need normals.
  values_->set("estimator", "classic");
  values_->set("sampling", "sphere");
  EXPECT_EQ(passes({"bent_normal"}), visibility);
  EXPECT_EQ(record({"bent_normal"}, true).renders.at(0).targets, (Labels{"normal", "clip depth"}));
  EXPECT_EQ(record({"ao"}, true).renders.at(0).targets, Labels{"clip depth"});
}

// Drawing back faces, and the extra area of a guard band, count as cost of the effects.
TEST_F(PlanTest, WhatIsDrawnForEffectsAloneIsTheirCost) {
  values_->set("guard_band", "0.25");
  values_->set("backs", "drawn");
  const Recording recording = record({"ao"}, true);
  double sum = 0;
  for (const std::string& pass : recording.passes) sum += frame::shareForEffects(pass, 0.25);
  EXPECT_EQ(sum, 2.5);  // geometry, view depth, back geometry, back view depth
  for (const char* pass : {"scene/geometry", "scene/view_depth", "ssao/back geometry", "back "}) {
    EXPECT_EQ(frame::shareForEffects(pass, 0.25), 0) << pass;
  }
  EXPECT_EQ(recording.renders.at(1).targets, (Labels{"back"}));
  values_->set("backs", "peeled");
  sum = 0;
  for (const std::string& pass : record({"ao"}, true).passes) {
    sum += frame::shareForEffects(pass, 0.25);
  }
  EXPECT_EQ(sum, 4.5);  // next geometry and next view depth as well
}

// Attachments of an effect with a guard band are larger. Other effects read attachments of the
// picture's size.
TEST_F(PlanTest, AGuardBandDrawsLargerAttachmentsForItsEffectAlone) {
  values_->set("guard_band", "0.25");
  const Recording alone = record({"ao"}, true);
  ASSERT_EQ(alone.renders.size(), 1u);
  EXPECT_EQ(alone.renders[0].targets, (Labels{"guarded normal", "guarded clip depth"}));
  const Recording both = record({"ao", "normal"}, true);
  ASSERT_EQ(both.renders.size(), 2u);
  EXPECT_EQ(both.renders[0].targets, (Labels{"normal", "clip depth"}));
  EXPECT_EQ(both.renders[1].targets, (Labels{"guarded normal", "guarded clip depth"}));
  // The classic estimator has no guard band.
  values_->set("estimator", "classic");
  EXPECT_EQ(record({"ao"}, true).renders.at(0).targets, (Labels{"normal", "clip depth"}));
}

TEST_F(PlanTest, BaseColourIsDrawnForTheBaseSurfaceAlone) {
  EXPECT_EQ(record({"color"}, false).renders.at(0).targets, Labels{"clip depth"});
  const Recording recording = record({"color"}, false, frame::Surface::kBaseColour);
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets, (Labels{"base_colour", "clip depth"}));
}

TEST_F(PlanTest, FacetNormalsAreDrawnInTheSamePassWhenAskedForAlone) {
  EXPECT_EQ(record({"facet_normal"}, false).renders.at(0).targets,
            (Labels{"facet_normal", "clip depth"}));
  const Recording recording =
      record({"facet_normal", "normal", "base_colour", "depth"}, true, frame::Surface::kBaseColour);
  EXPECT_EQ(recording.passes, (Labels{"scene/geometry", "scene/view_depth"}));
  ASSERT_EQ(recording.renders.size(), 1u);
  EXPECT_EQ(recording.renders[0].targets,
            (Labels{"normal", "base_colour", "facet_normal", "clip depth"}));
}

TEST_F(PlanTest, BackFacesAreDrawnWhenAskedForAlone) {
  const Recording plain = record({"depth", "ao"}, true);
  EXPECT_EQ(plain.renders.size(), 1u);
  const Recording recording = record({"back_depth"}, false);
  EXPECT_EQ(recording.passes,
            (Labels{"scene/geometry", "scene/back geometry", "scene/back view_depth"}));
  ASSERT_EQ(recording.renders.size(), 2u);
  EXPECT_EQ(recording.renders[0].targets, (Labels{"clip depth"}));
  EXPECT_EQ(recording.renders[1].targets, (Labels{"back"}));
}

// The next surface needs the back's clip depth, but not its view depth.
TEST_F(PlanTest, WhatLiesBehindBacksIsDrawnWhenAskedForAlone) {
  const Recording recording = record({"next_depth"}, false);
  EXPECT_EQ(recording.passes, (Labels{"scene/geometry", "scene/back geometry",
                                      "scene/next geometry", "scene/next view_depth"}));
  ASSERT_EQ(recording.renders.size(), 3u);
  EXPECT_EQ(recording.renders[1].targets, (Labels{"back"}));
  EXPECT_EQ(recording.renders[2].targets, (Labels{"next"}));
}

// A scene that rests takes one triangle for its motion; only instances that moved are drawn again.
TEST_F(PlanTest, MotionIsDrawnWhenAskedForAlone) {
  EXPECT_EQ(record({"depth", "ao"}, true).renders.size(), 1u);
  record({"motion"}, false);
  const Recording resting = record({"motion"}, false);
  EXPECT_EQ(resting.passes, (Labels{"scene/geometry", "scene/motion"}));
  ASSERT_EQ(resting.renders.size(), 2u);
  EXPECT_EQ(resting.renders[1].draws, 1u);
  scene_.instances.back().worldFromObject[3].x += 0.1;
  ++scene_.poses;
  const Recording moving = record({"motion"}, false);
  ASSERT_EQ(moving.renders.size(), 3u);
  EXPECT_EQ(moving.renders[2].targets, Labels{"motion"});
  EXPECT_EQ(moving.renders[2].draws, 1u);
  EXPECT_EQ(record({"motion"}, false).renders.size(), 2u);
}

TEST_F(PlanTest, ObjectsReachTheEffectsAndWhatWaitsComesBack) {
  effect::Chain chain{effect::Selection(registry_, Labels{"teller", "ssao"})};
  const effect::StartedChain started(chain, *device_);
  chain.selection.set(effect::Assignment{{"teller", "waits"}, "4"});
  objects::ObjectList& list = *chain.objects("teller");
  const auto add = [&](size_t count) {
    for (size_t i = 0; i < count; ++i) list.add(objects::Object(list.table()));
  };
  const auto told = [&](const Labels& outputs) {
    renderer_->render({.camera = camera_,
                       .width = 16,
                       .height = 8,
                       .chain = &chain,
                       .outputs = outputs,
                       .patience = 0.5});
    return outputs[0] == "told" ? renderer_->read("told").pixels : std::vector<float>();
  };
  add(20);
  std::vector<float> texels = told({"told", "ao"});
  EXPECT_EQ(texels[0], 20);
  EXPECT_EQ(texels[1], 0);  // the effect's first frame
  EXPECT_EQ(texels[2], 0.5f);
  EXPECT_EQ(renderer_->report().waiting, 4u);
  list.undo();
  EXPECT_EQ(told({"told"})[1], 19);
  // A frame that failed, or that did not run the effect, does not count as its previous frame.
  list.remove(11);
  told({"depth"});
  EXPECT_EQ(renderer_->report().waiting, 0u);
  add(1);
  EXPECT_ERROR(ErrorId::kOutputUnknown, told({"nothing"}));
  EXPECT_EQ(told({"told"})[1], 11);
  EXPECT_EQ(told({"told"})[1], 19);
  // Neither does a frame with the effect off while others run.
  chain.selection.find("teller")->on = false;
  list.remove(3);
  told({"ao"});
  EXPECT_ERROR(ErrorId::kOutputUnknown, told({"told"}));
  chain.selection.find("teller")->on = true;
  EXPECT_EQ(told({"told"})[1], 3);
}

// Scene and effects upload once. If a later effect fails, the next frame still has what the others
// uploaded in the failed frame.
TEST_F(PlanTest, AnEffectThatFailsTakesNoUploadsAlong) {
  effect::Chain chain{effect::Selection(registry_, Labels{"ssao", "teller"})};
  const effect::StartedChain started(chain, *device_);
  const auto render = [&] {
    renderer_->render({.camera = camera_,
                       .width = 16,
                       .height = 8,
                       .chain = &chain,
                       .outputs = Labels{"ao", "told"}});
  };
  chain.selection.set(effect::Assignment{{"teller", "fails"}, "true"});
  EXPECT_ERROR(ErrorId::kEffectRecord, render());
  chain.selection.set(effect::Assignment{{"teller", "fails"}, "false"});
  render();
}

TEST_F(PlanTest, EffectsRunInTheOrderOfTheSelection) {
  effect::Chain chain{effect::Selection(registry_, Labels{"ssao", "teller"})};
  const effect::StartedChain started(chain, *device_);
  EXPECT_EQ(frame::outputNames(chain.selection.effects()).back(), "teller.told");
  chain.selection.move(1, 0);
  EXPECT_NE(frame::outputNames(chain.selection.effects()).back(), "teller.told");
}

TEST_F(PlanTest, WhatIsBehindTheCameraIsNotDrawn) {
  camera_ = {.eye = glm::dvec3(0, 1, 100), .target = glm::dvec3(0, 1, 200)};
  EXPECT_EQ(record({"depth"}, false).renders.at(0).draws, 0u);
}

TEST_F(PlanTest, UnknownOutputIsAnErrorAndTheNextFrameWorks) {
  EXPECT_ERROR(ErrorId::kOutputUnknown, record({"oa"}, true));
  EXPECT_ERROR(ErrorId::kOutputUnknown, record({"ao"}, false));
  EXPECT_EQ(record({"color"}, false).passes.size(), 2u);
  EXPECT_ERROR(ErrorId::kOutputUnknown, renderer_->read("ao"));
}

TEST_F(PlanTest, BadCameraIsAnErrorAndTheNextFrameWorks) {
  const scene::Camera good = camera_;
  camera_.target = camera_.eye;
  EXPECT_ERROR(ErrorId::kCameraInvalid, record({"ao"}, true));
  camera_ = good;
  EXPECT_EQ(record({"ao"}, true).passes.size(), 9u);
}

}  // namespace
}  // namespace grisaille
