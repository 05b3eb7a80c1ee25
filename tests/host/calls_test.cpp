// SPDX-License-Identifier: MIT
// Counts the library's calls of the graphics APIs. From the second frame on, recording creates no
// object and allocates no memory, it never waits, and it queries no state if the host asks for
// that.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "effects/sspm/shot.h"
#include "examples/vulkan/context.h"
#include "tests/host/allocations.h"
#include "tests/host/hosts.h"
#include "tests/host/opengl_host.h"
#include "tests/host/seen.h"
#include "tests/host/vulkan_host.h"

namespace grisaille::tests {
namespace {

constexpr uint32_t kWidth = 48, kHeight = 32;

// Calls by the function's name, while `counting`.
std::map<std::string, size_t, std::less<>> calls;
bool counting = false;

void note(std::string_view name) {
  if (!counting) return;
  const auto found = calls.find(name);
  if (found != calls.end()) {
    ++found->second;
  } else {
    calls.emplace(name, 1);
  }
}

std::string summary(const std::map<std::string, size_t, std::less<>>& of) {
  std::string text;
  for (const auto& [name, count] : of) text += name + " x " + std::to_string(count) + " ";
  return text;
}

// --- OpenGL: libepoxy calls each function through a pointer, which a test may replace.

// `Pointer`: libepoxy's.
template <auto& Pointer, typename Function>
struct Counted;
template <auto& Pointer, typename Result, typename... Arguments>
struct Counted<Pointer, Result (*)(Arguments...)> {
  static inline Result (*real)(Arguments...) = nullptr;
  static inline const char* name = nullptr;

  static Result call(Arguments... arguments) {
    note(name);
    // At its first call, libepoxy's stub looks the function up, stores it in the pointer, and calls
    // it through the pointer.
    struct Through {
      Through() { Pointer = real; }
      ~Through() {
        real = Pointer;
        Pointer = &call;
      }
    } through;
    return real(arguments...);
  }
  static void install(const char* as) {
    if (Pointer == &call) return;
    name = as;
    real = Pointer;
    Pointer = &call;
  }
};

#define COUNT(function) Counted<epoxy_##function, decltype(epoxy_##function)>::install(#function)
void installGl() {
  // Waits.
  COUNT(glClientWaitSync);
  COUNT(glWaitSync);
  COUNT(glFinish);
  // Queries of state.
  COUNT(glGetIntegerv);
  COUNT(glGetIntegeri_v);
  COUNT(glGetInteger64i_v);
  COUNT(glGetInteger64v);
  COUNT(glGetBooleanv);
  COUNT(glGetFloatv);
  COUNT(glGetError);
  COUNT(glIsEnabled);
  COUNT(glIsTexture);
  COUNT(glGetTextureParameteriv);
  COUNT(glGetTextureLevelParameteriv);
  COUNT(glGetProgramiv);
  // Objects and memory.
  COUNT(glCreateBuffers);
  COUNT(glNamedBufferStorage);
  COUNT(glNamedBufferData);
  COUNT(glMapNamedBufferRange);
  COUNT(glCreateTextures);
  COUNT(glGenTextures);
  COUNT(glTextureView);
  COUNT(glTextureStorage2D);
  COUNT(glTextureStorage3D);
  COUNT(glCreateSamplers);
  COUNT(glCreateFramebuffers);
  COUNT(glCreateShader);
  COUNT(glCreateProgram);
  COUNT(glCompileShader);
  COUNT(glLinkProgram);
  // Work, to see that calls are counted.
  COUNT(glDispatchCompute);
}

// --- Vulkan: the host hands the library the function that looks up all others.

// `Function`: the declared function, which tells functions of one type apart.
template <auto Function, typename Type>
struct Hook;
template <auto Function, typename Result, typename... Arguments>
struct Hook<Function, Result (*)(Arguments...)> {
  static inline Result (*real)(Arguments...) = nullptr;
  static inline const char* name = nullptr;

  static Result call(Arguments... arguments) {
    note(name);
    return real(arguments...);
  }
};

PFN_vkGetDeviceProcAddr realDeviceProc = nullptr;

#define HOOKS(X)                 \
  X(vkAllocateMemory)            \
  X(vkCreateBuffer)              \
  X(vkCreateImage)               \
  X(vkCreateImageView)           \
  X(vkCreateSampler)             \
  X(vkCreateDescriptorPool)      \
  X(vkCreateDescriptorSetLayout) \
  X(vkCreatePipelineLayout)      \
  X(vkCreateShaderModule)        \
  X(vkCreateCommandPool)         \
  X(vkCreateFence)               \
  X(vkCreateSemaphore)           \
  X(vkMapMemory)                 \
  X(vkWaitForFences)             \
  X(vkWaitSemaphores)            \
  X(vkQueueWaitIdle)             \
  X(vkDeviceWaitIdle)            \
  X(vkQueueSubmit)               \
  X(vkQueueSubmit2)              \
  X(vkFreeMemory)                \
  X(vkCmdDispatch)

// The pipeline cache of the last call.
VkPipelineCache usedCache = VK_NULL_HANDLE;
PFN_vkCreateComputePipelines realCreatePipelines = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL createPipelines(VkDevice device, VkPipelineCache cache,
                                               uint32_t count,
                                               const VkComputePipelineCreateInfo* infos,
                                               const VkAllocationCallbacks* allocator,
                                               VkPipeline* pipelines) {
  note("vkCreateComputePipelines");
  usedCache = cache;
  return realCreatePipelines(device, cache, count, infos, allocator, pipelines);
}

// Names and open labels, as a debugger shows them.
std::vector<std::string> names, labels;
size_t openLabels = 0, deepestLabels = 0;
PFN_vkSetDebugUtilsObjectNameEXT realSetName = nullptr;
PFN_vkCmdBeginDebugUtilsLabelEXT realBeginLabel = nullptr;
PFN_vkCmdEndDebugUtilsLabelEXT realEndLabel = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL setName(VkDevice device, const VkDebugUtilsObjectNameInfoEXT* info) {
  names.emplace_back(info->pObjectName);
  return realSetName(device, info);
}
VKAPI_ATTR void VKAPI_CALL beginLabel(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* info) {
  if (!counting) labels.emplace_back(info->pLabelName);
  deepestLabels = std::max(deepestLabels, ++openLabels);
  realBeginLabel(commands, info);
}
VKAPI_ATTR void VKAPI_CALL endLabel(VkCommandBuffer commands) {
  --openLabels;
  realEndLabel(commands);
}

// While it is set, barriers change layouts alone: they make nothing wait.
bool withoutWaits = false;
PFN_vkCmdPipelineBarrier2 realBarrier = nullptr;

VKAPI_ATTR void VKAPI_CALL barrier(VkCommandBuffer commands, const VkDependencyInfo* info) {
  if (!withoutWaits) return realBarrier(commands, info);
  std::vector<VkImageMemoryBarrier2> images(
      info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
  for (VkImageMemoryBarrier2& image : images) {
    image.srcStageMask = image.dstStageMask = VK_PIPELINE_STAGE_2_NONE;
    image.srcAccessMask = image.dstAccessMask = VK_ACCESS_2_NONE;
  }
  VkDependencyInfo weak{};
  weak.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  weak.imageMemoryBarrierCount = static_cast<uint32_t>(images.size());
  weak.pImageMemoryBarriers = images.data();
  realBarrier(commands, &weak);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
  const PFN_vkVoidFunction real = realDeviceProc(device, name);
  if (real == nullptr) return nullptr;
#define TRY(function)                                        \
  if (std::string_view(name) == #function) {                 \
    using One = Hook<&function, PFN_##function>;             \
    One::real = reinterpret_cast<PFN_##function>(real);      \
    One::name = #function;                                   \
    return reinterpret_cast<PFN_vkVoidFunction>(&One::call); \
  }
  HOOKS(TRY)
#undef TRY
  if (std::string_view(name) == "vkCreateComputePipelines") {
    realCreatePipelines = reinterpret_cast<PFN_vkCreateComputePipelines>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&createPipelines);
  }
  if (std::string_view(name) == "vkCmdPipelineBarrier2") {
    realBarrier = reinterpret_cast<PFN_vkCmdPipelineBarrier2>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&barrier);
  }
  return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction real = vkGetInstanceProcAddr(instance, name);
  if (real == nullptr) return nullptr;
  const auto hook = [&](const char* function, auto& own, auto* replacement) -> PFN_vkVoidFunction {
    if (std::string_view(name) != function) return nullptr;
    own = reinterpret_cast<std::remove_reference_t<decltype(own)>>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(replacement);
  };
  for (const PFN_vkVoidFunction found :
       {hook("vkSetDebugUtilsObjectNameEXT", realSetName, &setName),
        hook("vkCmdBeginDebugUtilsLabelEXT", realBeginLabel, &beginLabel),
        hook("vkCmdEndDebugUtilsLabelEXT", realEndLabel, &endLabel)}) {
    if (found != nullptr) return found;
  }
  if (std::string_view(name) != "vkGetDeviceProcAddr") return real;
  realDeviceProc = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(&deviceProc);
}

class Calls : public ::testing::TestWithParam<TestDevice> {
 protected:
  bool isVulkan() const { return GetParam().backend == "vulkan"; }
  const char* work() const { return isVulkan() ? "vkCmdDispatch" : "glDispatchCompute"; }

  host::Device device(Host& host, uint32_t framesInFlight, grisaille_host_state state) const {
    if (!isVulkan())
      return host::Device::opengl({.state = state, .framesInFlight = framesInFlight});
    host::VulkanSpec spec = vulkanSpec(host);
    spec.framesInFlight = framesInFlight;
    spec.getInstanceProcAddr = reinterpret_cast<void (*)()>(&instanceProc);
    return host::Device::vulkan(spec);
  }

  // Records two effects over many frames. Returns the calls after the first frame.
  std::map<std::string, size_t, std::less<>> after(uint32_t framesInFlight,
                                                   grisaille_host_state state) {
    const std::unique_ptr<Host> host = makeHost(GetParam(), false);
    const host::Device device = this->device(*host, framesInFlight, state);
    if (!isVulkan()) installGl();
    const Eye eye{.viewFromWorld = glm::lookAt(glm::dvec3(1.2, 1.6, 3.1),
                                               glm::dvec3(0.1, 0.5, -0.3), glm::dvec3(0, 1, 0)),
                  .angle = 0.8};
    const Seen seen = see(eye, kWidth, kHeight);
    const host::Texture depth = host->texture(device, Texels::kFloat1, kWidth, kHeight,
                                              {seen.view.begin(), seen.view.end()});
    const host::EffectSpec spec{.effect = "ssao", .width = kWidth, .height = kHeight};
    host::Effect slices(device, spec), classic(device, spec);
    slices.set("history", 8);
    slices.set("resolution", "half");
    classic.set("estimator", "classic");
    const glm::dmat4 projection = projectionOf(eye, double{1} * kWidth / kHeight, {});
    const host::Camera camera(&eye.viewFromWorld[0][0], &projection[0][0]);
    calls = {{work(), 0}};  // counting the work allocates nothing
    allocations_ = 0;
    for (uint32_t i = 0; i < 2 * framesInFlight + 3; ++i) {
      host->frame([&](void* commands, uint64_t number) {
        const AllocationCount count;
        counting = i > 0;
        for (host::Effect* effect : {&slices, &classic}) {
          effect->record({.number = number,
                          .commandBuffer = commands,
                          .camera = camera,
                          .depth = depth,
                          .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
        }
        counting = false;
        // In the second frame, the history reads a texture of another format, for which llvmpipe
        // compiles the shader again.
        if (i > (isVulkan() ? 0 : 1)) allocations_ += count.soFar();
      });
      if (!isVulkan()) glFinish();  // the GPU is not behind
    }
    EXPECT_EQ(host->complaints(), 0);
    return calls;
  }

  size_t allocations_ = 0;  // of C++ memory, in the last after()
};
GRISAILLE_IN_EVERY_HOST(Calls);

TEST_P(Calls, RecordingNeitherCreatesNorWaits) {
  for (uint32_t framesInFlight = 1; framesInFlight <= 16; ++framesInFlight) {
    auto made = after(framesInFlight, GRISAILLE_HOST_STATE_KEPT);
    EXPECT_GT(made[work()], 0u) << "calls are not counted";
    made.erase(work());
    EXPECT_TRUE(made.empty()) << framesInFlight << " frames in flight: " << summary(made);
    EXPECT_EQ(SANITIZED ? 0 : allocations_, 0u) << framesInFlight << " frames in flight";
  }
}

// Stereo, and a resolution that changes each frame, once every size has been seen.
TEST_P(Calls, StereoAndDynamicResolutionNeitherCreateNorWait) {
  for (uint32_t framesInFlight = 1; framesInFlight <= 16; ++framesInFlight) {
    const std::unique_ptr<Host> host = makeHost(GetParam(), false);
    const host::Device device = this->device(*host, framesInFlight, GRISAILLE_HOST_STATE_KEPT);
    if (!isVulkan()) installGl();
    const Eye eyes[] = {{.angle = 0.8, .shift = {-0.05, 0}}, {.angle = 0.8, .shift = {0.05, 0}}};
    const glm::dmat4 view(1), left = projectionOf(eyes[0], 1.5, {}),
                              right = projectionOf(eyes[1], 1.5, {});
    const host::Camera cameras[] = {{&view[0][0], &left[0][0]}, {&view[0][0], &right[0][0]}};
    const host::Texture depth =
        host->texture(device, Texels::kFloat1, kWidth, kHeight,
                      std::vector<float>(size_t{2} * kWidth * kHeight, 2.0f), 2);
    constexpr grisaille_host_rectangle kParts[] = {
        {0, 0, 48, 32}, {0, 0, 45, 30}, {4, 2, 36, 24}, {0, 8, 24, 16}};
    host::Effect effect(device, {.effect = "ssao",
                                 .width = kWidth,
                                 .height = kHeight,
                                 .outputs = {"ao", "bent_normal"},
                                 .layers = 2,
                                 .keptSizes = 3});
    effect.set("history", 8);
    effect.set("resolution", "half");
    calls = {{work(), 0}};
    size_t allocations = 0;
    // The effect gives up what several recordings of a size have not used, and the device frees it
    // when the frames in flight have finished.
    const uint32_t warm = 6 * std::size(kParts) + framesInFlight;
    for (uint32_t i = 0; i < warm + 2 * framesInFlight + 5; ++i) {
      host->frame([&](void* commands, uint64_t number) {
        const AllocationCount count;
        counting = i >= warm;
        effect.record({.number = number,
                       .commandBuffer = commands,
                       .camera = cameras[0],
                       .depth = depth,
                       .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                       .rectangle = kParts[i % std::size(kParts)]});
        counting = false;
        if (i >= warm) allocations += count.soFar();
      });
      if (!isVulkan()) glFinish();  // the GPU is not behind
    }
    EXPECT_EQ(host->complaints(), 0);
    EXPECT_GT(calls[work()], 0u) << "calls are not counted";
    calls.erase(work());
    EXPECT_TRUE(calls.empty()) << framesInFlight << " frames in flight: " << summary(calls);
    EXPECT_EQ(SANITIZED ? 0 : allocations, 0u) << framesInFlight << " frames in flight";
  }
}

// With the host's functions, the library allocates and frees no memory of its own.
TEST_P(Calls, TheHostsFunctionsReplaceTheDriversMemory) {
  if (!isVulkan()) GTEST_SKIP() << "OpenGL's drivers allocate";
  const std::unique_ptr<Host> host = makeHost(GetParam(), false);
  host::VulkanSpec spec = vulkanSpec(*host);
  const grisaille_host_allocator functions = {
      .struct_size = sizeof(grisaille_host_allocator),
      .reserved = 0,
      .context = &spec,
      .allocate = [](void* of, const grisaille_host_memory_request* request,
                     grisaille_host_memory* out) -> int {
        return allocateFor(*static_cast<host::VulkanSpec*>(of), *request, *out);
      },
      .free =
          [](void* of, const grisaille_host_memory* memory) {
            vkFreeMemory(static_cast<VkDevice>(static_cast<host::VulkanSpec*>(of)->device),
                         reinterpret_cast<VkDeviceMemory>(memory->memory), nullptr);
          }};
  spec.getInstanceProcAddr = reinterpret_cast<void (*)()>(&instanceProc);
  spec.allocator = &functions;
  calls.clear();
  counting = true;
  {
    const host::Device made = host::Device::vulkan(spec);
    const glm::dmat4 view(1), projection = projectionOf({.angle = 1}, 1.5, {});
    const host::Texture depth = host->texture(made, Texels::kFloat1, kWidth, kHeight,
                                              std::vector<float>(kWidth * kHeight, 2.0f));
    host::Effect effect(made, {.effect = "ssao", .width = kWidth, .height = kHeight});
    host->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = host::Camera(&view[0][0], &projection[0][0]),
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
    });
  }
  counting = false;
  EXPECT_GT(calls["vkCreateImage"], 0u) << "calls are not counted";
  EXPECT_EQ(calls["vkAllocateMemory"], 0u);
  EXPECT_EQ(calls["vkFreeMemory"], 0u);
  EXPECT_EQ(calls["vkMapMemory"], 0u);
}

// Shows a plain surface, in a host whose instance has VK_EXT_debug_utils.
void showPlain(Host& host, int frames) {
  host::VulkanSpec spec = vulkanSpec(host);
  spec.getInstanceProcAddr = reinterpret_cast<void (*)()>(&instanceProc);
  const host::Device device = host::Device::vulkan(spec);
  const glm::dmat4 view(1), projection = projectionOf({.angle = 1}, 1.5, {});
  const host::Texture depth = host.texture(device, Texels::kFloat1, kWidth, kHeight,
                                           std::vector<float>(kWidth * kHeight, 2.0f));
  host::Effect effect(device, {.effect = "ssao", .width = kWidth, .height = kHeight});
  effect.set("history", 4);
  for (int i = 0; i < frames; ++i) {
    host.frame([&](void* commands, uint64_t number) {
      const AllocationCount count;
      counting = i > 0;
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = host::Camera(&view[0][0], &projection[0][0]),
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
      counting = false;
    });
  }
}

TEST_P(Calls, VulkanLabelsAndNamesAreShown) {
  if (!isVulkan()) GTEST_SKIP() << "see Services.OpenGlGroupsAndNamesAreShown";
  const std::unique_ptr<Host> host = makeHost(GetParam(), true);
  names.clear();
  labels.clear();
  openLabels = deepestLabels = 0;
  showPlain(*host, 1);
  const auto has = [](const std::vector<std::string>& texts, const char* text) {
    return std::ranges::find(texts, text) != texts.end();
  };
  ASSERT_FALSE(labels.empty());
  EXPECT_EQ(labels[0], "grisaille: ssao");
  EXPECT_TRUE(has(labels, "host/depth"));
  EXPECT_TRUE(has(labels, "ssao/occlusion"));
  EXPECT_EQ(deepestLabels, 2u);
  EXPECT_EQ(openLabels, 0u) << "a label stays open";
  EXPECT_TRUE(has(names, "grisaille: ao"));
  EXPECT_TRUE(has(names, "grisaille: upload"));
  EXPECT_TRUE(std::ranges::all_of(
      names, [](const std::string& name) { return name.starts_with("grisaille: "); }));
  EXPECT_EQ(host->complaints(), 0);
}

// Silence of synchronization validation means something: it complains of the library's commands
// when their barriers make nothing wait.
TEST_P(Calls, WithoutBarriersTheValidationComplains) {
  if (!isVulkan()) GTEST_SKIP() << "OpenGL has no such validation";
  for (const bool without : {false, true}) {
    const std::unique_ptr<Host> host = makeHost(GetParam(), true);
    testing::internal::CaptureStderr();
    withoutWaits = without;
    showPlain(*host, 2);
    withoutWaits = false;
    const std::string told = testing::internal::GetCapturedStderr();
    if (without) {
      EXPECT_NE(told.find("_AFTER_WRITE"), std::string::npos) << told;
      EXPECT_GT(host->complaints(), 0);
    } else {
      EXPECT_EQ(told, "");
      EXPECT_EQ(host->complaints(), 0);
    }
  }
}

// After prepare(), no recording compiles anything. A second effect with the same values compiles
// nothing either: both share their pipelines.
TEST_P(Calls, PreparedEffectsCompileNothing) {
  const std::unique_ptr<Host> host = makeHost(GetParam(), false);
  const host::Device device = this->device(*host, 2, GRISAILLE_HOST_STATE_RESTORED);
  if (!isVulkan()) installGl();
  const glm::dmat4 view(1), perspective = projectionOf({.angle = 1}, 1.5, {}),
                            parallel = projectionOf({.height = 2}, 1.5, {.far = 9});
  const std::vector<float> metres(size_t{kWidth} * kHeight, 2.0f);
  const host::Texture depth = host->texture(device, Texels::kFloat1, kWidth, kHeight, metres);
  const host::Texture normal = host->texture(device, Texels::kFloat4, kWidth, kHeight,
                                             std::vector<float>(4 * metres.size(), 0.5f));
  const auto compiled = [&] {
    size_t sum = 0;
    for (const char* name : {"vkCreateShaderModule", "vkCreateComputePipelines", "glLinkProgram"}) {
      sum += calls[name];
    }
    return sum;
  };
  using Set = std::pair<const char*, const char*>;
  const std::vector<std::vector<Set>> settings = {
      {}, {{"resolution", "half"}, {"history", "8"}}, {{"estimator", "classic"}}};
  for (const bool orthographic : {false, true}) {
    for (const std::vector<Set>& values : settings) {
      const host::EffectSpec spec{
          .effect = "ssao", .width = kWidth, .height = kHeight, .outputs = {"ao", "bent_normal"}};
      host::Effect one(device, spec), other(device, spec);
      for (const auto& [key, value] : values) one.set(key, value), other.set(key, value);
      std::vector<std::pair<uint32_t, uint32_t>> steps;
      calls.clear();
      counting = true;
      one.prepare(
          orthographic, GRISAILLE_READS(GRISAILLE_NORMAL),
          [](void* context, uint32_t done, uint32_t count) {
            static_cast<decltype(steps)*>(context)->emplace_back(done, count);
          },
          &steps);
      EXPECT_GT(compiled(), 1u);
      ASSERT_GT(steps.size(), 1u);
      for (uint32_t i = 0; i < steps.size(); ++i) {
        EXPECT_EQ(steps[i], std::pair(i + 1, static_cast<uint32_t>(steps.size())));
      }
      calls.clear();
      const host::Camera camera(&view[0][0], orthographic ? &parallel[0][0] : &perspective[0][0]);
      for (int frame = 0; frame < 3; ++frame) {
        host->frame([&](void* commands, uint64_t number) {
          for (host::Effect* effect : {&one, &other}) {
            effect->record({.number = number,
                            .commandBuffer = commands,
                            .camera = camera,
                            .depth = depth,
                            .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                            .normal = &normal});
          }
        });
      }
      counting = false;
      EXPECT_EQ(compiled(), 0u) << orthographic << " " << (values.empty() ? "" : values[0].first);
      EXPECT_GT(calls[work()], 0u);
    }
  }
}

// Paint depends on what rays find: here, on a wall that every ray meets.
TEST_P(Calls, PreparedPaintCompilesNothing) {
  const std::unique_ptr<Host> host = makeHost(GetParam(), false);
  host::Device device = this->device(*host, 2, GRISAILLE_HOST_STATE_RESTORED);
  if (!isVulkan()) installGl();
  device.setRays(
      [](void*, const grisaille_ray* rays, uint64_t count, grisaille_hit* hits) {
        for (uint64_t i = 0; i < count; ++i) {
          const double along = (-2 - rays[i].origin[2]) / double{rays[i].direction[2]};
          if (!(along > 0 && along < double{rays[i].reach})) continue;
          hits[i] = {.kind = GRISAILLE_HIT_SURFACE,
                     .distance = static_cast<float>(along),
                     .normal = {0, 0, 1}};
        }
      },
      nullptr);
  const glm::dmat4 view(1), projection = projectionOf({.angle = 1}, 1.5, {});
  const std::vector<float> metres(size_t{kWidth} * kHeight, 2.0f);
  const host::Texture depth = host->texture(device, Texels::kFloat1, kWidth, kHeight, metres);
  host::Effect effect(device, {.effect = "sspm", .width = kWidth, .height = kHeight});
  effect.setObjects<sspm::Shot>(std::vector<sspm::Shot>{{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, 0.3f}});
  effect.prepare();
  calls.clear();
  for (int frame = 0; frame < 4; ++frame) {
    host->frame([&](void* commands, uint64_t number) {
      counting = true;
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = host::Camera(&view[0][0], &projection[0][0]),
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW});
      counting = false;
    });
  }
  for (const char* name : {"vkCreateShaderModule", "vkCreateComputePipelines", "glLinkProgram"}) {
    EXPECT_EQ(calls[name], 0u) << name;
  }
  const std::vector<float> paint = host->read(effect.output("paint"));
  EXPECT_GT(paint[4 * (kHeight / 2 * kWidth + kWidth / 2) + 3], 0.5f) << "no paint";
}

TEST_P(Calls, TheHostsPipelineCacheIsUsed) {
  if (!isVulkan()) GTEST_SKIP() << "OpenGL has no such cache";
  const std::unique_ptr<Host> host = makeHost(GetParam(), false);
  host::VulkanSpec spec = vulkanSpec(*host);
  const auto device = static_cast<VkDevice>(spec.device);
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  VkPipelineCache cache = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreatePipelineCache(device, &info, nullptr, &cache), VK_SUCCESS);
  spec.getInstanceProcAddr = reinterpret_cast<void (*)()>(&instanceProc);
  spec.pipelineCache = host::number(cache);
  {
    const host::Device made = host::Device::vulkan(spec);
    host::Effect effect(made, {.effect = "ssao", .width = kWidth, .height = kHeight});
    effect.prepare();
  }
  EXPECT_EQ(usedCache, cache);
  vkDestroyPipelineCache(device, cache, nullptr);
}

// Unless the host restores state itself, the library queries the state that it changes.
TEST_P(Calls, QueriesAreForStateThatTheLibraryRestores) {
  if (isVulkan()) GTEST_SKIP() << "Vulkan has no such state";
  auto made = after(2, GRISAILLE_HOST_STATE_RESTORED);
  EXPECT_GT(made["glGetIntegerv"], 0u);
  for (const char* query : {"glGetIntegerv", "glGetIntegeri_v", "glGetInteger64i_v"}) {
    made.erase(query);
  }
  made.erase(work());
  EXPECT_TRUE(made.empty()) << summary(made);
}

}  // namespace
}  // namespace grisaille::tests
