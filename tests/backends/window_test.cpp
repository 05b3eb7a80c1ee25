// SPDX-License-Identifier: MIT
// Pictures in a window: the X server shows the presented picture.
#include "shaders/image_color_comp.h"
#include "tests/backends/windows.h"

namespace grisaille::tests {
namespace {

using Clock = std::chrono::steady_clock;

class Windows : public WindowTest {
 protected:
  // Presents a picture of this size, destroys it, and expects it in a window of this size.
  void showAndSee(uint32_t width, uint32_t height, uint32_t pictureWidth, uint32_t pictureHeight) {
    const gpu::Texture picture = makePicture(device(), pictureWidth, pictureHeight);
    show(picture);
    device().destroy(picture);
    expectPicture(width, height, pictureWidth, pictureHeight);
  }
};
GRISAILLE_ON_EVERY_DEVICE(Windows);

TEST_P(Windows, ShowAPictureUpright) {
  open(301, 203);
  showAndSee(301, 203, 301, 203);
}

TEST_P(Windows, ShowItAtTheTopLeftOnBlack) {
  open(301, 203);
  for (const auto& [width, height] : std::vector<std::pair<uint32_t, uint32_t>>{
           {301, 203}, {111, 203}, {301, 77}, {111, 77}, {1, 1}, {640, 480}, {320, 5}}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    showAndSee(301, 203, width, height);
  }
}

TEST_P(Windows, ShowNothingBesideThemselves) {
  open(64, 48);
  showAndSee(64, 48, 200, 100);
  const std::vector<uint32_t> right = display().pixels(64, 0, 32, 48);
  EXPECT_EQ(right, std::vector<uint32_t>(right.size(), 0u));
}

TEST_P(Windows, ShowPicturesAtEverySize) {
  open(301, 203);
  for (const auto& [width, height] : std::vector<std::pair<uint32_t, uint32_t>>{
           {1, 1}, {kScreen, kScreen}, {7, 640}, {801, 3}, {640, 480}, {301, 203}}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height);
    glfwSetWindowSize(window(), static_cast<int>(width), static_cast<int>(height));
    showAndSee(width, height, width, height);
  }
}

// As when a user drags a corner: each picture is already of another size than the window.
TEST_P(Windows, ChangeTheirSizeBetweenPictures) {
  open(200, 150);
  for (uint32_t step = 0; step < 60; ++step) {
    const uint32_t size = 100 + step * 7 % 120;
    const gpu::Texture picture = makePicture(device(), size, size);
    glfwSetWindowSize(window(), static_cast<int>(size + step % 3), static_cast<int>(size));
    glfwPollEvents();
    (void)device().present(picture);
    device().destroy(picture);
  }
  // Also after waiting for the device.
  const gpu::Texture picture = makePicture(device(), 90, 70);
  device().wait();
  glfwSetWindowSize(window(), 90, 70);
  show(picture);
  device().destroy(picture);
  expectPicture(90, 70, 90, 70);
}

TEST_P(Windows, ThatAreIconifiedShowNothing) {
  open(120, 90);
  const gpu::Texture picture = makePicture(device(), 120, 90);
  show(picture);
  for (int round = 0; round < 3; ++round) {
    display().markIconified(true);
    const auto begin = Clock::now();
    for (int i = 0; i < 20; ++i) {
      glfwPollEvents();
      EXPECT_FALSE(device().present(picture));
    }
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
    display().markIconified(false);
    show(picture);
    expectPicture(120, 90, 120, 90);
  }
  device().destroy(picture);
}

// Pictures of a hidden window are not visible; presenting some must at most take a while.
TEST_P(Windows, ThatAreHiddenDoNotHang) {
  open(120, 90);
  const gpu::Texture picture = makePicture(device(), 120, 90);
  show(picture);
  glfwHideWindow(window());
  const auto begin = Clock::now();
  for (int i = 0; i < 20; ++i) {
    glfwPollEvents();
    (void)device().present(picture);
  }
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20));
  glfwShowWindow(window());
  show(picture);
  expectPicture(120, 90, 120, 90);
  device().destroy(picture);
}

// Shows the last writes of a frame, by a shader or as a target. The next frame may overwrite them
// at once.
TEST_P(Windows, ShowWhatTheFrameWrote) {
  open(33, 17);
  const gpu::Texture picture =
      device().createTexture({.label = "picture",
                              .format = gpu::Format::kRgba8Unorm,
                              .width = 33,
                              .height = 17,
                              .usage = gpu::TextureUsage::kStorage | gpu::TextureUsage::kTarget});
  const gpu::ComputePipeline paint = device().createComputePipeline(
      {.label = "paint", .shader = &grisaille_shader_image_color_comp});
  for (uint32_t frame = 0; frame < 24; ++frame) {
    const uint32_t level = frame * 10 + 5;  // 0 ... 255
    const std::array<float, 4> color = {static_cast<float>(level) / 255, 0.2f, 1, 0};
    gpu::Commands& commands = device().begin();
    commands.beginPass("paint");
    if (frame % 2 == 0) {
      const gpu::Binding bindings[] = {
          gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(color)))),
          gpu::imageBinding(0, picture)};
      commands.dispatch({.pipeline = paint, .bindings = bindings, .groups = {5, 3, 1}});
    } else {
      const gpu::ColorTarget target{.view = {.texture = picture}, .clear = color};
      commands.render({.colors = {&target, 1}});
    }
    commands.endPass();
    device().submit();
    show(picture);
    if (frame % 8 < 6) continue;  // most frames are overwritten before the test reads the screen
    expectShown(33, 17, [&](uint32_t, uint32_t) { return level << 16 | 0x33ffu; });
  }
  device().destroy(picture);
  device().destroy(paint);
}

}  // namespace
}  // namespace grisaille::tests
