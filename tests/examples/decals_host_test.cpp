// SPDX-License-Identifier: MIT
// The example of an effect with objects in hosts of the library. The hosts hand over the objects
// and decode the pictures.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "examples/decals/tables.h"
#include "tests/examples/built.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kSide = 48;

// Returns four squares for every path; counts its calls in `asked`.
grisaille_result readSquares(void* asked, const char*, grisaille_picture* out) {
  static const image::Image8 kPicture = squares({kRed, kGreen, kBlue, kGrey});
  ++*static_cast<int*>(asked);
  out->width = kPicture.width;
  out->height = kPicture.height;
  out->rgba = kPicture.pixels.data();
  return GRISAILLE_OK;
}

class DecalsHost : public ::testing::TestWithParam<TestDevice> {
 protected:
  void SetUp() override { GRISAILLE_NEEDS_INSTALLATION(); }

  // Renders from 2 m above an endless floor, straight down at `eye`; up is -z.
  std::vector<float> record(Host& host, host::Device& device, host::Effect& effect,
                            const glm::dvec3& eye) {
    const glm::dmat4 view = glm::lookAt(eye, eye - glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1));
    const glm::dmat4 projection = projectionOf({.angle = 0.6}, 1, {.near = 0.1});
    const host::Texture depth = host.texture(device, Texels::kFloat1, kSide, kSide,
                                             std::vector<float>(size_t{kSide} * kSide, 2.0f));
    host.frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = host::Camera(&view[0][0], &projection[0][0]),
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
    });
    return host.read(effect.output("decals"));
  }
  static void expectColour(const std::vector<float>& texels, uint32_t x, uint32_t y,
                           const Colour& colour) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(texels[4 * (y * kSide + x) + c], linear(colour[c]), 0.002) << x << ", " << y;
    }
  }
  static decals::Decal decalAt(const glm::dvec3& place) {
    return {.position = {place.x, place.y, place.z},
            .direction = {0, 1, 0},
            .size = 0.8,
            .height = 0,
            .depth = 0.2,
            .angle = 0,
            .opacity = 1,
            .order = 0,
            .picture = "any.png",
            .name = ""};
  }
};
GRISAILLE_IN_EVERY_HOST(DecalsHost);

TEST_P(DecalsHost, DrawsTheObjectsThatItIsHanded) {
  const std::unique_ptr<Host> host = makeHost(GetParam());
  host::Device device = host->device(builtExample("decals").c_str());
  int asked = 0;
  device.setPictures(readSquares, &asked);
  host::Effect effect(device, {.effect = "decals", .width = kSide, .height = kSide});
  const glm::dvec3 eye(0.5, 2, 0.3), floor(0.5, 0, 0.3);
  for (const float value : record(*host, device, effect, eye)) EXPECT_EQ(value, 0);
  effect.setObjects<decals::Decal>(std::vector{decalAt(floor)});
  const std::vector<float> drawn = record(*host, device, effect, eye);
  expectColour(drawn, 20, 20, kRed);
  expectColour(drawn, 28, 20, kGreen);
  expectColour(drawn, 20, 28, kBlue);
  expectColour(drawn, 28, 28, kGrey);
  EXPECT_EQ(drawn[3], 0);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(record(*host, device, effect, eye), drawn);
  EXPECT_EQ(asked, 1) << "pictures are read when their paths change";

  host::Effect loaded(device, {.effect = "decals", .width = kSide, .height = kSide});
  const TemporaryFolder folder;
  loaded.loadObjects(folder
                         .write("d.json", R"({"version": 1, "decals": [{"position": [0.5, 0, 0.3],
                                "size": 0.8, "depth": 0.2, "picture": "any.png"}]})")
                         .c_str());
  EXPECT_EQ(record(*host, device, loaded, eye), drawn);

  // Without a picture reader, the effect draws a placeholder square.
  device.setPictures(nullptr, nullptr);
  host::Effect plain(device, {.effect = "decals", .width = kSide, .height = kSide});
  plain.setObjects<decals::Decal>(std::vector{decalAt(floor)});
  expectColour(record(*host, device, plain, eye), 20, 24, {204, 0, 204, 255});
  EXPECT_EQ(host->complaints(), 0);
}

TEST_P(DecalsHost, FarFromTheOriginTheyAreAsSharp) {
  const std::unique_ptr<Host> host = makeHost(GetParam());
  host::Device device = host->device(builtExample("decals").c_str());
  int asked = 0;
  device.setPictures(readSquares, &asked);
  host::Effect effect(device, {.effect = "decals", .width = kSide, .height = kSide});
  std::vector<std::vector<float>> drawn;
  for (const double far : {0.0, 4.0e6}) {
    const glm::dvec3 floor(far, 0, -far);
    effect.setObjects<decals::Decal>(std::vector{decalAt(floor)});
    drawn.push_back(record(*host, device, effect, floor + glm::dvec3(0, 2, 0)));
  }
  for (size_t i = 0; i < drawn[0].size(); ++i) EXPECT_NEAR(drawn[0][i], drawn[1][i], 0.001) << i;
}

}  // namespace
}  // namespace grisaille::tests
