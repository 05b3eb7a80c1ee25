// SPDX-License-Identifier: MIT
// Attachments read from pictures: kinds of depth and missing normals. On every backend, a frame
// from its own pictures equals the original frame.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/effect/registry.h"
#include "core/frame/picture_attachments.h"
#include "core/frame/picture_depth.h"
#include "core/frame/renderer.h"
#include "core/scene/view.h"
#include "tests/support/devices.h"
#include "tests/support/expect_error.h"

namespace grisaille::frame {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

image::Image row(std::vector<float> values) {
  const auto width = static_cast<uint32_t>(values.size());
  return {.width = width, .height = 1, .channels = 1, .pixels = std::move(values)};
}

std::vector<float> metres(std::vector<float> values, const DepthMeaning& meaning) {
  return viewDepthOf(row(std::move(values)), meaning, scene::Camera{}, "test").pixels;
}

TEST(PictureDepth, MetresAlongTheViewStayAndTheSkyIsZero) {
  EXPECT_EQ(metres({0, 0.5, 3, 1e10f, kInfinity}, {.kind = DepthKind::kView}),
            (std::vector<float>{0, 0.5, 3, 0, 0}));
  EXPECT_EQ(metres({0.5, 9, 10}, {.kind = DepthKind::kView, .far = 10}),
            (std::vector<float>{0.5, 9, 0}));
}

// Compared with the projection itself, for near and far planes of any size.
TEST(PictureDepth, DepthBuffersComeBackToTheDepthsThatTheyWereMadeOf) {
  for (const double near : {0.01, 0.1, 2.0}) {
    for (const double far : {5.0, 1000.0, std::numeric_limits<double>::infinity()}) {
      for (const double depth : {near, 1.5 * near, 2 * near + 0.3, 4.9}) {
        if (depth > far) continue;
        const double reversed =
            std::isinf(far) ? near / depth : near * (far - depth) / (depth * (far - near));
        const auto back = [&](DepthKind kind, double value) {
          return double{metres({static_cast<float>(value)}, {kind, near, far})[0]};
        };
        EXPECT_NEAR(back(DepthKind::kClipReversed, reversed) / depth, 1, 1e-4);
        // Unreversed, a float has few digits left at a distance. That is the input's own error.
        const double kept = 1 - double{static_cast<float>(1 - reversed)};
        const double expected =
            std::isinf(far) ? near / kept : near * far / (near + kept * (far - near));
        EXPECT_NEAR(back(DepthKind::kClip, 1 - reversed) / expected, 1, 1e-6);
      }
      EXPECT_EQ(metres({0}, {DepthKind::kClipReversed, near, far})[0], 0);
      EXPECT_EQ(metres({1}, {DepthKind::kClip, near, far})[0], 0);
    }
  }
}

TEST(PictureDepth, DistancesAreFromTheEye) {
  const scene::Camera camera{.fovyDegrees = 77};
  image::Image distance{.width = 13, .height = 7, .channels = 1, .pixels = {}};
  for (uint32_t y = 0; y < 7; ++y) {
    for (uint32_t x = 0; x < 13; ++x) {
      distance.pixels.push_back(static_cast<float>(
          3 *
          glm::length(scene::rayAt(scene::viewOf(camera, {13, 7}), {x + 0.5, y + 0.5}).direction)));
    }
  }
  const image::Image depth = viewDepthOf(distance, {.kind = DepthKind::kDistance}, camera, "test");
  for (const float value : depth.pixels) EXPECT_NEAR(value, 3, 1e-6);
}

TEST(PictureDepth, WhatIsNoDepthIsRefusedWithItsPixel) {
  for (const float value : {kNan, -1.0f, -kInfinity}) {
    EXPECT_ERROR(ErrorId::kPictureDepth, metres({1, value}, {.kind = DepthKind::kView}));
    EXPECT_ERROR(ErrorId::kPictureDepth, metres({1, value}, {.kind = DepthKind::kClip}));
  }
  EXPECT_ERROR(ErrorId::kPictureDepth, metres({1.5}, {.kind = DepthKind::kClipReversed}));
  try {
    metres({1, 2, kNan}, {.kind = DepthKind::kView});
  } catch (const Error& error) {
    EXPECT_NE(error.detail().find("test: the depth at (2, 0) is nan"), std::string::npos);
  }
}

// A plane dot(normal, p) = distance in view space. depthOf() gives the view depth of the nearest
// plane.
struct Plane {
  glm::dvec3 normal;
  double distance;
};
image::Image depthOf(const std::vector<Plane>& planes, const scene::Camera& camera, uint32_t width,
                     uint32_t height, std::vector<size_t>* seen = nullptr) {
  image::Image depth{.width = width, .height = height, .channels = 1, .pixels = {}};
  const glm::dmat3 viewFromWorld = glm::transpose(scene::worldFromView(camera));
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const glm::dvec3 ray =
          viewFromWorld *
          scene::rayAt(scene::viewOf(camera, {width, height}), {x + 0.5, y + 0.5}).direction;
      double nearest = 1e9;
      size_t which = planes.size();
      for (size_t i = 0; i < planes.size(); ++i) {
        const double t = planes[i].distance / glm::dot(planes[i].normal, ray);
        if (t > 0 && t < nearest) nearest = t, which = i;
      }
      depth.pixels.push_back(which < planes.size() ? static_cast<float>(nearest) : 0.0f);
      if (seen != nullptr) seen->push_back(which);
    }
  }
  return depth;
}

class FacetNormals : public tests::BackendTest {
 protected:
  image::Image facetNormals(const image::Image& depth, const scene::Camera& camera) {
    PictureAttachments source(&device());
    source.show({depth, {}, {}});
    Renderer renderer(device(), source);
    const std::vector<std::string> outputs = {"facet_normal"};
    renderer.render(
        {.camera = camera, .width = depth.width, .height = depth.height, .outputs = outputs});
    return renderer.read("facet_normal");
  }
};
GRISAILLE_ON_EVERY_DEVICE(FacetNormals);

TEST_P(FacetNormals, PlanesHaveTheirOwnNormalUpToTheEdges) {
  const scene::Camera camera{
      .eye = {3, 2, 1}, .target = {1, 0.5, -4}, .up = {0.1, 1, 0}, .fovyDegrees = 70};
  // Two walls that meet in a corner, and a plane in front of them.
  const std::vector<Plane> planes = {{glm::normalize(glm::dvec3(0.8, 0.1, 1)), -6},
                                     {glm::normalize(glm::dvec3(-0.9, 0.2, 1)), -5},
                                     {glm::normalize(glm::dvec3(0.1, 2.5, 1)), -3}};
  std::vector<size_t> seen;
  const image::Image depth = depthOf(planes, camera, 61, 43, &seen);
  const image::Image normals = facetNormals(depth, camera);
  const glm::dmat3 axes = scene::worldFromView(camera);
  size_t counts[3] = {};
  for (uint32_t y = 0; y < 43; ++y) {
    for (uint32_t x = 0; x < 61; ++x) {
      const size_t which = seen[y * 61 + x];
      if (which == planes.size()) continue;
      const glm::dvec3 normal(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2));
      const glm::dvec3 expected = axes * planes[which].normal;
      EXPECT_NEAR(glm::length(normal), 1, 1e-3);
      // A pixel between two edges has no second neighbour on its own plane.
      const bool corner = counts[which]++ > 0 && std::abs(glm::dot(normal, expected)) < 0.999;
      const auto at = [&](int dx, int dy) {
        const int px = int(x) + dx, py = int(y) + dy;
        return px >= 0 && py >= 0 && px < 61 && py < 43 &&
               seen[size_t(py) * 61 + size_t(px)] == which;
      };
      const bool wide = (at(1, 0) && at(2, 0)) || (at(-1, 0) && at(-2, 0));
      const bool high = (at(0, 1) && at(0, 2)) || (at(0, -1) && at(0, -2));
      EXPECT_FALSE(corner && wide && high) << x << " " << y << " of plane " << which;
    }
  }
  for (const size_t count : counts) EXPECT_GT(count, 100u);
}

TEST_P(FacetNormals, SkyAndLonePixelsHaveNone) {
  const scene::Camera camera;
  for (const image::Image& depth : {row({3}), row({0, 0, 0}), row({0, 2, 0})}) {
    for (const float value : facetNormals(depth, camera).pixels) EXPECT_EQ(value, 0);
  }
}

TEST(Pictures, OddOnesAreRefused) {
  const auto of = [](uint32_t width, uint32_t channels, float value) {
    return image::Image{.width = width,
                        .height = 2,
                        .channels = channels,
                        .pixels = std::vector<float>(size_t{2} * width * channels, value)};
  };
  PictureAttachments source;
  EXPECT_ERROR(ErrorId::kPictureSize, source.show({of(4, 1, 1), of(5, 3, 0), {}}));
  EXPECT_ERROR(ErrorId::kPictureSize, source.show({of(4, 1, 1), {}, of(3, 3, 0)}));
  EXPECT_ERROR(ErrorId::kPictureDepth, source.show({of(4, 1, 1), of(4, 3, kNan), {}}));
  EXPECT_ERROR(ErrorId::kPictureDepth, source.show({of(4, 1, 1), of(4, 3, kInfinity), {}}));
  source.show({of(4, 1, 1), of(4, 3, 0.5), of(4, 3, 2)});
  EXPECT_EQ(source.width(), 4u);
  EXPECT_EQ(source.height(), 2u);
}

class PictureFrames : public tests::BackendTest {
 protected:
  const scene::Camera camera_ = scene::atriumCamera();
  const std::vector<std::string> outputs_ = {"depth", "normal", "base_colour", "ao"};

  // Renders one frame of ambient occlusion with this estimator; returns its outputs.
  std::vector<image::Image> render(Renderer& renderer, const std::string& estimator, uint32_t width,
                                   uint32_t height, double guardBand = 0) {
    const std::string effects[] = {"ssao"};
    effect::Chain chain{effect::Selection(registry_, effects)};
    chain.selection.values("ssao").set("estimator", estimator);
    chain.selection.values("ssao").set("guard_band", guardBand);
    chain.selection.values("ssao").set("backs", "assumed");  // pictures know no thickness
    const effect::StartedChain started(chain, device());
    renderer.render({.camera = camera_,
                     .width = width,
                     .height = height,
                     .surface = Surface::kBaseColour,
                     .chain = &chain,
                     .outputs = outputs_});
    std::vector<image::Image> images;
    for (const std::string& output : outputs_) images.push_back(renderer.read(output));
    return images;
  }

  void SetUp() override {
    BackendTest::SetUp();
    if (!HasFatalFailure() && !IsSkipped()) registry_.load(EFFECTS_FOLDER "/ssao.so");
  }

  effect::Registry registry_;
};
GRISAILLE_ON_EVERY_DEVICE(PictureFrames);

TEST_P(PictureFrames, AFrameFromItsOwnPicturesIsTheFrame) {
  const scene::Scene atrium = scene::makeAtrium();
  Renderer scene(device(), atrium);
  PictureAttachments source;
  Renderer pictures(device(), source);
  for (const auto& [width, height] : {std::pair(161u, 91u), std::pair(64u, 97u)}) {
    for (const char* estimator : {"slices", "classic"}) {
      const auto drawn = render(scene, estimator, width, height);
      source.show({drawn[0], drawn[1], drawn[2]});
      const auto again = render(pictures, estimator, width, height);
      EXPECT_EQ(drawn[0].pixels, again[0].pixels);
      EXPECT_EQ(drawn[1].pixels, again[1].pixels);
      EXPECT_EQ(image::shareOver(drawn[2], again[2], 1.0 / 255), 0) << width << estimator;
      EXPECT_EQ(image::shareOver(drawn[3], again[3], 1.0 / 255), 0) << width << estimator;
      EXPECT_LT(
          image::compare(drawn[3], image::Image{width, height, 1,
                                                std::vector<float>(size_t{width} * height, 1.0f)})
              .bias,
          -0.02);
    }
  }
}

// Facets from depth equal the triangles' facets except on smooth-shaded surfaces and on details of
// a few pixels. In a picture this small, more than half of all channels agree.
TEST_P(PictureFrames, NormalsOfTheDepthStandInForThoseThatAreNotThere) {
  const scene::Scene atrium = scene::makeAtrium();
  Renderer scene(device(), atrium);
  const auto drawn = render(scene, "slices", 160, 90);
  PictureAttachments source(&device());
  source.show({drawn[0], {}, drawn[2]});
  Renderer pictures(device(), source);
  const auto again = render(pictures, "slices", 160, 90);
  EXPECT_GT(image::shareOver(drawn[1], again[1], 0.02), 0.0);
  EXPECT_LT(image::shareOver(drawn[1], again[1], 0.02), 0.5);
  EXPECT_LT(image::compare(drawn[3], again[3]).rmse, 0.14);
}

// Pictures have no guard band, even if an effect requests one.
TEST_P(PictureFrames, NothingIsSeenBeyondAPicturesBorder) {
  const scene::Scene atrium = scene::makeAtrium();
  Renderer scene(device(), atrium);
  const auto drawn = render(scene, "slices", 97, 55);
  PictureAttachments source;
  source.show({drawn[0], drawn[1], drawn[2]});
  Renderer pictures(device(), source);
  EXPECT_EQ(render(pictures, "slices", 97, 55, 0.5)[3].pixels, drawn[3].pixels);
  EXPECT_NE(render(scene, "slices", 97, 55, 0.5)[3].pixels, drawn[3].pixels);
}

TEST_P(PictureFrames, WhatNoPictureHasIsMissing) {
  PictureAttachments source;
  source.show({row({1, 2, 3}), {}, {}});
  Renderer renderer(device(), source);
  const std::vector<std::string> outputs = {"base_colour"};
  const FrameDesc desc{.camera = camera_, .width = 3, .height = 1, .outputs = outputs};
  EXPECT_ERROR(ErrorId::kPictureMissing, renderer.render(desc));
  const std::vector<std::string> normal = {"normal"};
  FrameDesc other = desc;
  other.outputs = normal;
  EXPECT_ERROR(ErrorId::kPictureMissing, renderer.render(other));
  other = desc;
  other.width = 4;
  EXPECT_ERROR(ErrorId::kPictureSize, renderer.render(other));
  // The next frame still works.
  const std::vector<std::string> depth = {"depth"};
  other = desc;
  other.outputs = depth;
  renderer.render(other);
  EXPECT_EQ(renderer.read("depth").pixels, (std::vector<float>{1, 2, 3}));
}

}  // namespace
}  // namespace grisaille::frame
