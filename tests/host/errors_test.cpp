// SPDX-License-Identifier: MIT
// Invalid input from hosts gives an error number and a message, and changes nothing.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "effects/sspm/shot.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"
#include "tests/host/vulkan_host.h"

namespace grisaille::tests {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr uint32_t kSide = 16;

template <typename Struct>
Struct sized() {
  Struct made = {};
  made.struct_size = sizeof(Struct);
  return made;
}

void expectError(int result, int number, const std::string& mention) {
  EXPECT_EQ(result, number) << grisaille_host_last_error();
  const std::string line = grisaille_host_last_error();
  EXPECT_EQ(line.rfind("error E" + std::to_string(number) + ": ", 0), 0u) << line;
  EXPECT_NE(line.find(mention), std::string::npos) << line;
}

class Errors : public ::testing::TestWithParam<TestDevice> {
 protected:
  Errors()
      : host_(makeHost(GetParam())),
        device_(host_->device()),
        depth_(host_->texture(device_, Texels::kFloat1, kSide, kSide,
                              std::vector<float>(kSide * kSide, 2.0f))),
        camera_(sized<grisaille_host_camera>()) {
    for (const int i : {0, 5, 10, 15}) camera_.view[i] = 1;
    const glm::dmat4 projection = projectionOf({.angle = 1}, 1, {.near = 0.1});
    std::memcpy(camera_.projection, &projection, sizeof(camera_.projection));
  }
  ~Errors() override { EXPECT_EQ(host_->complaints(), 0); }

  grisaille_host_effect_desc effectDesc() const {
    auto desc = sized<grisaille_host_effect_desc>();
    desc.width = desc.height = kSide;
    desc.effect = "ssao";
    return desc;
  }

  // A valid frame.
  grisaille_host_frame frameOf(void* commands, uint64_t number) const {
    auto frame = sized<grisaille_host_frame>();
    frame.number = number;
    frame.command_buffer = commands;
    frame.camera = &camera_;
    frame.depth = depth_.handle();
    frame.depth_kind = GRISAILLE_HOST_DEPTH_VIEW;
    return frame;
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
  host::Texture depth_;
  grisaille_host_camera camera_;
};
GRISAILLE_IN_EVERY_HOST(Errors);

TEST_P(Errors, OfTheLibrary) {
  EXPECT_EQ(grisaille_host_version(), GRISAILLE_HOST_VERSION);
  expectError(grisaille_host_effects(nullptr, nullptr, nullptr), 5601, "device is null");
  const grisaille_effect_desc* const* list = nullptr;
  expectError(grisaille_host_effects(device_.handle(), &list, nullptr), 5601, "count is null");
}

TEST_P(Errors, OfDevices) {
  grisaille_host_device* made = device_.handle();
  expectError(grisaille_host_device_opengl(nullptr, &made), 5601, "opengl is null");
  EXPECT_EQ(made, nullptr) << "a failed call must leave its result unchanged";
  expectError(grisaille_host_device_opengl(nullptr, nullptr), 5601, "out is null");
  auto opengl = sized<grisaille_host_opengl>();
  opengl.state = 2;
  expectError(grisaille_host_device_opengl(&opengl, &made), 5611, "opengl.state is 2");
  opengl.state = 0;
  opengl.frames_in_flight = 17;
  expectError(grisaille_host_device_opengl(&opengl, &made), 5611, "frames_in_flight is 17");
  opengl.frames_in_flight = 0;
  opengl.flags = 7;
  expectError(grisaille_host_device_opengl(&opengl, &made), 5611, "opengl.flags has the bits 0x6");
  opengl.struct_size = 3;
  expectError(grisaille_host_device_opengl(&opengl, &made), 5602, "struct_size is 3");

  auto vulkan = sized<grisaille_host_vulkan>();
  expectError(grisaille_host_device_vulkan(nullptr, &made), 5601, "vulkan is null");
  expectError(grisaille_host_device_vulkan(&vulkan, &made), 5611, "frames_in_flight is 0");
  vulkan.frames_in_flight = 17;
  expectError(grisaille_host_device_vulkan(&vulkan, &made), 5611, "frames_in_flight is 17");
  vulkan.frames_in_flight = 2;
  expectError(grisaille_host_device_vulkan(&vulkan, &made), 5601, "vulkan.instance is null");
  vulkan.instance = vulkan.physical_device = &vulkan;
  expectError(grisaille_host_device_vulkan(&vulkan, &made), 5601, "vulkan.device is null");
  vulkan.flags = 8;
  expectError(grisaille_host_device_vulkan(&vulkan, &made), 5611, "vulkan.flags has the bits 0x8");

  expectError(grisaille_host_device_destroy(device_.handle()), 5608, "1 textures and 0 effects");
  EXPECT_EQ(grisaille_host_device_destroy(nullptr), 0);
}

TEST_P(Errors, OfVulkanDevices) {
  if (GetParam().backend != "vulkan") GTEST_SKIP();
  host::VulkanSpec spec = vulkanSpec(*host_);
  const auto expectRefused = [&](int number, const std::string& mention) {
    try {
      host::Device::vulkan(spec);
      FAIL() << mention;
    } catch (const host::Failure& failure) {
      EXPECT_EQ(failure.number(), number) << failure.what();
      EXPECT_NE(std::string(failure.what()).find(mention), std::string::npos) << failure.what();
    }
  };
  spec.queueFamily = 99;
  expectRefused(5603, "queue family 99");
  spec.queueFamily = 0;
  spec.effectFolder = "/nowhere";
  expectRefused(3106, "/nowhere");
}

TEST_P(Errors, OfTextures) {
  const host::TextureSpec sound = host_->described();
  grisaille_host_texture* made = nullptr;
  auto desc = sized<grisaille_host_texture_desc>();
  const auto reset = [&] {
    desc.image = sound.image;
    desc.format = sound.format;
    desc.layout = sound.layout;
    desc.width = sound.width;
    desc.height = sound.height;
    desc.reserved = 0;
  };
  const auto expectRefused = [&](int number, const std::string& mention) {
    expectError(grisaille_host_texture_wrap(device_.handle(), &desc, &made), number, mention);
    EXPECT_EQ(made, nullptr);
    reset();
  };
  reset();
  expectError(grisaille_host_texture_wrap(nullptr, &desc, &made), 5601, "device is null");
  expectError(grisaille_host_texture_wrap(device_.handle(), nullptr, &made), 5601, "desc is null");
  expectError(grisaille_host_texture_wrap(device_.handle(), &desc, nullptr), 5601, "out is null");
  desc.reserved = 1;
  expectRefused(5611, "reserved");
  desc.image = 0;
  expectRefused(5605, GetParam().backend == "vulkan" ? "VK_NULL_HANDLE" : "0 names no texture");
  if (GetParam().backend == "vulkan") {
    desc.format = 99999;
    expectRefused(5605, "VkFormat 99999");
    desc.layout = 0;
    expectRefused(5605, "layout 0");
    desc.width = 0;
    expectRefused(5605, "0 x 16");
    desc.height = 1u << 30;
    expectRefused(5605, "16 x 1073741824");
  } else {
    desc.image = 4711;
    expectRefused(5605, "4711 names no texture");
    desc.image = 1ull << 32 | sound.image;
    expectRefused(5605, "names no texture");
    desc.width = 3;
    expectRefused(5605, "has 16 x 16 pixels, not 3 x 0");
  }
  EXPECT_EQ(grisaille_host_texture_destroy(nullptr), 0);
}

TEST_P(Errors, OfEffects) {
  grisaille_host_effect* made = nullptr;
  const auto expectRefused = [&](const grisaille_host_effect_desc& desc, int number,
                                 const std::string& mention) {
    expectError(grisaille_host_effect_create(device_.handle(), &desc, &made), number, mention);
    EXPECT_EQ(made, nullptr);
  };
  grisaille_host_effect_desc desc = effectDesc();
  expectError(grisaille_host_effect_create(nullptr, &desc, &made), 5601, "device is null");
  expectError(grisaille_host_effect_create(device_.handle(), nullptr, &made), 5601, "desc is null");
  expectError(grisaille_host_effect_create(device_.handle(), &desc, nullptr), 5601, "out is null");
  desc.struct_size = 1;
  expectRefused(desc, 5602, "struct_size is 1");
  desc = effectDesc();
  desc.effect = nullptr;
  expectRefused(desc, 5601, "desc.effect is null");
  desc.effect = "sao";
  expectRefused(desc, 3201, "nearest is ssao");
  desc = effectDesc();
  desc.width = 0;
  expectRefused(desc, 1105, "0 x 16");
  desc.width = 16385;
  expectRefused(desc, 1105, "16385 x 16");
  desc = effectDesc();
  desc.rows = 2;
  expectRefused(desc, 5611, "desc.rows is 2");
  desc = effectDesc();
  desc.output_count = 1;
  expectRefused(desc, 5601, "desc.outputs is null");
  const char* outputs[] = {"shade"};
  desc.outputs = outputs;
  expectRefused(desc, 5102, "it has ao, bent_normal, tint");
  outputs[0] = nullptr;
  expectRefused(desc, 5601, "an entry of desc.outputs");
  desc = effectDesc();
  desc.layers = 17;
  expectRefused(desc, 5611, "desc.layers is 17");
  desc = effectDesc();
  desc.kept_sizes = 257;
  expectRefused(desc, 5611, "desc.kept_sizes is 257");
  desc = effectDesc();
  desc.setting_count = 1;
  expectRefused(desc, 5601, "desc.settings is null");
  grisaille_host_setting setting = {.key = "radus", .text = "1"};
  desc.settings = &setting;
  expectRefused(desc, 3301, "radius");
  setting = {.key = "radius", .text = "far"};
  expectRefused(desc, 3303, "far");
  setting = {.key = "radius", .text = "-1"};
  expectRefused(desc, 3302, "radius");
  setting = {.key = nullptr, .text = "1"};
  expectRefused(desc, 5601, "the key of a setting");
  setting = {.key = "radius", .text = nullptr};
  expectRefused(desc, 5601, "the text of a setting");
  EXPECT_EQ(grisaille_host_effect_destroy(nullptr), 0);
}

TEST_P(Errors, OfParametersSizesAndOutputs) {
  host::Effect effect(device_, {.effect = "ssao", .width = kSide, .height = kSide});
  grisaille_host_effect* const one = effect.handle();
  double value = 0;
  expectError(grisaille_host_effect_set(nullptr, "radius", 1), 5601, "effect is null");
  expectError(grisaille_host_effect_set(one, nullptr, 1), 5601, "key is null");
  expectError(grisaille_host_effect_set(one, "radus", 1), 3301, "radius");
  expectError(grisaille_host_effect_set(one, "radius", -1), 3302, "radius");
  expectError(grisaille_host_effect_set(one, "radius", kNan), 3303, "radius");
  expectError(grisaille_host_effect_set_text(nullptr, "radius", "1"), 5601, "effect is null");
  expectError(grisaille_host_effect_set_text(one, nullptr, "1"), 5601, "key is null");
  expectError(grisaille_host_effect_set_text(one, "radius", nullptr), 5601, "text is null");
  expectError(grisaille_host_effect_set_text(one, "radius", "far"), 3303, "far");
  expectError(grisaille_host_effect_get(nullptr, "radius", &value), 5601, "effect is null");
  expectError(grisaille_host_effect_get(one, nullptr, &value), 5601, "key is null");
  expectError(grisaille_host_effect_get(one, "radius", nullptr), 5601, "value is null");
  expectError(grisaille_host_effect_get(one, "radus", &value), 3301, "radius");
  expectError(grisaille_host_device_set_rays(nullptr, nullptr), 5601, "device is null");
  auto rays = sized<grisaille_host_rays>();
  rays.reserved = 1;
  expectError(grisaille_host_device_set_rays(device_.handle(), &rays), 5611, "rays.reserved");
  rays.struct_size = 1;
  expectError(grisaille_host_device_set_rays(device_.handle(), &rays), 5602, "struct_size is 1");
  auto depths = sized<grisaille_host_depths>();
  depths.reserved = 1;
  expectError(grisaille_host_device_set_depths(nullptr, &depths), 5601, "device is null");
  expectError(grisaille_host_device_set_depths(device_.handle(), &depths), 5611, "depths.reserved");
  depths.struct_size = 1;
  expectError(grisaille_host_device_set_depths(device_.handle(), &depths), 5602,
              "struct_size is 1");
  expectError(grisaille_host_device_set_pictures(nullptr, nullptr), 5601, "device is null");
  auto pictures = sized<grisaille_host_pictures>();
  pictures.reserved = 1;
  expectError(grisaille_host_device_set_pictures(device_.handle(), &pictures), 5611,
              "pictures.reserved");
  pictures.struct_size = 1;
  expectError(grisaille_host_device_set_pictures(device_.handle(), &pictures), 5602,
              "struct_size is 1");
  expectError(grisaille_host_effect_resize(nullptr, 1, 1), 5601, "effect is null");
  expectError(grisaille_host_effect_resize(one, 0, 1), 1105, "0 x 1");
  auto output = sized<grisaille_host_output>();
  expectError(grisaille_host_effect_output(nullptr, "ao", &output), 5601, "effect is null");
  expectError(grisaille_host_effect_output(one, nullptr, &output), 5601, "key is null");
  expectError(grisaille_host_effect_output(one, "ao", nullptr), 5601, "out is null");
  expectError(grisaille_host_effect_output(one, "shade", &output), 5102, "shade");
  expectError(grisaille_host_effect_output(one, "tint", &output), 5102, "not named");
  output.struct_size = 0;
  expectError(grisaille_host_effect_output(one, "ao", &output), 5602, "struct_size is 0");
}

TEST_P(Errors, OfPoints) {
  const host::Effect without(device_, {.effect = "ssao", .width = kSide, .height = kSide});
  const host::Effect with(device_, {.effect = "sspm", .width = kSide, .height = kSide});
  grisaille_host_effect* const one = with.handle();
  const grisaille_point sound = {.position = {0, 0, 0}, .normal = {0, 1, 0}, .reserved = 0};
  grisaille_drawn drawn[2] = {};
  expectError(grisaille_host_effect_draw_at(nullptr, &sound, 1, drawn), 5601, "effect is null");
  expectError(grisaille_host_effect_draw_at(one, nullptr, 1, drawn), 5601, "points is null");
  expectError(grisaille_host_effect_draw_at(one, &sound, 1, nullptr), 5601, "drawn is null");
  expectError(grisaille_host_effect_draw_at(without.handle(), &sound, 1, drawn), 3209, "ssao");
  EXPECT_EQ(grisaille_host_effect_draw_at(one, nullptr, 0, nullptr), 0);
  EXPECT_EQ(grisaille_host_effect_draw_at(one, &sound, 1, drawn), 0);
  std::vector<grisaille_point> points(2, sound);
  const auto refused = [&](const char* mention) {
    expectError(grisaille_host_effect_draw_at(one, points.data(), 2, drawn), 5611, mention);
    points[1] = sound;
  };
  points[1].position[2] = NAN;
  refused("points[1].position is 0, 0, nan");
  points[1].position[0] = 2e9;
  refused("points[1].position is 2000000000");
  points[1].normal[1] = 1.1f;
  refused("points[1].normal is 0, 1.1, 0");
  points[1].reserved = 1;
  refused("points[1].reserved is 1");
}

TEST_P(Errors, OfObjects) {
  const host::Effect without(device_, {.effect = "ssao", .width = kSide, .height = kSide});
  expectError(grisaille_host_effect_set_objects(nullptr, nullptr, 0, 0), 5601, "effect is null");
  expectError(grisaille_host_effect_set_objects(without.handle(), nullptr, 0, 0), 3205, "ssao");
  expectError(grisaille_host_effect_load_objects(without.handle(), "a.json"), 3205, "ssao");

  host::Effect with(device_, {.effect = "sspm", .width = kSide, .height = kSide});
  grisaille_host_effect* const one = with.handle();
  std::vector<sspm::Shot> shots(3, {{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, 0});
  const uint32_t size = sizeof(sspm::Shot);
  EXPECT_EQ(grisaille_host_effect_set_objects(one, shots.data(), size, 3), 0);
  EXPECT_EQ(grisaille_host_effect_set_objects(one, nullptr, size, 0), 0);
  expectError(grisaille_host_effect_set_objects(one, nullptr, size, 1), 5601, "objects is null");
  for (const uint32_t wrong : {0u, size - 8, size + 8}) {
    expectError(grisaille_host_effect_set_objects(one, shots.data(), wrong, 1), 5611,
                "object_size is " + std::to_string(wrong));
  }
  shots[2].range = -1;
  expectError(grisaille_host_effect_set_objects(one, shots.data(), size, 3), 3401,
              "shots[2].range is -1, out of 0 to 1000000");
  expectError(grisaille_host_effect_load_objects(nullptr, "a.json"), 5601, "effect is null");
  expectError(grisaille_host_effect_load_objects(one, nullptr), 5601, "path is null");
  expectError(grisaille_host_effect_load_objects(one, "/nowhere/a.json"), 3411, "/nowhere/a.json");
  expectError(grisaille_host_effect_load_objects(one, "/dev/zero"), 3411, "/dev/zero");

  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("grisaille_objects_" + std::to_string(getpid()));
  const auto load = [&](const std::string& text) {
    std::ofstream(path) << text;
    return grisaille_host_effect_load_objects(one, path.c_str());
  };
  EXPECT_EQ(load(R"({"version": 1, "shots": []})"), 0);
  expectError(load(R"({"version": 1, "shots": [{}]})"), 3412, "shots[0] has no \"origin\"");
  expectError(load(R"({"version": 2, "shots": []})"), 3413, "version is 2");
  std::filesystem::remove(path);
}

TEST_P(Errors, OfFrames) {
  host::Effect effect(device_, {.effect = "ssao", .width = kSide, .height = kSide});
  host_->frame([&](void* commands, uint64_t number) {
    const auto expectRefused = [&](const grisaille_host_frame& frame, int result,
                                   const std::string& mention) {
      expectError(grisaille_host_effect_record(effect.handle(), &frame), result, mention);
    };
    const grisaille_host_frame sound = frameOf(commands, number);
    expectError(grisaille_host_effect_record(nullptr, &sound), 5601, "effect is null");
    expectError(grisaille_host_effect_record(effect.handle(), nullptr), 5601, "frame is null");
    grisaille_host_frame frame = sound;
    frame.struct_size = 8;
    expectRefused(frame, 5602, "struct_size is 8");
    frame = sound;
    frame.camera = nullptr;
    expectRefused(frame, 5601, "frame.camera is null");
    frame = sound;
    frame.depth = nullptr;
    expectRefused(frame, 5601, "frame.depth is null");
    frame = sound;
    frame.depth_kind = 3;
    expectRefused(frame, 5611, "frame.depth_kind is 3");
    frame = sound;
    frame.normal_space = 2;
    expectRefused(frame, 5611, "frame.normal_space is 2");
    frame = sound;
    frame.normal_encoding = 9;
    expectRefused(frame, 5611, "frame.normal_encoding is 9");
    frame = sound;
    frame.normal = depth_.handle();
    expectRefused(frame, 5605, "frame.normal has 1 channels");
    frame = sound;
    frame.command_buffer = commands != nullptr ? nullptr : &frame;
    expectRefused(frame, 5606, "command buffer");
    EXPECT_EQ(grisaille_host_effect_record(effect.handle(), &sound), 0)
        << grisaille_host_last_error();
  });
  host_->frame([&](void* commands, uint64_t number) {
    grisaille_host_frame frame = frameOf(commands, number);
    EXPECT_EQ(grisaille_host_effect_record(effect.handle(), &frame), 0);
    frame.number = number - 1;
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5606, "follows frame");
  });
}

TEST_P(Errors, OfTexturesInFrames) {
  host::Effect effect(device_,
                      {.effect = "ssao", .width = kSide, .height = kSide, .outputs = {"tint"}});
  effect.set("bounce", "base_colour");
  const host::Device other = host_->device();
  const std::vector<float> one(kSide * kSide, 1.0f);
  const host::Texture foreign = host_->texture(other, Texels::kFloat1, kSide, kSide, one);
  const host::Texture small =
      host_->texture(device_, Texels::kFloat1, 8, 8, std::vector<float>(64, 1.0f));
  host_->frame([&](void* commands, uint64_t number) {
    grisaille_host_frame frame = frameOf(commands, number);
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5610, "base_colour is null");
    frame.depth = foreign.handle();
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5609, "different devices");
    frame.depth = small.handle();
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5605, "8 x 8 pixels");
  });
}

// A struct of an earlier version, and one of a later version without anything new in it.
TEST_P(Errors, OfStructsFromOtherVersions) {
  host::Effect effect(device_, {.effect = "ssao", .width = kSide, .height = kSide});
  expectError(grisaille_host_effect_dropped(nullptr), 5601, "effect is null");
  expectError(grisaille_host_effect_prepare(nullptr, nullptr), 5601, "effect is null");
  EXPECT_EQ(grisaille_host_effect_prepare(effect.handle(), nullptr), 0);
  auto how = sized<grisaille_host_prepare>();
  how.orthographic = 2;
  expectError(grisaille_host_effect_prepare(effect.handle(), &how), 5611, "orthographic is 2");
  host_->frame([&](void* commands, uint64_t number) {
    grisaille_host_frame frame = frameOf(commands, number);
    const auto record = [&](const void* bytes) {
      return grisaille_host_effect_record(effect.handle(),
                                          static_cast<const grisaille_host_frame*>(bytes));
    };
    // Fields that the earlier version lacks are not read.
    const auto* garbage = reinterpret_cast<const grisaille_host_texture*>(uintptr_t{8});
    frame.next_depth = garbage;
    frame.struct_size = offsetof(grisaille_host_frame, next_depth);
    EXPECT_EQ(record(&frame), 0) << grisaille_host_last_error();
    frame.thickness = garbage;
    frame.struct_size = offsetof(grisaille_host_frame, thickness);
    EXPECT_EQ(record(&frame), 0) << grisaille_host_last_error();
    frame.struct_size -= 8;
    expectError(record(&frame), 5602, "which no version has");
    // A later version's struct.
    struct {
      grisaille_host_frame known;
      uint32_t further[3];
    } later = {.known = frameOf(commands, number), .further = {}};
    later.known.struct_size = sizeof(later.known) + sizeof(later.further);
    EXPECT_EQ(record(&later), 0) << grisaille_host_last_error();
    later.further[1] = 1;
    expectError(record(&later), 5602,
                "byte " + std::to_string(sizeof(later.known) + 4) + " is not 0");
    later.known.struct_size = 1 << 20;
    expectError(record(&later), 5602, "struct_size is 1048576");
  });
}

// Descriptions as they were before their last fields.
TEST_P(Errors, OfEarlierDescriptions) {
  grisaille_host_effect_desc desc = effectDesc();
  desc.struct_size = offsetof(grisaille_host_effect_desc, settings);
  desc.setting_count = 7;  // not read
  desc.kept_sizes = 1000;
  grisaille_host_effect* effect = nullptr;
  EXPECT_EQ(grisaille_host_effect_create(device_.handle(), &desc, &effect), 0)
      << grisaille_host_last_error();
  auto output = sized<grisaille_host_output>();
  output.struct_size = offsetof(grisaille_host_output, layers);
  output.layers = 77;
  EXPECT_EQ(grisaille_host_effect_output(effect, "ao", &output), 0);
  EXPECT_EQ(output.layers, 77u) << "not written";
  EXPECT_EQ(output.width, kSide);
  EXPECT_EQ(grisaille_host_effect_destroy(effect), 0);
  const host::TextureSpec sound = host_->described();
  auto texture = sized<grisaille_host_texture_desc>();
  texture.struct_size = offsetof(grisaille_host_texture_desc, layers);
  texture.image = sound.image;
  texture.format = sound.format;
  texture.layout = sound.layout;
  texture.width = sound.width;
  texture.height = sound.height;
  texture.layers = 1000;  // not read
  grisaille_host_texture* made = nullptr;
  EXPECT_EQ(grisaille_host_texture_wrap(device_.handle(), &texture, &made), 0)
      << grisaille_host_last_error();
  EXPECT_EQ(grisaille_host_texture_destroy(made), 0);
}

TEST_P(Errors, OfCameras) {
  host::Effect effect(device_, {.effect = "ssao", .width = kSide, .height = kSide});
  const grisaille_host_camera sound = camera_;
  host_->frame([&](void* commands, uint64_t number) {
    const grisaille_host_frame frame = frameOf(commands, number);
    using Matrix = double(grisaille_host_camera::*)[16];
    const auto expectRefused = [&](Matrix matrix, int element, double value,
                                   const std::string& mention) {
      (camera_.*matrix)[element] = value;
      expectError(grisaille_host_effect_record(effect.handle(), &frame), 5607, mention);
      camera_ = sound;
    };
    constexpr Matrix kView = &grisaille_host_camera::view;
    constexpr Matrix kProjection = &grisaille_host_camera::projection;
    expectRefused(kView, 13, kNan, "view[13] is nan");
    expectRefused(kView, 13, 1e16, "not within 1e15");
    expectRefused(kView, 5, 2, "perpendicular axes");
    expectRefused(kView, 5, -1, "reflection");
    expectRefused(kView, 3, 0.1, "last row of view");
    expectRefused(kProjection, 0, kNan, "projection[0] is nan");
    expectRefused(kProjection, 0, -1, "mirrored");
    expectRefused(kProjection, 5, 0, "projection[5] is 0");
    expectRefused(kProjection, 4, 0.2, "projection[4] is 0.2");
    expectRefused(kProjection, 2, 0.2, "oblique near plane");
    expectRefused(kProjection, 12, 0.2, "projection[12] is 0.2");
    expectRefused(kProjection, 11, 1, "look along -z");
    expectRefused(kProjection, 14, 0, "does not depend on the distance");
    expectRefused(kProjection, 10, 3, "near plane is -");
    const glm::dmat4 parallel = projectionOf({.height = 3}, 1, {.near = 0.1, .far = 10});
    std::memcpy(camera_.projection, &parallel, sizeof(camera_.projection));
    camera_.projection[15] = -1;
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5607, "clip w is -1");
    camera_.projection[15] = 1;
    camera_.projection[10] = -1e-10;
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5607, "within 1e9 m");
    camera_ = sound;
    camera_.clip = 2;
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5611, "camera.clip is 2");
    camera_ = sound;
    camera_.struct_size = 0;
    expectError(grisaille_host_effect_record(effect.handle(), &frame), 5602, "frame.camera");
    camera_ = sound;
  });
}

}  // namespace
}  // namespace grisaille::tests
