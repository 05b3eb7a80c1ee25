// SPDX-License-Identifier: MIT
// The code of the last sections of docs/manual/embed.md, compiled and run as it stands there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "examples/vulkan/context.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"
#include "tests/host/vulkan_host.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace gr = grisaille::host;

constexpr uint32_t kWidth = 48, kHeight = 32;

// The page shows the code between the comments.
// manual: begin
void tell(void*, uint32_t level, const char* text) {
  constexpr const char* kLevels[] = {"info", "warning", "error"};
  std::printf("grisaille %s: %s\n", kLevels[level], text);
}
// manual: end

// An engine's memory.
struct Heap {
  gr::VulkanSpec of;
  int live = 0;

  int allocate(const grisaille_host_memory_request& request, grisaille_host_memory& out) {
    const int made = allocateFor(of, request, out);
    if (made == VK_SUCCESS) ++live;
    return made;
  }
  void free(const grisaille_host_memory& memory) {
    --live;
    vkFreeMemory(static_cast<VkDevice>(of.device), reinterpret_cast<VkDeviceMemory>(memory.memory),
                 nullptr);
  }
};

class Manual : public ::testing::TestWithParam<TestDevice> {
 protected:
  Manual() : host_(makeHost(GetParam())) {}
  ~Manual() override { EXPECT_EQ(host_->complaints(), 0); }

  std::unique_ptr<Host> host_;
  const glm::dmat4 view_ = glm::dmat4(1), projection_ = projectionOf({.angle = 1}, 1.5, {});
};
GRISAILLE_IN_EVERY_HOST(Manual);

TEST_P(Manual, MessagesChecksAndMemory) {
  if (GetParam().backend != "vulkan") GTEST_SKIP();
  gr::VulkanSpec spec = vulkanSpec(*host_);
  Heap heap{.of = spec};
  {
    // manual: begin
    const grisaille_host_log log = gr::logOf(tell, nullptr);
    spec.log = &log;
    spec.flags = GRISAILLE_HOST_CHECK;
    // manual: end
    // manual: begin
    const grisaille_host_allocator functions = {
        .struct_size = sizeof(functions),
        .context = &heap,
        .allocate = [](void* context, const grisaille_host_memory_request* request,
                       grisaille_host_memory* out) -> int {
          return static_cast<Heap*>(context)->allocate(*request, *out);  // a VkResult
        },
        .free =
            [](void* context, const grisaille_host_memory* memory) {
              static_cast<Heap*>(context)->free(*memory);
            }};
    spec.allocator = &functions;
    const gr::Device device = gr::Device::vulkan(spec);
    // manual: end
    const uint32_t width = kWidth, height = kHeight;
    // manual: begin
    const grisaille_host_setting settings[] = {{"resolution", "half"}, {"history", "8"}};
    const gr::EffectSpec wanted = {
        .effect = "ssao", .width = width, .height = height, .settings = settings};
    const uint64_t needed = gr::memoryNeeded(device, wanted).device_bytes;  // nothing exists yet
    gr::Effect ssao(device, wanted);
    // After some frames:
    const uint64_t taken = ssao.memory().device_bytes;  // within 2 % of `needed`
    const uint64_t all = device.memory().device_bytes;  // of all effects of the device
    // manual: end
    EXPECT_GT(needed, taken) << "nothing is recorded yet";
    EXPECT_GE(all, taken);
    EXPECT_GT(heap.live, 0);
  }
  EXPECT_EQ(heap.live, 0);
}

TEST_P(Manual, PartsAndLayersOfTextures) {
  const gr::Device device = host_->device();
  const uint32_t width = kWidth, height = kHeight;
  const std::vector<float> metres(size_t{2} * kWidth * kHeight, 2.0f);
  const gr::Texture one = host_->texture(device, Texels::kFloat1, kWidth, kHeight,
                                         {metres.begin(), metres.begin() + kWidth * kHeight});
  const gr::Texture both = host_->texture(device, Texels::kFloat1, kWidth, kHeight, metres, 2);
  const gr::TextureSpec described = host_->described();
  const double *view = &view_[0][0], *projection = &projection_[0][0];
  const double *leftView = view, *rightView = view, *left = projection, *right = projection;
  host_->frame([&](void* commands, uint64_t frame) {
    const gr::Texture& depth = one;
    const gr::Camera camera(view, projection);
    const uint32_t drawnWidth = 24, drawnHeight = 16;
    // manual: begin
    gr::Effect ssao(device, {.effect = "ssao", .width = width, .height = height, .keptSizes = 7});
    // Each frame: the textures keep their size, and the picture fills their corner.
    ssao.record({.number = frame,
                 .commandBuffer = commands,
                 .camera = camera,
                 .depth = depth,
                 .rectangle = {0, 0, drawnWidth, drawnHeight}});
    // manual: end
  });
  host_->frame([&](void* commands, uint64_t frame) {
    gr::TextureSpec array = described;
    // manual: begin
    array.layers = 2;
    const gr::Texture depth(device, array);
    gr::Effect ssao(device, {.effect = "ssao", .width = width, .height = height, .layers = 2});
    const gr::Camera eyes[] = {gr::Camera(leftView, left), gr::Camera(rightView, right)};
    ssao.record({.number = frame, .commandBuffer = commands, .camera = eyes[0], .depth = depth});
    const grisaille_host_output ao = ssao.output("ao");  // an array of ao.layers layers
    // manual: end
    EXPECT_EQ(ao.layers, 2u);
  });
}

std::string withoutSpace(std::string text) {
  std::erase_if(text, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
  return text;
}

// Every piece of code between the comments is on the page, and none else is in these sections.
TEST(ManualPage, ShowsThisCode) {
  const std::filesystem::path folder = SOURCE_FOLDER;
  const std::string page = readFile(folder / "docs/manual/embed.md"),
                    code = readFile(folder / "tests/host/manual_test.cpp");
  const size_t first = page.find("## Messages and checks");
  ASSERT_NE(first, std::string::npos);
  const std::string fence = "```", open = fence + "cpp\n",
                    begin =
                        "// manual: "
                        "begin\n",
                    end =
                        "// manual: "
                        "end\n";
  const auto pieces = [](const std::string& text, size_t from, const std::string& before,
                         const std::string& after) {
    std::vector<std::string> found;
    for (size_t at = from; (at = text.find(before, at)) != std::string::npos;) {
      at += before.size();
      found.push_back(withoutSpace(text.substr(at, text.find(after, at) - at)));
    }
    return found;
  };
  std::vector<std::string> shown = pieces(page, first, open, fence),
                           compiled = pieces(code, 0, begin, end);
  std::ranges::sort(shown);
  std::ranges::sort(compiled);
  ASSERT_GE(compiled.size(), 6u);
  EXPECT_EQ(shown, compiled);
}

}  // namespace
}  // namespace grisaille::tests
