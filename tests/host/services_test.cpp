// SPDX-License-Identifier: MIT
// What a host hands over and asks for: a log, checks, memory, and the names that debuggers show.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <map>
#include <set>

#include "examples/vulkan/context.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"
#include "tests/host/vulkan_host.h"
#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 48;

using Lines = std::vector<std::pair<uint32_t, std::string>>;

void take(void* lines, uint32_t level, const char* text) {
  static_cast<Lines*>(lines)->emplace_back(level, text);
}

size_t count(const Lines& lines, uint32_t level, const std::string& mention) {
  return static_cast<size_t>(std::ranges::count_if(lines, [&](const auto& line) {
    return line.first == level && line.second.find(mention) != std::string::npos;
  }));
}

// The number of the error of a call, or 0.
template <typename Call>
int numberOf(const Call& call) {
  try {
    call();
    return 0;
  } catch (const host::Failure& failure) {
    return failure.number();
  }
}

class Services : public ::testing::TestWithParam<TestDevice> {
 protected:
  explicit Services(bool validate = true) : host_(makeHost(GetParam(), validate)) {}
  ~Services() override { EXPECT_EQ(host_->complaints(), 0); }

  bool isVulkan() const { return GetParam().backend == "vulkan"; }
  host::Device device(uint32_t flags = 0) { return host_->device(SHOWN_FOLDER, flags, &log_); }

  host::Texture depth(const host::Device& device) {
    const Seen seen = see(eye_, kWidth, kHeight);
    return host_->texture(device, Texels::kFloat1, kWidth, kHeight,
                          {seen.view.begin(), seen.view.end()});
  }
  void record(host::Effect& effect, const host::Texture& depth,
              std::span<const grisaille_host_input> inputs = {},
              const host::Texture* normal = nullptr) {
    std::exception_ptr failed;
    host_->frame([&](void* commands, uint64_t number) {
      try {
        effect.record({.number = number,
                       .commandBuffer = commands,
                       .camera = cameras_[0],
                       .depth = depth,
                       .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                       .normal = normal,
                       .inputs = inputs});
      } catch (...) {
        failed = std::current_exception();  // the host submits nevertheless
      }
    });
    if (failed) std::rethrow_exception(failed);
  }

  const Eye eye_{.viewFromWorld = glm::lookAt(glm::dvec3(1.2, 1.6, 3.1), glm::dvec3(0.1, 0.5, -0.3),
                                              glm::dvec3(0, 1, 0)),
                 .angle = 0.8};
  const glm::dmat4 projection_ = projectionOf(eye_, double{1} * kWidth / kHeight, {});
  const host::Camera cameras_[2] = {{&eye_.viewFromWorld[0][0], &projection_[0][0]},
                                    {&eye_.viewFromWorld[0][0], &projection_[0][0]}};
  Lines lines_;
  const grisaille_host_log log_ = host::logOf(take, &lines_);
  std::unique_ptr<Host> host_;
};
GRISAILLE_IN_EVERY_HOST(Services);

// --- The log

TEST_P(Services, TheLogTakesEveryMessage) {
  const TemporaryFolder folder;
  std::ofstream(folder / "broken.so") << "no library";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    const host::Device device = host_->device(folder.path().c_str(), GRISAILLE_HOST_CHECK, &log_);
    EXPECT_EQ(count(lines_, GRISAILLE_HOST_WARNING, "broken.so"), 1u);
    lines_.clear();
    EXPECT_EQ(numberOf([&] { host::Effect(device, {.effect = "sao", .width = 8, .height = 8}); }),
              3201);
    EXPECT_EQ(lines_, (Lines{{GRISAILLE_HOST_ERROR, grisaille_host_last_error()}}));
    lines_.clear();
    host::Effect effect(device, {.effect = "ssao", .width = kWidth, .height = kHeight});
    EXPECT_EQ(numberOf([&] { effect.set("radius", -1.0); }), 3302);
    EXPECT_EQ(lines_, (Lines{{GRISAILLE_HOST_ERROR, grisaille_host_last_error()}}));
    EXPECT_EQ(numberOf([&] { host::Texture(device, {}); }), 5605);
    EXPECT_EQ(count(lines_, GRISAILLE_HOST_ERROR, "error E5605"), 1u);
    // What is compiled in a recording, and not after prepare().
    lines_.clear();
    const host::Texture seen = depth(device);
    record(effect, seen);
    EXPECT_GT(count(lines_, GRISAILLE_HOST_INFO, "ssao compiles "), 0u);
    lines_.clear();
    record(effect, seen);
    effect.set("estimator", "classic");
    effect.prepare();
    record(effect, seen);
    EXPECT_TRUE(lines_.empty()) << lines_[0].second;
  }
  EXPECT_TRUE(lines_.empty()) << "the end of a device: " << lines_[0].second;
  const std::string out = testing::internal::GetCapturedStdout(),
                    error = testing::internal::GetCapturedStderr();
  EXPECT_EQ(out, "");
  EXPECT_EQ(error, "");
}

TEST_P(Services, TheLogIsToldWhyADeviceIsRefused) {
  EXPECT_EQ(numberOf([&] { host_->device("/nowhere", 0, &log_); }), 3106);
  EXPECT_EQ(count(lines_, GRISAILLE_HOST_ERROR, "/nowhere"), 1u);
  EXPECT_EQ(numberOf([&] { host_->device(nullptr, 2, &log_); }), 5611);
  EXPECT_EQ(count(lines_, GRISAILLE_HOST_ERROR, "flags has the bits 0x2"), 1u);
  grisaille_host_log wrong = log_;
  wrong.write = nullptr;
  EXPECT_EQ(numberOf([&] { host_->device(nullptr, 0, &wrong); }), 5601);
  wrong = log_;
  wrong.reserved = 1;
  EXPECT_EQ(numberOf([&] { host_->device(nullptr, 0, &wrong); }), 5611);
  wrong.struct_size = 4;
  EXPECT_EQ(numberOf([&] { host_->device(nullptr, 0, &wrong); }), 5602);
}

// --- The checking device

TEST_P(Services, ChecksFindWhatAnEffectDoesWrong) {
  for (const uint32_t flags : {0u, uint32_t{GRISAILLE_HOST_CHECK}}) {
    const host::Device device = this->device(flags);
    const host::Texture seen = depth(device);
    const grisaille_host_input inputs[] = {host::inputOf("mask", seen)};
    host::Effect effect(device, {.effect = "shown", .width = kWidth, .height = kHeight});
    record(effect, seen, inputs);
    const std::vector<float> sound = host_->read(effect.output("shown"));
    effect.set("fault", "unwritten");
    lines_.clear();
    const int number = numberOf([&] { record(effect, seen, inputs); });
    EXPECT_EQ(number, flags != 0 ? 3203 : 0);
    const std::string mention = "texture 'shown/nobody's', which was never written";
    EXPECT_EQ(count(lines_, GRISAILLE_HOST_ERROR, mention), flags != 0 ? 1u : 0u);
    if (flags != 0) {
      EXPECT_NE(std::string(grisaille_host_last_error()).find(mention), std::string::npos)
          << grisaille_host_last_error();
    }
    // A recording that fails inside a pass closes it.
    effect.set("fault", "leaves_pass");
    EXPECT_EQ(numberOf([&] { record(effect, seen, inputs); }), 3203);
    effect.set("fault", "none");
    record(effect, seen, inputs);
    EXPECT_EQ(host_->read(effect.output("shown")), sound);
  }
}

// The library and its effects commit no fault, and results are the same.
TEST_P(Services, ChecksChangeNothing) {
  std::vector<std::vector<float>> found;
  for (const uint32_t flags : {0u, uint32_t{GRISAILLE_HOST_CHECK}}) {
    const host::Device device = this->device(flags);
    const host::Texture seen = depth(device);
    for (const char* estimator : {"slices", "classic"}) {
      host::Effect effect(device, {.effect = "ssao",
                                   .width = kWidth,
                                   .height = kHeight,
                                   .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM,
                                   .outputs = {"ao", "bent_normal"}});
      effect.set("estimator", estimator);
      effect.set("history", 4);
      for (int frame = 0; frame < 3; ++frame) record(effect, seen);
      effect.dropped();
      for (int frame = 0; frame < 3; ++frame) record(effect, seen);
      found.push_back(host_->read(effect.output("ao")));
    }
    const auto array = host_->texture(device, Texels::kFloat1, kWidth, kHeight,
                                      std::vector<float>(2 * kWidth * kHeight, 2.0f), 2);
    host::Effect stereo(device,
                        {.effect = "ssao", .width = kWidth, .height = kHeight, .layers = 2});
    record(stereo, array);
  }
  EXPECT_EQ(found[0], found[2]);
  EXPECT_EQ(found[1], found[3]);
  EXPECT_EQ(count(lines_, GRISAILLE_HOST_ERROR, ""), 0u);
  EXPECT_EQ(count(lines_, GRISAILLE_HOST_WARNING, ""), 0u);
}

// --- Memory

// Before and after an effect exists: within 2 %.
TEST_P(Services, MemoryIsKnownBeforeAnEffectExists) {
  const host::Device device = this->device();
  struct Case {
    std::vector<grisaille_host_setting> settings;
    uint32_t layers = 1;
    grisaille_host_rows rows = GRISAILLE_HOST_ROWS_FROM_TOP;
    bool normals = false;
  };
  const std::vector<Case> cases = {
      {},
      {.settings = {{"estimator", "classic"}}},
      {.settings = {{"resolution", "half"}, {"history", "8"}}, .normals = true},
      {.settings = {{"history", "8"}}, .layers = 2},
      {.settings = {{"backs", "drawn"}}, .rows = GRISAILLE_HOST_ROWS_FROM_BOTTOM}};
  std::set<uint64_t> sizes;
  std::vector<host::Effect> effects;  // until the end: devices free memory some frames later
  for (const Case& one : cases) {
    const host::EffectSpec spec{.effect = "ssao",
                                .width = 320,
                                .height = 180,
                                .rows = one.rows,
                                .outputs = {"ao", "bent_normal"},
                                .layers = one.layers,
                                .settings = one.settings};
    const uint32_t inputs = one.normals ? GRISAILLE_READS(GRISAILLE_NORMAL) : 0u;
    const grisaille_host_memory_use before = device.memory();
    const grisaille_host_memory_use needed = host::memoryNeeded(device, spec, inputs);
    EXPECT_EQ(device.memory().device_bytes, before.device_bytes) << "the query creates nothing";
    host::Effect& effect = effects.emplace_back(device, spec);
    EXPECT_GT(effect.memory().device_bytes, 0u);
    std::vector<float> metres(size_t{320} * 180 * one.layers, 2.0f);
    const auto depth =
        host_->texture(device, Texels::kFloat1, 320, 180, metres, one.layers > 1 ? one.layers : 0);
    const auto normal = host_->texture(device, Texels::kFloat4, 320, 180,
                                       std::vector<float>(4 * metres.size(), 0.5f));
    for (int frame = 0; frame < 4; ++frame) {
      record(effect, depth, {}, one.normals ? &normal : nullptr);
    }
    const grisaille_host_memory_use taken = effect.memory(), after = device.memory();
    const auto bytes = [](const grisaille_host_memory_use& use) {
      return std::pair(static_cast<double>(use.device_bytes), static_cast<double>(use.host_bytes));
    };
    std::printf("%s: device %.0f needed, %.0f taken; host %.0f needed, %.0f taken\n",
                GetParam().backend.c_str(), bytes(needed).first, bytes(taken).first,
                bytes(needed).second, bytes(taken).second);
    EXPECT_NEAR(bytes(needed).first / bytes(taken).first, 1, 0.02);
    EXPECT_NEAR(bytes(needed).second / bytes(taken).second, 1, 0.02);
    EXPECT_EQ(after.device_bytes - before.device_bytes, taken.device_bytes)
        << "the device holds the effect's memory, and no other";
    EXPECT_GE(after.host_bytes, taken.host_bytes);
    sizes.insert(taken.device_bytes);
    // At least the outputs: 2 and 8 bytes a texel.
    EXPECT_GE(taken.device_bytes, uint64_t{320} * 180 * 10 * one.layers);
  }
  EXPECT_EQ(sizes.size(), cases.size());
  EXPECT_EQ(numberOf([&] { host::memoryNeeded(device, {.effect = "ssao", .width = 0}); }), 1105);
  EXPECT_EQ(numberOf([&] { host::memoryNeeded(device, {.effect = "sao"}); }), 3201);
  grisaille_host_memory_use use = {};
  EXPECT_EQ(grisaille_host_memory_needed(nullptr, nullptr, nullptr, &use), 5601);
  EXPECT_EQ(grisaille_host_device_memory(device.handle(), &use), 5602);
  EXPECT_EQ(grisaille_host_device_memory(nullptr, &use), 5601);
  EXPECT_EQ(grisaille_host_effect_memory(nullptr, &use), 5601);
}

// Hands out parts of large blocks, as an engine does.
class Blocks {
 public:
  explicit Blocks(const host::VulkanSpec& spec)
      : spec_(spec), device_(static_cast<VkDevice>(spec.device)) {}
  ~Blocks() {
    EXPECT_EQ(live, 0u) << "memory was not freed";
    for (auto& [key, block] : blocks_) vkFreeMemory(device_, block.memory, nullptr);
  }

  grisaille_host_allocator functions() {
    return {.struct_size = sizeof(grisaille_host_allocator),
            .reserved = 0,
            .context = this,
            .allocate =
                [](void* self, const grisaille_host_memory_request* request,
                   grisaille_host_memory* out) {
                  return static_cast<Blocks*>(self)->allocate(*request, *out);
                },
            .free =
                [](void* self, const grisaille_host_memory* memory) {
                  static_cast<Blocks*>(self)->free(*memory);
                }};
  }

  uint64_t live = 0, bytes = 0;  // allocations, and their bytes
  std::set<std::string> labels;
  size_t shared = 0;  // allocations at an offset over 0
  enum { kNone, kFails, kUnaligned, kUnmapped, kNull } fault = kNone;

 private:
  struct Block {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t used = 0;
    std::byte* mapped = nullptr;
  };
  static constexpr uint64_t kBlock = 64 << 20;

  int allocate(const grisaille_host_memory_request& request, grisaille_host_memory& out) {
    EXPECT_EQ(request.struct_size, sizeof(request));
    EXPECT_NE(request.buffer == 0, request.image == 0);
    labels.insert(request.label);
    if (fault == kFails) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (fault == kNull) return VK_SUCCESS;
    const MemoryType type = memoryTypeFor(spec_, request);
    // Buffers and images apart, which keeps bufferImageGranularity.
    Block& block = blocks_[{type.index, request.image != 0}];
    if (block.memory == VK_NULL_HANDLE) {
      VkMemoryAllocateInfo info{};
      info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
      info.allocationSize = kBlock;
      info.memoryTypeIndex = type.index;
      if (vkAllocateMemory(device_, &info, nullptr, &block.memory) != VK_SUCCESS) return -1;
      if (type.mappable) {
        void* mapped = nullptr;
        vkMapMemory(device_, block.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        block.mapped = static_cast<std::byte*>(mapped);
      }
    }
    const uint64_t at =
        (block.used + request.alignment - 1) / request.alignment * request.alignment;
    EXPECT_LE(at + request.size, kBlock);
    block.used = at + request.size;
    out.memory = host::number(block.memory);
    out.offset = fault == kUnaligned ? at + 1 : at;
    out.mapped = fault == kUnmapped ? nullptr : block.mapped + at;
    out.handle = new uint64_t(request.size);
    if (at > 0) ++shared;
    ++live;
    bytes += request.size;
    return VK_SUCCESS;
  }
  void free(const grisaille_host_memory& memory) {
    auto* size = static_cast<uint64_t*>(memory.handle);
    --live;
    bytes -= *size;
    delete size;
  }

  host::VulkanSpec spec_;
  VkDevice device_;
  std::map<std::pair<uint32_t, bool>, Block> blocks_;
};

TEST_P(Services, TheHostAllocatesAllMemory) {
  if (!isVulkan()) GTEST_SKIP() << "OpenGL's drivers allocate";
  host::VulkanSpec spec = vulkanSpec(*host_);
  const auto shade = [&](const host::Device& device) {
    const host::Texture seen = depth(device);
    host::Effect effect(device, {.effect = "ssao", .width = kWidth, .height = kHeight});
    for (const char* estimator : {"slices", "classic"}) {
      effect.set("estimator", estimator);
      for (int frame = 0; frame < 3; ++frame) record(effect, seen);
    }
    return host_->read(effect.output("ao"));
  };
  const std::vector<float> expected = shade(host::Device::vulkan(spec));
  Blocks blocks(spec);
  const grisaille_host_allocator functions = blocks.functions();
  spec.allocator = &functions;
  {
    const host::Device device = host::Device::vulkan(spec);
    EXPECT_EQ(shade(device), expected);
    const grisaille_host_memory_use use = device.memory();
    EXPECT_EQ(use.device_bytes + use.host_bytes, blocks.bytes);
    EXPECT_EQ(use.allocations, blocks.live);
    EXPECT_GT(blocks.shared, 5u);
    EXPECT_TRUE(blocks.labels.contains("ao"));
    const auto created = [&] {
      host::Effect(device, {.effect = "ssao", .width = kWidth, .height = kHeight});
    };
    const auto failsWith = [&](int number, const std::string& mention) {
      EXPECT_EQ(numberOf(created), number);
      EXPECT_NE(std::string(grisaille_host_last_error()).find(mention), std::string::npos)
          << grisaille_host_last_error();
      blocks.fault = Blocks::kNone;
    };
    blocks.fault = Blocks::kFails;
    failsWith(1007, "the host's memory function");
    blocks.fault = Blocks::kNull;
    failsWith(5611, "no VkDeviceMemory");
    blocks.fault = Blocks::kUnaligned;
    failsWith(5611, "not aligned");
    blocks.fault = Blocks::kUnmapped;
    host::Effect effect(device, {.effect = "ssao", .width = 16, .height = 16});
    blocks.fault = Blocks::kNone;
    EXPECT_EQ(shade(device), expected);
  }
  grisaille_host_allocator wrong = functions;
  wrong.free = nullptr;
  spec.allocator = &wrong;
  EXPECT_EQ(numberOf([&] { host::Device::vulkan(spec); }), 5601);
  wrong = functions;
  wrong.reserved = 1;
  EXPECT_EQ(numberOf([&] { host::Device::vulkan(spec); }), 5611);
}

// Upload buffers must be mapped.
TEST_P(Services, MemoryForTheCpuIsMapped) {
  if (!isVulkan()) GTEST_SKIP() << "OpenGL's drivers allocate";
  host::VulkanSpec spec = vulkanSpec(*host_);
  Blocks blocks(spec);
  const grisaille_host_allocator functions = blocks.functions();
  spec.allocator = &functions;
  const host::Device device = host::Device::vulkan(spec);
  const host::Texture seen = depth(device);
  host::Effect effect(device, {.effect = "ssao", .width = kWidth, .height = kHeight});
  blocks.fault = Blocks::kUnmapped;
  EXPECT_EQ(numberOf([&] { record(effect, seen); }), 5611);
  EXPECT_NE(std::string(grisaille_host_last_error()).find("memory that is not mapped"),
            std::string::npos);
  blocks.fault = Blocks::kNone;
  record(effect, seen);
}

struct Callbacks {
  size_t made = 0, live = 0;

  VkAllocationCallbacks functions() {
    return {.pUserData = this,
            .pfnAllocation =
                [](void* self, size_t size, size_t alignment, VkSystemAllocationScope) {
                  auto* own = static_cast<Callbacks*>(self);
                  ++own->made;
                  ++own->live;
                  return std::aligned_alloc(alignment,
                                            (size + alignment - 1) / alignment * alignment);
                },
            .pfnReallocation =
                [](void* self, void* old, size_t size, size_t alignment, VkSystemAllocationScope) {
                  auto* own = static_cast<Callbacks*>(self);
                  if (old == nullptr) ++own->made, ++own->live;
                  void* fresh =
                      std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
                  if (old != nullptr) {
                    std::memcpy(fresh, old, std::min(size, malloc_usable_size(old)));
                    std::free(old);
                  }
                  return fresh;
                },
            .pfnFree =
                [](void* self, void* memory) {
                  if (memory == nullptr) return;
                  --static_cast<Callbacks*>(self)->live;
                  std::free(memory);
                },
            .pfnInternalAllocation = nullptr,
            .pfnInternalFree = nullptr};
  }
};

TEST_P(Services, AllocationCallbacksReachTheDriver) {
  if (!isVulkan()) GTEST_SKIP() << "OpenGL has none";
  host::VulkanSpec spec = vulkanSpec(*host_);
  Callbacks callbacks;
  {
    const VkAllocationCallbacks functions = callbacks.functions();
    spec.allocationCallbacks = &functions;
    const host::Device device = host::Device::vulkan(spec);
    spec.allocationCallbacks = nullptr;  // the library has copied the struct
    const host::Texture seen = depth(device);
    host::Effect effect(device, {.effect = "ssao", .width = kWidth, .height = kHeight});
    const size_t before = callbacks.made;
    EXPECT_GT(before, 0u);
    record(effect, seen);
    EXPECT_GT(callbacks.made, before);
  }
  EXPECT_EQ(callbacks.live, 0u);
}

// --- Names for debuggers

TEST_P(Services, OpenGlGroupsAndNamesAreShown) {
  if (isVulkan()) GTEST_SKIP() << "see Calls.VulkanLabelsAndNamesAreShown";
  struct Seen {
    std::vector<std::string> path, deepest;  // of open groups
    std::set<std::string> groups;
  } seen;
  glDebugMessageCallback(
      [](GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text,
         const void* user) {
        auto& own = *static_cast<Seen*>(const_cast<void*>(user));
        if (type == GL_DEBUG_TYPE_PUSH_GROUP) {
          own.path.emplace_back(text, static_cast<size_t>(length));
          own.groups.insert(own.path.back());
          if (own.path.size() > own.deepest.size()) own.deepest = own.path;
        } else if (type == GL_DEBUG_TYPE_POP_GROUP && !own.path.empty()) {
          own.path.pop_back();
        }
      },
      &seen);
  const host::Device device = this->device();
  const host::Texture depth = this->depth(device);
  const grisaille_host_input inputs[] = {host::inputOf("mask", depth)};
  host::Effect effect(device, {.effect = "shown", .width = kWidth, .height = kHeight});
  record(effect, depth, inputs);
  EXPECT_EQ(seen.deepest.size(), 2u);
  EXPECT_EQ(seen.deepest[0], "grisaille: shown");
  EXPECT_TRUE(seen.groups.contains("host/depth"));
  EXPECT_TRUE(seen.groups.contains("shown/show"));
  EXPECT_TRUE(seen.path.empty()) << "a group stays open";
  effect.set("fault", "leaves_pass");
  EXPECT_EQ(numberOf([&] { record(effect, depth, inputs); }), 3203);
  EXPECT_TRUE(seen.path.empty()) << "a group stays open after a failure";
  char label[256] = {};
  glGetObjectLabel(GL_TEXTURE, static_cast<GLuint>(effect.output("shown").image), sizeof(label),
                   nullptr, label);
  EXPECT_STREQ(label, "grisaille: shown");
  glDebugMessageCallback(nullptr, nullptr);
}

}  // namespace
}  // namespace grisaille::tests
