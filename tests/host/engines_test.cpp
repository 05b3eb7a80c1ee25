// SPDX-License-Identifier: MIT
// Two hosts like engines, one for each API: several frames in flight, two views, stereo, a
// resolution that changes each frame, resizing, and dropped recordings; four of them at a time,
// each in a thread and with a device of its own. The validation of the API, on Vulkan with that of
// synchronization, says nothing, and all threads see the same pictures.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <latch>
#include <mutex>
#include <thread>

#include "examples/opengl/window.h"
#include "examples/vulkan/context.h"
#include "grisaille/host.hpp"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"

namespace grisaille::tests {
namespace {

constexpr int kFrames = 24;
constexpr int kResized = 10, kDropped[] = {5, 15};  // frames
constexpr uint32_t kEyes = 2;

struct Size {
  uint32_t width = 64, height = 48;
};
Size sizeAt(int frame) {
  return frame < kResized ? Size{64, 48} : Size{56, 40};
}
bool isDropped(int frame) {
  return frame == kDropped[0] || frame == kDropped[1];
}

// What the effects of both engines do in a frame.
class Effects {
 public:
  explicit Effects(const host::Device& device)
      : main_(device, {.effect = "ssao",
                       .width = sizeAt(0).width,
                       .height = sizeAt(0).height,
                       .outputs = {"ao", "bent_normal"}}),
        stereo_(device, {.effect = "ssao",
                         .width = sizeAt(0).width,
                         .height = sizeAt(0).height,
                         .layers = kEyes,
                         .keptSizes = 3}) {
    main_.set("history", 8);
    stereo_.set("resolution", "half");
    for (double side : {-0.05, 0.05}) {
      const glm::dmat4 projection = projectionOf({.angle = 0.8, .shift = {side, 0}}, 4.0 / 3, {});
      cameras_.emplace_back(&view_[0][0], &projection[0][0]);
    }
  }

  void resize(const Size& size) {
    main_.resize(size.width, size.height);
    stereo_.resize(size.width, size.height);
  }
  // `flat`: depth of one view; `eyes`: of two, as an array.
  void record(int frame, void* commands, const host::Texture& flat, const host::Texture& eyes) {
    const Size size = sizeAt(frame);
    const auto number = static_cast<uint64_t>(frame);
    main_.record({.number = number,
                  .commandBuffer = commands,
                  .camera = cameras_[0],
                  .depth = flat,
                  .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
    const uint32_t less = 4u * (static_cast<uint32_t>(frame) % 3);
    stereo_.record({.number = number,
                    .commandBuffer = commands,
                    .camera = cameras_[0],
                    .depth = eyes,
                    .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                    .rectangle = {less, 0, size.width - less, size.height - less}});
  }
  void dropped() {
    main_.dropped();
    stereo_.dropped();
  }

  const host::Effect& main() const { return main_; }
  const host::Effect& stereo() const { return stereo_; }

 private:
  host::Effect main_, stereo_;
  const glm::dmat4 view_ = glm::dmat4(1);
  std::vector<host::Camera> cameras_;
};

// A wall with a step that moves.
std::vector<float> depthAt(int frame, const Size& size, uint32_t layers) {
  std::vector<float> metres;
  for (uint32_t i = 0; i < size.width * size.height * layers; ++i) {
    const uint32_t x = i % size.width;
    metres.push_back(x < 20 + static_cast<uint32_t>(frame) % 8 ? 2.0f : 2.2f);
  }
  return metres;
}

struct Result {
  std::vector<uint16_t> main, stereo;  // half floats of the last frame
  int complaints = 0;
  bool operator==(const Result&) const = default;
};

// --- Vulkan. No barrier but the host's own changes of layouts; no wait but for the fence of a
// frame that was submitted framesInFlight frames before.

class VulkanEngine {
 public:
  explicit VulkanEngine(uint32_t framesInFlight)
      : context_(true),
        device_(host::Device::vulkan({.instance = context_.instance,
                                      .physicalDevice = context_.physical,
                                      .device = context_.device,
                                      .queueFamily = context_.family,
                                      .framesInFlight = framesInFlight})),
        effects_(device_),
        slots_(framesInFlight) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = context_.family;
    example::check(vkCreateCommandPool(context_.device, &pool, nullptr, &pool_), "pool");
    for (Slot& slot : slots_) {
      VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
      info.commandPool = pool_;
      info.commandBufferCount = 1;
      example::check(vkAllocateCommandBuffers(context_.device, &info, &slot.commands), "commands");
      VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
      fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
      example::check(vkCreateFence(context_.device, &fence, nullptr, &slot.fence), "fence");
      slot.upload = context_.makeBuffer(kUpload, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
      slot.download = context_.makeBuffer(kUpload, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    }
    makeTextures(sizeAt(0));
  }
  ~VulkanEngine() {
    vkDeviceWaitIdle(context_.device);
    dropTextures();
    for (Slot& slot : slots_) {
      vkDestroyFence(context_.device, slot.fence, nullptr);
      context_.destroy(slot.upload);
      context_.destroy(slot.download);
    }
    vkDestroyCommandPool(context_.device, pool_, nullptr);
  }

  Result run() {
    for (int frame = 0; frame < kFrames; ++frame) {
      Slot& slot = slots_[static_cast<size_t>(frame) % slots_.size()];
      example::check(vkWaitForFences(context_.device, 1, &slot.fence, VK_TRUE, UINT64_MAX),
                     "fence");
      if (frame == kResized) {
        // The engine's own textures are in use; the library keeps what it has recorded.
        vkQueueWaitIdle(context_.queue);
        dropTextures();
        makeTextures(sizeAt(frame));
        effects_.resize(sizeAt(frame));
      }
      if (isDropped(frame)) {
        record(slot, frame);
        effects_.dropped();
      }
      record(slot, frame);
      vkResetFences(context_.device, 1, &slot.fence);
      VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
      info.commandBufferCount = 1;
      info.pCommandBuffers = &slot.commands;
      example::check(vkQueueSubmit(context_.queue, 1, &info, slot.fence), "submit");
    }
    Slot& last = slots_[(kFrames - 1) % slots_.size()];
    example::check(vkWaitForFences(context_.device, 1, &last.fence, VK_TRUE, UINT64_MAX), "fence");
    const Size size = sizeAt(kFrames - 1);
    const size_t texels = size_t{size.width} * size.height;
    const auto* halves = static_cast<const uint16_t*>(last.download.mapped);
    Result result{.main = {halves, halves + texels},
                  .stereo = {halves + texels, halves + 3 * texels},
                  .complaints = context_.complaints};
    return result;
  }

 private:
  static constexpr VkDeviceSize kUpload = 64 * 1024;
  struct Slot {
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    example::Buffer upload, download;
  };

  void makeTextures(const Size& size) {
    constexpr VkImageUsageFlags kUse = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    for (uint32_t i = 0; i < 2; ++i) {
      images_[i] = context_.makeImage(VK_FORMAT_R32_SFLOAT, size.width, size.height, kUse,
                                      i == 0 ? 1 : kEyes);
      textures_[i] = host::Texture(device_, {.image = host::number(images_[i].image),
                                             .format = VK_FORMAT_R32_SFLOAT,
                                             .layout = VK_IMAGE_LAYOUT_GENERAL,
                                             .width = size.width,
                                             .height = size.height,
                                             .layers = i == 0 ? 1 : kEyes});
    }
    fresh_ = true;
  }
  void dropTextures() {
    for (uint32_t i = 0; i < 2; ++i) {
      textures_[i] = {};
      context_.destroy(images_[i]);
    }
  }

  void record(Slot& slot, int frame) {
    const Size size = sizeAt(frame);
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    example::check(vkBeginCommandBuffer(slot.commands, &begin), "begin");
    const std::vector<float> metres = depthAt(frame, size, 1 + kEyes);
    std::memcpy(slot.upload.mapped, metres.data(), metres.size() * sizeof(float));
    for (uint32_t i = 0; i < 2; ++i) {
      if (fresh_ && !isDropped(frame)) {
        example::transition(slot.commands, images_[i].image, VK_IMAGE_ASPECT_COLOR_BIT,
                            VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
      }
      // Without a barrier after it: the recording waits for it. Nor one before: it waits for the
      // recording of the frame before.
      VkBufferImageCopy region{};
      region.bufferOffset = i == 0 ? 0 : size_t{size.width} * size.height * sizeof(float);
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, i == 0 ? 1 : kEyes};
      region.imageExtent = {size.width, size.height, 1};
      vkCmdCopyBufferToImage(slot.commands, slot.upload.buffer, images_[i].image,
                             VK_IMAGE_LAYOUT_GENERAL, 1, &region);
    }
    fresh_ = fresh_ && isDropped(frame);
    effects_.record(frame, slot.commands, textures_[0], textures_[1]);
    download(slot, effects_.main().output("ao"), 0);
    download(slot, effects_.stereo().output("ao"), size_t{size.width} * size.height * 2);
    example::check(vkEndCommandBuffer(slot.commands), "end");
  }

  void download(const Slot& slot, const grisaille_host_output& output, size_t offset) {
    const auto image = reinterpret_cast<VkImage>(output.image);
    const auto layout = static_cast<VkImageLayout>(output.layout);
    example::transition(slot.commands, image, VK_IMAGE_ASPECT_COLOR_BIT, layout,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.bufferOffset = offset;
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, output.layers};
    region.imageExtent = {output.width, output.height, 1};
    vkCmdCopyImageToBuffer(slot.commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           slot.download.buffer, 1, &region);
    example::transition(slot.commands, image, VK_IMAGE_ASPECT_COLOR_BIT,
                        VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
  }

  example::Context context_;
  host::Device device_;
  Effects effects_;
  std::vector<Slot> slots_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::array<example::Image, 2> images_;   // depth of one view, and of two
  std::array<host::Texture, 2> textures_;  // the same
  bool fresh_ = true;                      // the images have no layout yet
};

// --- OpenGL: a context for each thread.

class OpenGlEngine {
 public:
  explicit OpenGlEngine(uint32_t framesInFlight)
      : device_(host::Device::opengl(
            {.framesInFlight = framesInFlight, .flags = GRISAILLE_HOST_CHECK})),
        effects_(device_) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text, const void* count) {
          if (type != GL_DEBUG_TYPE_ERROR) return;
          std::fprintf(stderr, "OpenGL: %s\n", text);
          ++*static_cast<int*>(const_cast<void*>(count));
        },
        &complaints_);
    makeTextures(sizeAt(0));
  }
  ~OpenGlEngine() { dropTextures(); }

  Result run() {
    for (int frame = 0; frame < kFrames; ++frame) {
      if (frame == kResized) {
        dropTextures();
        makeTextures(sizeAt(frame));
        effects_.resize(sizeAt(frame));
      }
      upload(frame);
      effects_.record(frame, nullptr, textures_[0], textures_[1]);
      // OpenGL executes what the host would drop: it records the frame again.
      if (isDropped(frame)) {
        effects_.dropped();
        effects_.record(frame, nullptr, textures_[0], textures_[1]);
      }
    }
    Result result{.main = halvesOf(effects_.main().output("ao")),
                  .stereo = halvesOf(effects_.stereo().output("ao"))};
    result.complaints = complaints_ + (glGetError() != GL_NO_ERROR ? 1 : 0);
    return result;
  }

 private:
  void makeTextures(const Size& size) {
    const auto width = static_cast<GLsizei>(size.width), height = static_cast<GLsizei>(size.height);
    glCreateTextures(GL_TEXTURE_2D, 1, &names_[0]);
    glTextureStorage2D(names_[0], 1, GL_R32F, width, height);
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &names_[1]);
    glTextureStorage3D(names_[1], 1, GL_R32F, width, height, kEyes);
    textures_[0] = host::Texture(device_, {.image = names_[0]});
    textures_[1] = host::Texture(device_, {.image = names_[1], .layers = kEyes});
  }
  void dropTextures() {
    for (host::Texture& texture : textures_) texture = {};
    glDeleteTextures(static_cast<GLsizei>(names_.size()), names_.data());
  }
  void upload(int frame) {
    const Size size = sizeAt(frame);
    const std::vector<float> metres = depthAt(frame, size, 1 + kEyes);
    const auto width = static_cast<GLsizei>(size.width), height = static_cast<GLsizei>(size.height);
    glTextureSubImage2D(names_[0], 0, 0, 0, width, height, GL_RED, GL_FLOAT, metres.data());
    glTextureSubImage3D(names_[1], 0, 0, 0, 0, width, height, kEyes, GL_RED, GL_FLOAT,
                        metres.data() + size_t{size.width} * size.height);
  }
  static std::vector<uint16_t> halvesOf(const grisaille_host_output& output) {
    std::vector<uint16_t> halves(size_t{output.width} * output.height * output.layers);
    glGetTextureImage(static_cast<GLuint>(output.image), 0, GL_RED, GL_HALF_FLOAT,
                      static_cast<GLsizei>(halves.size() * sizeof(uint16_t)), halves.data());
    return halves;
  }

  host::Device device_;
  Effects effects_;
  std::array<GLuint, 2> names_ = {};
  std::array<host::Texture, 2> textures_;
  int complaints_ = 0;
};

class Engines : public ::testing::TestWithParam<TestDevice> {};
GRISAILLE_IN_EVERY_HOST(Engines);

TEST_P(Engines, FourThreadsSeeTheSameAndNothingIsComplainedOf) {
  constexpr std::array<uint32_t, 4> kFramesInFlight = {1, 2, 3, 16};
  std::array<Result, 4> results;
  std::array<std::string, 4> failures;
  {
    const DriverScope scope(GetParam());
    const bool isVulkan = GetParam().backend == "vulkan";
    static std::mutex windows;  // GLFW makes windows in one thread at a time
    std::latch done(results.size());
    std::vector<std::thread> threads;
    for (size_t i = 0; i < results.size(); ++i) {
      threads.emplace_back([&, i] {
        try {
          if (isVulkan) {
            results[i] = VulkanEngine(kFramesInFlight[i]).run();
          } else {
            std::unique_ptr<example::Window> window;
            {
              const std::lock_guard lock(windows);
              window = std::make_unique<example::Window>();
            }
            results[i] = OpenGlEngine(kFramesInFlight[i]).run();
            // A window ends what all windows share.
            done.arrive_and_wait();
            const std::lock_guard lock(windows);
            window.reset();
          }
        } catch (const std::exception& error) {
          failures[i] = error.what();
          done.count_down();
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  for (size_t i = 0; i < results.size(); ++i) {
    EXPECT_EQ(failures[i], "");
    EXPECT_EQ(results[i].complaints, 0) << kFramesInFlight[i] << " frames in flight";
    EXPECT_EQ(results[i], results[0]) << kFramesInFlight[i] << " frames in flight";
  }
  size_t occluded = 0;
  for (const uint16_t half : results[0].main) {
    if (glm::unpackHalf1x16(half) < 0.95f) ++occluded;
  }
  EXPECT_GT(occluded, 20u) << "no pixel is occluded";
  ASSERT_EQ(results[0].stereo.size(), 2 * results[0].main.size());
}

}  // namespace
}  // namespace grisaille::tests
