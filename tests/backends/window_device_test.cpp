// SPDX-License-Identifier: MIT
// Devices with windows: selection, coexistence with other devices, errors.
#include "tests/backends/windows.h"
#include "tests/support/expect_error.h"

namespace grisaille::tests {
namespace {

class WindowDevices : public WindowTest {
 protected:
  std::unique_ptr<gpu::Device> create(GLFWwindow* window, const std::string& device) {
    gpu::DeviceOptions options = optionsFor(window);
    options.device = device;
    return backends::create(GetParam().backend, options);
  }
};
GRISAILLE_ON_EVERY_DEVICE(WindowDevices);

TEST_P(WindowDevices, SayWhatTheyAre) {
  open(32, 32);
  const gpu::DeviceInfo& info = device().info();
  EXPECT_EQ(info.backend, GetParam().backend);
  EXPECT_FALSE(info.name.empty());
  EXPECT_FALSE(info.driver.empty());
  EXPECT_GE(info.capabilities.maxTextureSize, 4096u);
}

TEST_P(WindowDevices, AreChosenByNumberOrPartOfTheirName) {
  GLFWwindow* window = makeWindow(32, 32);
  const std::string name = create(window, "")->info().name;
  EXPECT_EQ(create(window, name.substr(0, 6))->info().name, name);
  const std::vector<gpu::ListedDevice> listed = backends::find(GetParam().backend).list();
  for (size_t i = 0; i < listed.size(); ++i) {
    if (listed[i].name != name) continue;
    EXPECT_EQ(create(window, std::to_string(i))->info().name, name);
  }
  for (const char* wanted : {"no such device", "4096", "-1"}) {
    EXPECT_ERROR(ErrorId::kNoDevice, (void)create(window, wanted));
  }
  glfwDestroyWindow(window);
}

TEST_P(WindowDevices, FollowEachOtherOnOneWindow) {
  GLFWwindow* window = makeWindow(64, 48);
  for (const bool timed : {false, true, false}) {
    gpu::DeviceOptions options = optionsFor(window);
    options.timed = timed;
    const std::unique_ptr<gpu::Device> device = backends::create(GetParam().backend, options);
    const gpu::Texture picture = makePicture(*device, 64, 48);
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(device->present(picture));
    expectPicture(64, 48, 64, 48);
    device->destroy(picture);
  }
  glfwDestroyWindow(window);
}

// A device without a window, on any driver, alternates with the window's device.
TEST_P(WindowDevices, LiveBesideOthers) {
  open(50, 40);
  const gpu::Texture picture = makePicture(device(), 50, 40);
  for (const TestDevice& one : presentDevices()) {
    SCOPED_TRACE(one);
    const std::unique_ptr<gpu::Device> other = openDevice(one);
    for (int round = 0; round < 5; ++round) {
      show(picture);
      const gpu::Texture second = makePicture(*other, 20, 10);
      EXPECT_ERROR(ErrorId::kNoWindow, (void)other->present(second));
      EXPECT_EQ(device().read(picture).size(), 50u * 40 * 4);
      const std::vector<std::byte> bytes = other->read(second);
      EXPECT_EQ(std::to_integer<uint32_t>(bytes[0]), texel(0, 0, 20, 10) >> 16);
      other->destroy(second);
    }
  }
  show(picture);
  expectPicture(50, 40, 50, 40);
  device().destroy(picture);
}

TEST_P(WindowDevices, ShowPicturesInSeveralWindows) {
  open(50, 40);
  GLFWwindow* second = makeWindow(30, 20);
  glfwSetWindowPos(second, 100, 0);
  const std::unique_ptr<gpu::Device> other =
      backends::create(GetParam().backend, optionsFor(second));
  const gpu::Texture picture = makePicture(device(), 50, 40), small = makePicture(*other, 30, 20);
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(device().present(picture));
    EXPECT_TRUE(other->present(small));
  }
  expectShown(130, 40, [](uint32_t x, uint32_t y) {
    if (x < 50) return texel(x, y, 50, 40);
    return x >= 100 && y < 20 ? texel(x - 100, y, 30, 20) : 0u;
  });
  device().destroy(picture);
  other->destroy(small);
}

TEST_P(WindowDevices, RefuseTheOtherBackendsWindow) {
  for (const TestDevice& other : presentSystemDevices()) {
    if (other.backend == GetParam().backend) continue;
    GLFWwindow* window = makeWindow(32, 32, other.backend);
    glfwSetErrorCallback(nullptr);  // GLFW reports it too
    EXPECT_ERROR(ErrorId::kDeviceFailed, (void)create(window, ""));
    glfwDestroyWindow(window);
  }
}

TEST_P(WindowDevices, RefuseWhatIsNoPicture) {
  open(32, 32);
  const gpu::TextureDesc desc{.label = "no picture",
                              .format = gpu::Format::kR32Float,
                              .width = 4,
                              .height = 4,
                              .usage = gpu::TextureUsage::kSampled};
  const gpu::Texture floats = device().createTexture(desc);
  EXPECT_ERROR(ErrorId::kTextureFormat, (void)device().present(floats));
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device().present({}));
  device().destroy(floats);
  EXPECT_ERROR(ErrorId::kStaleHandle, (void)device().present(floats));
  const gpu::Texture picture = makePicture(device(), 32, 32);
  device().begin();
  EXPECT_ERROR(ErrorId::kAlreadyRecording, (void)device().present(picture));
  device().submit();
  show(picture);
  expectPicture(32, 32, 32, 32);
  device().destroy(picture);
}

}  // namespace
}  // namespace grisaille::tests
