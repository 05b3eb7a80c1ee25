// SPDX-License-Identifier: MIT
/// @file
/// The C++20 interface of libgrisaille, a layer over host.h: classes own the objects, and errors
/// are exceptions. See host.h for the errors of each function, ownership and threads.
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

/// The C++20 interface of libgrisaille: see host.hpp.
namespace grisaille::host {

/// @addtogroup host_library
/// @{

/// A failed call. All functions of this header that call the library may throw it. what() returns
/// the line of grisaille_host_last_error().
class Failure : public std::runtime_error {
 public:
  /// @param number number of the error
  /// @param line the whole error line
  Failure(int number, const std::string& line) : std::runtime_error(line), number_(number) {}
  /// @return number of the error, for example 5601
  int number() const { return number_; }

 private:
  int number_;
};

/// Throws unless a call succeeded.
/// @param result the result of a function of host.h
/// @throws Failure the result is not 0
inline void require(int result) {
  if (result != 0) throw Failure(result, grisaille_host_last_error());
}

/// Converts a handle of the graphics API to a number.
/// @param handle a Vulkan handle (a pointer or a number) or an OpenGL name
/// @return the number, for TextureSpec::image
template <typename Handle>
uint64_t number(Handle handle) {
  if constexpr (std::is_pointer_v<Handle>) {
    return reinterpret_cast<uint64_t>(handle);
  } else {
    return static_cast<uint64_t>(handle);
  }
}

/// @cond
template <auto kDestroy>
struct Destroy {
  template <typename Made>
  void operator()(Made* made) const {
    kDestroy(made);
  }
};
/// @endcond

/// @}
/// @addtogroup host_devices
/// @{

/// Your Vulkan device, for Device::vulkan().
struct VulkanSpec {
  void* instance = nullptr;        ///< VkInstance
  void* physicalDevice = nullptr;  ///< VkPhysicalDevice
  void* device = nullptr;          ///< VkDevice
  uint32_t queueFamily = 0;        ///< family of the queue that you submit to; it supports compute
  uint32_t framesInFlight = 2;     ///< 1 to 16: see grisaille_host_vulkan::frames_in_flight
  /// PFN_vkGetInstanceProcAddr of your loader; null: the library loads libvulkan.so.1
  void (*getInstanceProcAddr)() = nullptr;
  const char* effectFolder = nullptr;       ///< additional folder of trusted effects; or null
  uint64_t pipelineCache = 0;               ///< VkPipelineCache of yours; 0: none
  uint32_t flags = 0;                       ///< grisaille_host_flags combined, or 0
  const grisaille_host_log* log = nullptr;  ///< takes messages: see logOf(); null: none
  /// allocates memory; null: the driver does
  const grisaille_host_allocator* allocator = nullptr;
  const void* allocationCallbacks = nullptr;  ///< VkAllocationCallbacks of yours; null: none
};

/// Your OpenGL context, which is current, for Device::opengl().
struct OpenGlSpec {
  const char* effectFolder = nullptr;  ///< additional folder of trusted effects; or null
  /// who restores the context's state
  grisaille_host_state state = GRISAILLE_HOST_STATE_RESTORED;
  uint32_t framesInFlight = 0;              ///< see grisaille_host_opengl::frames_in_flight
  uint32_t flags = 0;                       ///< grisaille_host_flags combined, or 0
  const grisaille_host_log* log = nullptr;  ///< takes messages: see logOf(); null: none
};

/// Describes your function that takes messages.
/// @param write see grisaille_host_log::write
/// @param context passed to `write`; it must outlive the device
/// @return the description
inline grisaille_host_log logOf(decltype(grisaille_host_log::write) write, void* context) {
  return {
      .struct_size = sizeof(grisaille_host_log), .reserved = 0, .context = context, .write = write};
}

/// Owns a device. Destroy it after its textures and effects.
class Device {
 public:
  /// Creates a device on your Vulkan device.
  /// @param spec your Vulkan device
  /// @return the device
  static Device vulkan(const VulkanSpec& spec) {
    const grisaille_host_vulkan given = {.struct_size = sizeof(grisaille_host_vulkan),
                                         .queue_family = spec.queueFamily,
                                         .frames_in_flight = spec.framesInFlight,
                                         .flags = spec.flags,
                                         .instance = spec.instance,
                                         .physical_device = spec.physicalDevice,
                                         .device = spec.device,
                                         .get_instance_proc_addr = spec.getInstanceProcAddr,
                                         .effect_folder = spec.effectFolder,
                                         .pipeline_cache = spec.pipelineCache,
                                         .log = spec.log,
                                         .allocator = spec.allocator,
                                         .allocation_callbacks = spec.allocationCallbacks};
    Device made;
    grisaille_host_device* device = nullptr;
    require(grisaille_host_device_vulkan(&given, &device));
    made.device_.reset(device);
    return made;
  }

  /// Creates a device on the OpenGL context that is current in this thread.
  /// @param spec your OpenGL context
  /// @return the device
  static Device opengl(const OpenGlSpec& spec = {}) {
    const grisaille_host_opengl given = {.struct_size = sizeof(grisaille_host_opengl),
                                         .state = static_cast<uint32_t>(spec.state),
                                         .effect_folder = spec.effectFolder,
                                         .frames_in_flight = spec.framesInFlight,
                                         .flags = spec.flags,
                                         .log = spec.log};
    Device made;
    grisaille_host_device* device = nullptr;
    require(grisaille_host_device_opengl(&given, &device));
    made.device_.reset(device);
    return made;
  }

  /// @return the tables of all effects, sorted by key; valid while the device lives
  std::span<const grisaille_effect_desc* const> effects() const {
    const grisaille_effect_desc* const* list = nullptr;
    uint32_t count = 0;
    require(grisaille_host_effects(device_.get(), &list, &count));
    return {list, count};
  }

  /// Sets the function that casts rays for the device's effects, from the next recording on.
  /// @param cast see grisaille_host_rays::cast; null: no function
  /// @param context passed to `cast`; it must outlive the recordings
  void setRays(decltype(grisaille_host_rays::cast) cast, void* context) const {
    const grisaille_host_rays rays = {
        .struct_size = sizeof(rays), .reserved = 0, .context = context, .cast = cast};
    require(grisaille_host_device_set_rays(device_.get(), cast != nullptr ? &rays : nullptr));
  }

  /// Sets the function that draws depth pictures for the device's effects, from the next recording
  /// on.
  /// @param draw see grisaille_host_depths::draw; null: no function
  /// @param context passed to `draw`; it must outlive the recordings
  void setDepths(decltype(grisaille_host_depths::draw) draw, void* context) const {
    const grisaille_host_depths depths = {
        .struct_size = sizeof(depths), .reserved = 0, .context = context, .draw = draw};
    require(grisaille_host_device_set_depths(device_.get(), draw != nullptr ? &depths : nullptr));
  }

  /// Sets the function that decodes pictures for the device's effects, from the next recording on.
  /// @param read see grisaille_host_pictures::read; null: no function
  /// @param context passed to `read`; it must outlive the recordings
  void setPictures(decltype(grisaille_host_pictures::read) read, void* context) const {
    const grisaille_host_pictures pictures = {
        .struct_size = sizeof(pictures), .reserved = 0, .context = context, .read = read};
    require(
        grisaille_host_device_set_pictures(device_.get(), read != nullptr ? &pictures : nullptr));
  }

  /// @return the memory that the device holds now
  grisaille_host_memory_use memory() const {
    grisaille_host_memory_use use{};
    use.struct_size = sizeof(use);
    require(grisaille_host_device_memory(device_.get(), &use));
    return use;
  }

  /// @return the C handle, which this object keeps owning
  grisaille_host_device* handle() const { return device_.get(); }

 private:
  Device() = default;
  std::unique_ptr<grisaille_host_device, Destroy<grisaille_host_device_destroy>> device_;
};

/// @}
/// @addtogroup host_scene
/// @{

/// Describes one of your textures: see grisaille_host_texture_desc.
struct TextureSpec {
  uint64_t image = 0;       ///< Vulkan: number() of a VkImage; OpenGL: name of the texture
  uint32_t format = 0;      ///< Vulkan: VkFormat; OpenGL: 0
  uint32_t layout = 0;      ///< Vulkan: VkImageLayout before and after each recording; OpenGL: 0
  uint32_t width = 0;       ///< pixels; OpenGL: 0 means the texture's width
  uint32_t height = 0;      ///< pixels; OpenGL: 0 means the texture's height
  uint32_t firstLayer = 0;  ///< of an array: the first layer to read
  uint32_t layers = 1;      ///< number of layers from firstLayer on
};

/// Owns the wrapper of one of your textures; you keep ownership of the texture itself.
class Texture {
 public:
  Texture() = default;  ///< Wraps no texture.
  /// Wraps a texture.
  /// @param device the device
  /// @param spec describes the texture
  Texture(const Device& device, const TextureSpec& spec) {
    const grisaille_host_texture_desc desc = {.struct_size = sizeof(grisaille_host_texture_desc),
                                              .format = spec.format,
                                              .layout = spec.layout,
                                              .width = spec.width,
                                              .height = spec.height,
                                              .first_layer = spec.firstLayer,
                                              .image = spec.image,
                                              .layers = spec.layers,
                                              .reserved = 0};
    grisaille_host_texture* texture = nullptr;
    require(grisaille_host_texture_wrap(device.handle(), &desc, &texture));
    texture_.reset(texture);
  }

  /// @return the C handle, which this object keeps owning; null: wraps no texture
  grisaille_host_texture* handle() const { return texture_.get(); }

 private:
  std::unique_ptr<grisaille_host_texture, Destroy<grisaille_host_texture_destroy>> texture_;
};

/// @}
/// @addtogroup host_frame
/// @{

/// A camera, built from the matrices that drew the frame.
struct Camera : grisaille_host_camera {
  /// @param viewFromWorld 16 numbers, column-major; see grisaille_host_camera::view
  /// @param clipFromView 16 numbers, column-major; see grisaille_host_camera::projection
  /// @param range the range of clip z / clip w
  template <typename Number>
  Camera(const Number* viewFromWorld, const Number* clipFromView,
         grisaille_host_clip range = GRISAILLE_HOST_CLIP_ZERO_TO_ONE)
      : grisaille_host_camera{} {
    struct_size = sizeof(grisaille_host_camera);
    clip = static_cast<uint32_t>(range);
    for (int i = 0; i < 16; ++i) {
      view[i] = static_cast<double>(viewFromWorld[i]);
      projection[i] = static_cast<double>(clipFromView[i]);
    }
  }
};

/// One frame, as an effect reads it. All textures have the effect's size.
struct Frame {
  uint64_t number = 0;            ///< see grisaille_host_frame::number
  void* commandBuffer = nullptr;  ///< see grisaille_host_frame::command_buffer
  /// The camera that drew the frame; the first of as many as the effect has layers.
  const Camera& camera;
  const Texture& depth;                                          ///< one channel, or a depth buffer
  grisaille_host_depth depthKind = GRISAILLE_HOST_DEPTH_BUFFER;  ///< meaning of `depth`
  const Texture* normal = nullptr;  ///< see normalEncoding; null: facet normals, from depth
  grisaille_host_normals normalSpace = GRISAILLE_HOST_NORMALS_WORLD;  ///< space of `normal`
  grisaille_host_encoding normalEncoding = GRISAILLE_HOST_SIGNED;     ///< encoding of `normal`
  /// see grisaille_host_frame::back_depth; null: unknown
  const Texture* backDepth = nullptr;
  const Texture* baseColour = nullptr;  ///< three channels, linear when sampled; or null
  /// see grisaille_host_frame::thickness; null: unknown
  const Texture* thickness = nullptr;
  /// see grisaille_host_frame::next_depth; null: unknown
  const Texture* nextDepth = nullptr;
  /// seconds, see grisaille_host_frame::patience; 0: no limit
  double patience = 0;
  const Texture* colour = nullptr;  ///< the lit colour, see grisaille_host_frame::colour; or null
  const Texture* motion = nullptr;  ///< motion vectors, see grisaille_host_frame::motion; or null
  double motionScale[2] = {1, 1};   ///< converts `motion` to pixels, x to the right, y down
  bool motionJittered = false;      ///< whether `motion` includes the difference of the jitters
  /// textures that effects read by name: see inputOf()
  std::span<const grisaille_host_input> inputs = {};
  /// the part of the textures that holds the picture, see grisaille_host_frame::rectangle; all 0:
  /// the whole textures
  grisaille_host_rectangle rectangle = {};
};

/// Names a texture that an effect reads by name, for Frame::inputs.
/// @param key the input's key: "reactive", or "ssao.ao" for another effect's output
/// @param texture the texture
/// @return the entry
inline grisaille_host_input inputOf(const char* key, const Texture& texture) {
  return {.key = key, .texture = texture.handle()};
}

/// @}
/// @addtogroup host_effects
/// @{

/// Describes an effect.
struct EffectSpec {
  const char* effect = nullptr;  ///< the effect's key: "ssao"
  uint32_t width = 0;            ///< pixels of the input textures and of the outputs, 1 to 16384
  uint32_t height = 0;           ///< pixels; see `width`
  /// order of rows in the input textures and in the outputs
  grisaille_host_rows rows = GRISAILLE_HOST_ROWS_FROM_TOP;
  /// keys of the wanted outputs; empty: only the effect's first output
  std::initializer_list<const char*> outputs = {};
  uint32_t layers = 1;  ///< views of a recording: see grisaille_host_effect_desc::layers
  /// values of parameters that differ from the defaults
  std::span<const grisaille_host_setting> settings = {};
  uint32_t keptSizes = 0;  ///< see grisaille_host_effect_desc::kept_sizes
};

/// Converts a description to that of host.h, which points to its strings and arrays.
/// @param spec the description
/// @return the same in C
inline grisaille_host_effect_desc descOf(const EffectSpec& spec) {
  return {.struct_size = sizeof(grisaille_host_effect_desc),
          .width = spec.width,
          .height = spec.height,
          .rows = static_cast<uint32_t>(spec.rows),
          .output_count = static_cast<uint32_t>(spec.outputs.size()),
          .layers = spec.layers,
          .effect = spec.effect,
          .outputs = spec.outputs.begin(),
          .settings = spec.settings.data(),
          .setting_count = static_cast<uint32_t>(spec.settings.size()),
          .kept_sizes = spec.keptSizes};
}

/// Tells how much memory an effect will take: see grisaille_host_memory_needed().
/// @param device the device
/// @param spec describes the effect
/// @param inputs GRISAILLE_READS() of the optional textures that the frames have
/// @param orthographic whether cameras are orthographic
/// @return the memory
inline grisaille_host_memory_use memoryNeeded(const Device& device, const EffectSpec& spec,
                                              uint32_t inputs = 0, bool orthographic = false) {
  const grisaille_host_effect_desc desc = descOf(spec);
  const grisaille_host_prepare how = {.struct_size = sizeof(grisaille_host_prepare),
                                      .orthographic = orthographic ? 1u : 0u,
                                      .inputs = inputs,
                                      .reserved = 0,
                                      .context = nullptr,
                                      .progress = nullptr};
  grisaille_host_memory_use use{};
  use.struct_size = sizeof(use);
  require(grisaille_host_memory_needed(device.handle(), &desc, &how, &use));
  return use;
}

/// Owns an effect with its parameters, its objects and its outputs.
class Effect {
 public:
  /// Creates an effect with default parameter values and without objects.
  /// @param device the device
  /// @param spec describes the effect
  Effect(const Device& device, const EffectSpec& spec) {
    const grisaille_host_effect_desc desc = descOf(spec);
    grisaille_host_effect* effect = nullptr;
    require(grisaille_host_effect_create(device.handle(), &desc, &effect));
    effect_.reset(effect);
  }

  /// Sets a parameter, from the next recording on. That recording may compile shaders.
  /// @param key key of the parameter
  /// @param value a number in the unit of the effect's table, the index of an enum entry, or 0 or 1
  void set(const char* key, double value) {
    require(grisaille_host_effect_set(effect_.get(), key, value));
  }
  /// Sets a parameter from text.
  /// @param key key of the parameter
  /// @param text the value as on the command line: "0.5", "true", the key of an enum entry
  void set(const char* key, const char* text) {
    require(grisaille_host_effect_set_text(effect_.get(), key, text));
  }
  /// Returns the value of a parameter.
  /// @param key key of the parameter
  /// @return the value, in the form that set() takes
  double get(const char* key) const {
    double value = 0;
    require(grisaille_host_effect_get(effect_.get(), key, &value));
    return value;
  }

  /// Sets the objects, from the next recording on. The library copies the objects and their texts.
  /// Add new objects at the end: the effect processes only the objects from the first changed one
  /// on.
  /// @tparam Object a struct, laid out as the effect's table of objects says
  /// @param objects the objects, oldest first
  template <typename Object>
  void setObjects(std::span<const Object> objects) {
    require(grisaille_host_effect_set_objects(effect_.get(), objects.data(), sizeof(Object),
                                              objects.size()));
  }
  /// Sets the objects from a JSON file that the program `grisaille` saved.
  /// @param path path of the file
  void loadObjects(const char* path) {
    require(grisaille_host_effect_load_objects(effect_.get(), path));
  }

  /// Resizes the effect. Its outputs become new textures.
  /// @param width pixels, 1 to 16384
  /// @param height pixels, 1 to 16384
  void resize(uint32_t width, uint32_t height) {
    require(grisaille_host_effect_resize(effect_.get(), width, height));
  }

  /// Records the commands that write all wanted outputs: see grisaille_host_effect_record().
  /// @param frame the frame
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
        .base_colour = handleOf(frame.baseColour),
        .thickness = handleOf(frame.thickness),
        .next_depth = handleOf(frame.nextDepth),
        .patience = frame.patience,
        .colour = handleOf(frame.colour),
        .motion = handleOf(frame.motion),
        .motion_scale = {frame.motionScale[0], frame.motionScale[1]},
        .motion_jittered = frame.motionJittered ? 1u : 0u,
        .input_count = static_cast<uint32_t>(frame.inputs.size()),
        .inputs = frame.inputs.data(),
        .rectangle = frame.rectangle};
    require(grisaille_host_effect_record(effect_.get(), &given));
  }

  /// Compiles the shaders that recordings need: see grisaille_host_effect_prepare().
  /// @param orthographic whether cameras are orthographic
  /// @param inputs GRISAILLE_READS() of the optional textures that the frames have
  /// @param progress see grisaille_host_prepare::progress; null: none
  /// @param context passed to `progress`
  void prepare(bool orthographic = false, uint32_t inputs = 0,
               void (*progress)(void*, uint32_t, uint32_t) = nullptr, void* context = nullptr) {
    const grisaille_host_prepare how = {.struct_size = sizeof(grisaille_host_prepare),
                                        .orthographic = orthographic ? 1u : 0u,
                                        .inputs = inputs,
                                        .reserved = 0,
                                        .context = context,
                                        .progress = progress};
    require(grisaille_host_effect_prepare(effect_.get(), &how));
  }

  /// Forgets what recordings have written, for one that you drop instead of submitting: see
  /// grisaille_host_effect_dropped().
  void dropped() { require(grisaille_host_effect_dropped(effect_.get())); }

  /// @return the memory that the effect takes now
  grisaille_host_memory_use memory() const {
    grisaille_host_memory_use use{};
    use.struct_size = sizeof(use);
    require(grisaille_host_effect_memory(effect_.get(), &use));
    return use;
  }

  /// @return what the effect reported in its last recording
  grisaille_host_report report() const {
    grisaille_host_report report{};
    report.struct_size = sizeof(report);
    require(grisaille_host_effect_report(effect_.get(), &report));
    return report;
  }

  /// Computes what the effect draws at points of your scene's surfaces: see
  /// grisaille_host_effect_draw_at().
  /// @param points the points
  /// @return one result per point, in the same order
  std::vector<grisaille_drawn> drawAt(std::span<const grisaille_point> points) {
    std::vector<grisaille_drawn> drawn(points.size());
    require(
        grisaille_host_effect_draw_at(effect_.get(), points.data(), points.size(), drawn.data()));
    return drawn;
  }

  /// Returns an output. The texture holds a result once you have recorded the effect. It stays the
  /// same texture until you resize or destroy the effect.
  /// @param key key of an output that you named when you created the effect
  /// @return the texture, which the effect owns
  grisaille_host_output output(const char* key) const {
    grisaille_host_output output{};
    output.struct_size = sizeof(output);
    require(grisaille_host_effect_output(effect_.get(), key, &output));
    return output;
  }

  /// @return the C handle, which this object keeps owning
  grisaille_host_effect* handle() const { return effect_.get(); }

 private:
  std::unique_ptr<grisaille_host_effect, Destroy<grisaille_host_effect_destroy>> effect_;
};

/// @}

}  // namespace grisaille::host

#endif  // GRISAILLE_HOST_HPP
