// SPDX-License-Identifier: MIT
// grisaille/host.h in C++20: owners for what it makes, exceptions for its errors, nothing more.
// What each function does, its units and who owns what stand there.
#ifndef GRISAILLE_HOST_HPP
#define GRISAILLE_HOST_HPP

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "grisaille/host.h"

namespace grisaille::host {

// what() is the whole line, number() what it begins with.
class Failure : public std::runtime_error {
 public:
  Failure(int number, const std::string& line) : std::runtime_error(line), number_(number) {}
  int number() const { return number_; }

 private:
  int number_;
};

// Throws Failure unless `result` is 0.
inline void require(int result) {
  if (result != 0) throw Failure(result, grisaille_host_last_error());
}

// A handle of the graphics API as a number: Vulkan's are pointers or numbers, OpenGL's names.
template <typename Handle>
uint64_t number(Handle handle) {
  if constexpr (std::is_pointer_v<Handle>) {
    return reinterpret_cast<uint64_t>(handle);
  } else {
    return static_cast<uint64_t>(handle);
  }
}

// Ends what it owns. Owners of effects and textures go before their device's.
template <auto kDestroy>
struct Destroy {
  template <typename Made>
  void operator()(Made* made) const {
    kDestroy(made);
  }
};

struct VulkanSpec {
  void* instance = nullptr;
  void* physicalDevice = nullptr;
  void* device = nullptr;
  uint32_t queueFamily = 0;
  uint32_t framesInFlight = 2;
  void (*getInstanceProcAddr)() = nullptr;
  const char* effectFolder = nullptr;
};

class Device {
 public:
  static Device vulkan(const VulkanSpec& spec) {
    const grisaille_host_vulkan given = {.struct_size = sizeof(grisaille_host_vulkan),
                                         .queue_family = spec.queueFamily,
                                         .frames_in_flight = spec.framesInFlight,
                                         .reserved = 0,
                                         .instance = spec.instance,
                                         .physical_device = spec.physicalDevice,
                                         .device = spec.device,
                                         .get_instance_proc_addr = spec.getInstanceProcAddr,
                                         .effect_folder = spec.effectFolder};
    Device made;
    grisaille_host_device* device = nullptr;
    require(grisaille_host_device_vulkan(&given, &device));
    made.device_.reset(device);
    return made;
  }

  // Of the context that is current.
  static Device opengl(const char* effectFolder = nullptr) {
    const grisaille_host_opengl given = {
        .struct_size = sizeof(grisaille_host_opengl), .reserved = 0, .effect_folder = effectFolder};
    Device made;
    grisaille_host_device* device = nullptr;
    require(grisaille_host_device_opengl(&given, &device));
    made.device_.reset(device);
    return made;
  }

  std::span<const grisaille_effect_desc* const> effects() const {
    const grisaille_effect_desc* const* list = nullptr;
    uint32_t count = 0;
    require(grisaille_host_effects(device_.get(), &list, &count));
    return {list, count};
  }

  // `context` outlives the recordings.
  void setRays(decltype(grisaille_host_rays::cast) cast, void* context) const {
    const grisaille_host_rays rays = {
        .struct_size = sizeof(rays), .reserved = 0, .context = context, .cast = cast};
    require(grisaille_host_device_set_rays(device_.get(), cast != nullptr ? &rays : nullptr));
  }

  // `context` outlives the recordings.
  void setPictures(decltype(grisaille_host_pictures::read) read, void* context) const {
    const grisaille_host_pictures pictures = {
        .struct_size = sizeof(pictures), .reserved = 0, .context = context, .read = read};
    require(
        grisaille_host_device_set_pictures(device_.get(), read != nullptr ? &pictures : nullptr));
  }

  grisaille_host_device* handle() const { return device_.get(); }

 private:
  Device() = default;
  std::unique_ptr<grisaille_host_device, Destroy<grisaille_host_device_destroy>> device_;
};

struct TextureSpec {
  uint64_t image = 0;   // number(a VkImage), or an OpenGL texture's name
  uint32_t format = 0;  // a VkFormat
  uint32_t layout = 0;  // a VkImageLayout
  uint32_t width = 0;   // pixels
  uint32_t height = 0;
};

class Texture {
 public:
  Texture() = default;  // none
  Texture(const Device& device, const TextureSpec& spec) {
    const grisaille_host_texture_desc desc = {.struct_size = sizeof(grisaille_host_texture_desc),
                                              .format = spec.format,
                                              .layout = spec.layout,
                                              .width = spec.width,
                                              .height = spec.height,
                                              .reserved = 0,
                                              .image = spec.image};
    grisaille_host_texture* texture = nullptr;
    require(grisaille_host_texture_wrap(device.handle(), &desc, &texture));
    texture_.reset(texture);
  }

  grisaille_host_texture* handle() const { return texture_.get(); }

 private:
  std::unique_ptr<grisaille_host_texture, Destroy<grisaille_host_texture_destroy>> texture_;
};

struct Camera : grisaille_host_camera {
  // `viewFromWorld` holds 16 numbers, column after column: a rotation and a translation. A pinhole,
  // angle in radians; far 0: none.
  template <typename Number>
  static Camera pinhole(const Number* viewFromWorld, double verticalAngle, double near,
                        double far = 0) {
    Camera camera = placed(viewFromWorld);
    camera.vertical_angle = verticalAngle;
    camera.near_plane = near;
    camera.far_plane = far;
    return camera;
  }

  // The same, orthographic; height in metres.
  template <typename Number>
  static Camera orthographic(const Number* viewFromWorld, double height, double near, double far) {
    Camera camera = placed(viewFromWorld);
    camera.orthographic_height = height;
    camera.near_plane = near;
    camera.far_plane = far;
    return camera;
  }

 private:
  template <typename Number>
  static Camera placed(const Number* view) {
    Camera camera{};
    camera.struct_size = sizeof(grisaille_host_camera);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        const double entry = static_cast<double>(view[4 * column + row]);
        camera.world_from_view[3 * row + column] = entry;
        camera.position[column] -= entry * static_cast<double>(view[12 + row]);
      }
    }
    return camera;
  }
};

struct EffectSpec {
  const char* effect = nullptr;  // its key
  uint32_t width = 0;            // pixels
  uint32_t height = 0;
  grisaille_host_rows rows = GRISAILLE_HOST_ROWS_FROM_TOP;
  std::initializer_list<const char*> outputs = {};  // none: the first
};

struct Frame {
  uint64_t number = 0;
  void* commandBuffer = nullptr;
  const Camera& camera;
  const Texture& depth;
  grisaille_host_depth depthKind = GRISAILLE_HOST_DEPTH_CLIP;
  const Texture* normal = nullptr;
  grisaille_host_normals normalSpace = GRISAILLE_HOST_NORMALS_WORLD;
  grisaille_host_encoding normalEncoding = GRISAILLE_HOST_SIGNED;
  const Texture* backDepth = nullptr;
  const Texture* baseColour = nullptr;
};

class Effect {
 public:
  Effect(const Device& device, const EffectSpec& spec) {
    const grisaille_host_effect_desc desc = {
        .struct_size = sizeof(grisaille_host_effect_desc),
        .width = spec.width,
        .height = spec.height,
        .rows = static_cast<uint32_t>(spec.rows),
        .output_count = static_cast<uint32_t>(spec.outputs.size()),
        .reserved = 0,
        .effect = spec.effect,
        .outputs = spec.outputs.begin()};
    grisaille_host_effect* effect = nullptr;
    require(grisaille_host_effect_create(device.handle(), &desc, &effect));
    effect_.reset(effect);
  }

  void set(const char* key, double value) {
    require(grisaille_host_effect_set(effect_.get(), key, value));
  }
  void set(const char* key, const char* text) {
    require(grisaille_host_effect_set_text(effect_.get(), key, text));
  }
  double get(const char* key) const {
    double value = 0;
    require(grisaille_host_effect_get(effect_.get(), key, &value));
    return value;
  }

  // Object: laid out as the effect's table of objects says.
  template <typename Object>
  void setObjects(std::span<const Object> objects) {
    require(grisaille_host_effect_set_objects(effect_.get(), objects.data(), sizeof(Object),
                                              objects.size()));
  }
  void loadObjects(const char* path) {
    require(grisaille_host_effect_load_objects(effect_.get(), path));
  }

  void resize(uint32_t width, uint32_t height) {
    require(grisaille_host_effect_resize(effect_.get(), width, height));
  }

  void record(const Frame& frame) {
    const auto handleOf = [](const Texture* texture) {
      return texture != nullptr ? texture->handle() : nullptr;
    };
    const grisaille_host_frame given = {
        .struct_size = sizeof(grisaille_host_frame),
        .depth_kind = static_cast<uint32_t>(frame.depthKind),
        .normal_space = static_cast<uint32_t>(frame.normalSpace),
        .normal_encoding = static_cast<uint32_t>(frame.normalEncoding),
        .number = frame.number,
        .command_buffer = frame.commandBuffer,
        .camera = &frame.camera,
        .depth = frame.depth.handle(),
        .normal = handleOf(frame.normal),
        .back_depth = handleOf(frame.backDepth),
        .base_colour = handleOf(frame.baseColour)};
    require(grisaille_host_effect_record(effect_.get(), &given));
  }

  grisaille_host_output output(const char* key) const {
    grisaille_host_output output{};
    output.struct_size = sizeof(output);
    require(grisaille_host_effect_output(effect_.get(), key, &output));
    return output;
  }

  grisaille_host_effect* handle() const { return effect_.get(); }

 private:
  std::unique_ptr<grisaille_host_effect, Destroy<grisaille_host_effect_destroy>> effect_;
};

}  // namespace grisaille::host

#endif  // GRISAILLE_HOST_HPP
