/* SPDX-License-Identifier: MIT */
/**
 * @file
 * The C interface of libgrisaille, which runs the effects in your own renderer.
 *
 * Create a device once. Wrap the textures that you render: depth, and optionally normals and base
 * colours. Create effects by name. Record them once per frame, and sample their outputs.
 * `find_package(Grisaille)` defines the CMake target Grisaille::grisaille. grisaille/host.hpp is
 * the same interface in C++20.
 *
 * @par Errors
 * A function that returns int returns 0 on success. If it fails, it does nothing and returns the
 * number of the error; grisaille_host_last_error() then returns one line: what is wrong, why, and
 * what to do. The comment of each function lists its errors. Every function may also return
 * - 5601: an argument or a pointer in a struct is null,
 * - 5602: a struct_size is no version's, or a field of a later version is not 0,
 * - 5611: a reserved field is not 0,
 * - 9001: an internal error of the library,
 * - 9002: out of memory,
 * - 1005 or 1006, if it calls the graphics API: the driver failed, or lost the device.
 *
 * The library throws no exception and prints nothing. It tells a grisaille_host_log what happens.
 *
 * @par Structs
 * A struct that may grow begins with struct_size: set it to the size of the struct. Set unused
 * fields to 0. Later versions append fields. The library takes the struct of an earlier version,
 * with 0 in the fields that it lacks, and that of a later version if all bytes beyond the fields
 * that it knows are 0. The other structs never change, since you pass arrays of them, or since they
 * are as small as a rectangle: a later version that needs more adds a struct.
 *
 * @par Ownership
 * Destroy every object that you create; destroy effects and textures before their device. The
 * library reads structs and strings during the call and keeps no pointer to them. You keep
 * ownership of the graphics API's objects: the library does not release them, and changes them only
 * as this header says. Keep them alive until you have destroyed every object created from them.
 *
 * @par Threads
 * Use a device, and every object created from it, in one thread at a time. For OpenGL, the device's
 * context must be current in that thread. Devices are independent of one another.
 *
 * @par Units
 * Metres, radians, pixels. Matrices are column-major, vectors are columns. World axes are
 * right-handed; view space looks along -z with y up.
 *
 * @par Vulkan
 * The device must have version 1.3, with shaderStorageImageExtendedFormats, synchronization2 and
 * maintenance4 enabled. The library cannot check which features you enabled. It loads its own
 * function tables through the loader of the process's first device, and it submits nothing.
 *
 * @par OpenGL
 * The context must have version 4.5, core or compatibility profile, created by GLX or EGL.
 * Recording restores all state; do not record inside conditional rendering. Creating, resizing and
 * destroying change no state, but they call glGetError(), which clears a pending error.
 */
#ifndef GRISAILLE_HOST_H
#define GRISAILLE_HOST_H

#include "grisaille/effect.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup host_library libgrisaille: library
 * Version and errors of the library.
 * @{
 */

#define GRISAILLE_HOST_VERSION 1u /**< grows when functions or fields are added */

/**
 * Returns the version of the library. It cannot fail. Any thread may call it.
 * @return the library's GRISAILLE_HOST_VERSION; not less than the header's if both come from the
 * same installation
 */
GRISAILLE_EXPORT uint32_t grisaille_host_version(void);

/**
 * Returns the error message of the last failed call of the calling thread. It cannot fail. Any
 * thread may call it.
 * @return one line, such as "error E5601: device is null; pass a pointer that is not null"; "" if
 * no call failed. It is valid until the thread's next failed call.
 */
GRISAILLE_EXPORT const char* grisaille_host_last_error(void);

/** How grave a line of the log is. */
typedef enum grisaille_host_level {
  GRISAILLE_HOST_INFO = 0, /**< what the library did, such as compiling a shader in a recording */
  GRISAILLE_HOST_WARNING = 1, /**< what it left out, such as a plugin that does not fit */
  GRISAILLE_HOST_ERROR =
      2 /**< the line of a call that failed, or a fault of #GRISAILLE_HOST_CHECK */
} grisaille_host_level;

/** Your function that takes the library's messages about a device. */
typedef struct grisaille_host_log {
  uint32_t struct_size; /**< sizeof(grisaille_host_log) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< your pointer, which the library passes to `write` */
  /**
   * Takes one message. The library calls it inside your calls, in the same thread, also for a
   * device whose creation fails. The function must not call the library.
   * @param context grisaille_host_log::context
   * @param level a grisaille_host_level
   * @param text one line of UTF-8 without a newline, valid during the call
   */
  void (*write)(void* context, uint32_t level, const char* text);
} grisaille_host_log;

/**
 * @}
 * @defgroup host_devices libgrisaille: devices
 * Your Vulkan device or OpenGL context.
 * @{
 */

/** The library's device on your Vulkan device or OpenGL context. */
typedef struct grisaille_host_device grisaille_host_device;

/** Further properties of a device. */
typedef enum grisaille_host_flags {
  /**
   * Checks every command of the effects and of the library before the graphics API gets it, for
   * example that a shader reads no texture that was never written. A fault of an effect is error
   * 3203 of its recording, which quotes the number and the words of the fault. Resources that were
   * not destroyed are told to the log. It costs CPU time and memory; results stay the same.
   */
  GRISAILLE_HOST_CHECK = 1
} grisaille_host_flags;

/** A Vulkan buffer or image that needs memory. */
typedef struct grisaille_host_memory_request {
  uint32_t struct_size;      /**< sizeof(grisaille_host_memory_request) */
  uint32_t memory_type_bits; /**< VkMemoryRequirements::memoryTypeBits */
  uint64_t size;             /**< bytes */
  uint64_t alignment;        /**< bytes: `grisaille_host_memory::offset` is a multiple */
  uint32_t required_flags;   /**< VkMemoryPropertyFlags that the memory type must have */
  uint32_t preferred_flags;  /**< VkMemoryPropertyFlags that it should have */
  uint64_t buffer;           /**< VkBuffer, or 0 */
  uint64_t image;            /**< VkImage with optimal tiling, or 0 */
  const char* label;         /**< what the memory is for: "depth"; valid during the call */
} grisaille_host_memory_request;

/** Memory for one buffer or image. */
typedef struct grisaille_host_memory {
  uint32_t struct_size; /**< sizeof(grisaille_host_memory), set by the library */
  uint32_t reserved;    /**< 0 */
  uint64_t memory;      /**< VkDeviceMemory, which other resources may share */
  uint64_t offset;      /**< bytes from the start of `memory` */
  /**
   * Address of the first byte; null if the memory is not mapped. Memory whose required flags have
   * VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT must stay mapped.
   */
  void* mapped;
  void* handle; /**< yours, such as a VmaAllocation; the library does not use it */
} grisaille_host_memory;

/**
 * Your functions that allocate Vulkan device memory. All memory of the library then comes from
 * them; it calls vkAllocateMemory() nowhere. vmaAllocateMemory() and vmaFreeMemory() fit, with
 * VMA_ALLOCATION_CREATE_MAPPED_BIT for mapped memory.
 */
typedef struct grisaille_host_allocator {
  uint32_t struct_size; /**< sizeof(grisaille_host_allocator) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< your pointer, which the library passes to both functions */
  /**
   * Allocates memory, to which the library binds the buffer or image. The library calls it inside
   * your calls, in the same thread. The function must not call the library.
   * @param context grisaille_host_allocator::context
   * @param request what needs memory
   * @param[out] out the memory, preset to 0
   * @return VK_SUCCESS, or a VkResult: VK_ERROR_OUT_OF_DEVICE_MEMORY becomes error 1007, others
   *   1005. Memory that does not fit the request is error 5611.
   */
  int (*allocate)(void* context, const grisaille_host_memory_request* request,
                  grisaille_host_memory* out);
  /**
   * Frees memory, after the library has destroyed the buffer or image. It is called like
   * `allocate`, and until the device is destroyed.
   * @param context grisaille_host_allocator::context
   * @param memory what `allocate` returned
   */
  void (*free)(void* context, const grisaille_host_memory* memory);
} grisaille_host_allocator;

/** Your Vulkan device. */
typedef struct grisaille_host_vulkan {
  uint32_t struct_size;  /**< sizeof(grisaille_host_vulkan) */
  uint32_t queue_family; /**< family of the queue that you submit to; it supports compute */
  /** 1 to 16. When you record frame n, the GPU has finished frame n - frames_in_flight. */
  uint32_t frames_in_flight;
  uint32_t flags;        /**< grisaille_host_flags combined, or 0 */
  void* instance;        /**< VkInstance */
  void* physical_device; /**< VkPhysicalDevice */
  void* device;          /**< VkDevice */
  /** PFN_vkGetInstanceProcAddr of your loader; null: the library loads libvulkan.so.1 */
  void (*get_instance_proc_addr)(void);
  const char* effect_folder; /**< additional folder of effects, which the library trusts; or null */
  /**
   * VkPipelineCache with which the library creates pipelines: load and save its bytes as for your
   * own pipelines. Not externally synchronized. 0: the library keeps a cache in memory.
   */
  uint64_t pipeline_cache;
  const grisaille_host_log* log;             /**< takes messages; null: they are lost */
  const grisaille_host_allocator* allocator; /**< allocates memory; null: the driver does */
  /**
   * Null, or your VkAllocationCallbacks, which the library passes to every function that creates,
   * allocates, destroys or frees. It copies the struct; the functions must stay callable until the
   * device is destroyed.
   */
  const void* allocation_callbacks;
} grisaille_host_vulkan;

/** Who restores the state of an OpenGL context. */
typedef enum grisaille_host_state {
  /** The library queries the state that a recording changes, some 250 values, and restores it. */
  GRISAILLE_HOST_STATE_RESTORED = 0,
  /**
   * You set what you need after each recording, and the library queries no state. A recording
   * changes the program, the active texture unit, the 2D and 2D array textures and the samplers of
   * units 0 to 15, the image units, uniform and shader storage buffer bindings 0 to 15, the general
   * bindings of both buffers, GL_PIXEL_UNPACK_BUFFER, and the unpack parameters of glPixelStore.
   */
  GRISAILLE_HOST_STATE_KEPT = 1
} grisaille_host_state;

/** Your OpenGL context, which is the current context. */
typedef struct grisaille_host_opengl {
  uint32_t struct_size;      /**< sizeof(grisaille_host_opengl) */
  uint32_t state;            /**< a grisaille_host_state */
  const char* effect_folder; /**< additional folder of effects, which the library trusts; or null */
  /**
   * 1 to 16: how many frames the GPU may be behind without a new allocation of memory; 0: 3. The
   * library never waits: if the GPU is further behind, the recording allocates.
   */
  uint32_t frames_in_flight;
  uint32_t flags;                /**< grisaille_host_flags combined, or 0 */
  const grisaille_host_log* log; /**< takes messages; null: they are lost */
} grisaille_host_opengl;

/**
 * Creates a device on your Vulkan device. It loads the effects that are installed with the library,
 * in lib/grisaille/effects, and the effects in `effect_folder`. It skips every plugin that it
 * cannot load or that has a wrong table.
 * @param vulkan your Vulkan device
 * @param[out] out the device; null after an error
 * @retval 5603 The device lacks version 1.3, a feature, or compute support in the queue family.
 * @retval 5611 frames_in_flight is out of range, flags has an unknown bit, or your function
 * returned memory that does not fit.
 * @retval 1001 The library finds no Vulkan loader.
 * @retval 1004 The loader is older than 1.3.
 * @retval 3106 The library cannot read effect_folder.
 */
GRISAILLE_EXPORT int grisaille_host_device_vulkan(const grisaille_host_vulkan* vulkan,
                                                  grisaille_host_device** out);

/**
 * Creates a device on the OpenGL context that is current in this thread. It loads the same effects
 * as grisaille_host_device_vulkan().
 * @param opengl your OpenGL context
 * @param[out] out the device; null after an error
 * @retval 5604 No context is current.
 * @retval 5611 `state` is not a grisaille_host_state, frames_in_flight is out of range, or flags
 *   has an unknown bit.
 * @retval 1004 The context is older than 4.5, or OpenGL ES.
 * @retval 3106 The library cannot read effect_folder.
 */
GRISAILLE_EXPORT int grisaille_host_device_opengl(const grisaille_host_opengl* opengl,
                                                  grisaille_host_device** out);

/**
 * Destroys a device. Call it after the GPU has finished every recording of the device's effects.
 * @param device the device; null: the call does nothing
 * @retval 5608 An effect or a texture of the device still exists.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_device_destroy(grisaille_host_device* device);

/**
 * Returns the tables of all effects, sorted by key: parameters with their ranges, outputs with
 * their formats. The array and the tables are valid while the device lives.
 * @param device the device
 * @param[out] effects the tables
 * @param[out] count number of tables
 * @return 0, or an error that any function may return
 */
GRISAILLE_EXPORT int grisaille_host_effects(const grisaille_host_device* device,
                                            const grisaille_effect_desc* const** effects,
                                            uint32_t* count);

/** Memory that a device or an effect takes. */
typedef struct grisaille_host_memory_use {
  uint32_t struct_size;  /**< sizeof(grisaille_host_memory_use), set by the caller */
  uint32_t allocations;  /**< number of allocations */
  uint64_t device_bytes; /**< textures and buffers that only the GPU uses */
  uint64_t host_bytes;   /**< buffers that the CPU writes and the GPU reads */
} grisaille_host_memory_use;

/**
 * Returns the memory that a device holds now: that of its effects, and upload buffers that they
 * share, one set for each frame in flight. Vulkan: the bytes that it has allocated. OpenGL: the
 * bytes that it has asked for, to which drivers add some.
 * @param device the device
 * @param[out] out the memory; set its `struct_size` before the call
 * @retval 5602 `out->struct_size` is not the size of a version of the struct.
 */
GRISAILLE_EXPORT int grisaille_host_device_memory(const grisaille_host_device* device,
                                                  grisaille_host_memory_use* out);

/**
 * @}
 * @defgroup host_scene libgrisaille: textures, rays, pictures
 * The effects' inputs from your scene.
 * @{
 */

/** One of your textures, wrapped so that the library can read it. */
typedef struct grisaille_host_texture grisaille_host_texture;

/**
 * Describes a single-sampled 2D texture, or layers of a 2D array. The library reads the first
 * level. It samples the texture as floats; a depth buffer, with or without stencil, works too: D16,
 * D24, D32 (OpenGL), D32F, and those with stencil.
 */
typedef struct grisaille_host_texture_desc {
  uint32_t struct_size; /**< sizeof(grisaille_host_texture_desc) */
  uint32_t format;      /**< Vulkan: VkFormat; OpenGL: 0 */
  /**
   * Vulkan: VkImageLayout of the image before and after each recording: general, read-only, or that
   * of an attachment; not one of transfers or presentation. OpenGL: 0
   */
  uint32_t layout;
  uint32_t width;       /**< pixels; OpenGL: 0 means the texture's width */
  uint32_t height;      /**< pixels; OpenGL: 0 means the texture's height */
  uint32_t first_layer; /**< of an array: the first layer to read; else 0 */
  /**
   * Vulkan: VkImage with VK_IMAGE_USAGE_SAMPLED_BIT, owned by the queue's family (exclusive
   * sharing) or shared by all families (concurrent sharing). OpenGL: name of the texture.
   */
  uint64_t image;
  uint32_t layers;   /**< number of layers from first_layer on; 0: 1 */
  uint32_t reserved; /**< 0 */
} grisaille_host_texture_desc;

/**
 * Wraps a texture. If you recreate the texture, for example in another size, wrap it again.
 * @param device the device
 * @param desc describes the texture
 * @param[out] out the wrapped texture; null after an error
 * @retval 5605 The library cannot sample the texture as described; the line names the format, the
 *   layout or the size. OpenGL: an array must have immutable storage.
 * @retval 1007 No device memory is left.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_texture_wrap(grisaille_host_device* device,
                                                 const grisaille_host_texture_desc* desc,
                                                 grisaille_host_texture** out);

/**
 * Destroys the wrapper, not the texture itself. Recordings that read the texture may be in flight;
 * destroy the VkImage only after they have finished.
 * @param texture the wrapped texture; null: the call does nothing
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_texture_destroy(grisaille_host_texture* texture);

/** Your function that casts rays through your scene. */
typedef struct grisaille_host_rays {
  uint32_t struct_size; /**< sizeof(grisaille_host_rays) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< your pointer, which the library passes to `cast` */
  /**
   * Casts rays. grisaille_host_effect_record() and grisaille_host_effect_draw_at() call it, in the
   * same thread. The function must not call the library. Let rays pass what you do not draw, such
   * as backs that you cull: effects then meet what can be seen.
   * @param context grisaille_host_rays::context
   * @param rays `count` rays
   * @param count number of rays
   * @param[out] hits one per ray, preset to #GRISAILLE_HIT_NONE
   */
  void (*cast)(void* context, const grisaille_ray* rays, uint64_t count, grisaille_hit* hits);
} grisaille_host_rays;

/**
 * Sets the function that casts rays for the device's effects, from the next recording on. Without
 * a function, work that needs rays waits.
 * @param device the device
 * @param rays your function; null, the initial value: no function
 * @return 0, or an error that any function may return
 */
GRISAILLE_EXPORT int grisaille_host_device_set_rays(grisaille_host_device* device,
                                                    const grisaille_host_rays* rays);

/** Your function that draws depth pictures of your scene. */
typedef struct grisaille_host_depths {
  uint32_t struct_size; /**< sizeof(grisaille_host_depths) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< your pointer, which the library passes to `draw` */
  /**
   * Draws a picture, as you draw a shadow map, and reads it back.
   * grisaille_host_effect_record() calls it, in the same thread. The function must not call the
   * library. You need not wait for the GPU: leave the values as they are, and the library asks for
   * the same view in the next recordings. After a few without an answer it asks for other views
   * first.
   * @param context grisaille_host_depths::context
   * @param view origin, direction and size of the picture
   * @param[out] depth `size` x `size` values, see grisaille_host::draw_depth; preset to NaN, which
   *   says that you do not know yet
   */
  void (*draw)(void* context, const grisaille_depth_view* view, float* depth);
} grisaille_host_depths;

/**
 * Sets the function that draws depth pictures for the device's effects, from the next recording on.
 * Effects take them instead of rays during recordings; grisaille_host_effect_draw_at() needs rays.
 * @param device the device
 * @param depths your function; null, the initial value: no function
 * @return 0, or an error that any function may return
 */
GRISAILLE_EXPORT int grisaille_host_device_set_depths(grisaille_host_device* device,
                                                      const grisaille_host_depths* depths);

/** Your function that decodes the picture files that objects name. */
typedef struct grisaille_host_pictures {
  uint32_t struct_size; /**< sizeof(grisaille_host_pictures) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< your pointer, which the library passes to `read` */
  /**
   * Decodes a picture. grisaille_host_effect_record() calls it, in the same thread. The function
   * must not call the library.
   * @param context grisaille_host_pictures::context
   * @param path path of the file
   * @param[out] out the picture; its pixels stay valid until the next call or the end of the
   *   recording
   * @return GRISAILLE_OK, or GRISAILLE_FAILED if the picture does not exist
   */
  grisaille_result (*read)(void* context, const char* path, grisaille_picture* out);
} grisaille_host_pictures;

/**
 * Sets the function that decodes pictures for the device's effects, from the next recording on.
 * Without a function, effects draw objects without their pictures.
 * @param device the device
 * @param pictures your function; null, the initial value: no function
 * @return 0, or an error that any function may return
 */
GRISAILLE_EXPORT int grisaille_host_device_set_pictures(grisaille_host_device* device,
                                                        const grisaille_host_pictures* pictures);

/**
 * @}
 * @defgroup host_effects libgrisaille: effects
 * Effects with their parameters and objects.
 * @{
 */

/** An effect with its parameters, its objects and the textures that it writes. */
typedef struct grisaille_host_effect grisaille_host_effect;

/** The order of rows in the textures that an effect reads and writes. */
typedef enum grisaille_host_rows {
  GRISAILLE_HOST_ROWS_FROM_TOP = 0,   /**< Vulkan's order: texel (0, 0) is the picture's top left */
  GRISAILLE_HOST_ROWS_FROM_BOTTOM = 1 /**< OpenGL's order, unless glClipControl changed it */
} grisaille_host_rows;

/** The value of a parameter, as text. */
typedef struct grisaille_host_setting {
  const char* key;  /**< key of the parameter: "radius" */
  const char* text; /**< as for grisaille_host_effect_set_text(): "0.5" */
} grisaille_host_setting;

/** Describes an effect. */
typedef struct grisaille_host_effect_desc {
  uint32_t struct_size;  /**< sizeof(grisaille_host_effect_desc) */
  uint32_t width;        /**< pixels of the input textures and of the outputs, 1 to 16384 */
  uint32_t height;       /**< pixels; see `width` */
  uint32_t rows;         /**< a grisaille_host_rows, of the input textures and of the outputs */
  uint32_t output_count; /**< number of `outputs`; 0: only the effect's first output */
  /**
   * 2 to 16: the views that each recording draws, such as 2 for stereo. Layer n of every output
   * comes from layer n of every texture and camera n, as if from an effect of its own. 0 or 1: one
   * view, and outputs that are no arrays.
   */
  uint32_t layers;
  const char* effect;                     /**< the effect's key: "ssao" */
  const char* const* outputs;             /**< keys of the wanted outputs: "ao" */
  const grisaille_host_setting* settings; /**< values that differ from the defaults; or null */
  uint32_t setting_count;                 /**< number of `settings` */
  /**
   * 0 to 256: the sizes of grisaille_host_frame::rectangle, beside the present one, for which the
   * effect keeps its memory, for a resolution that changes each frame. It gives up the size that it
   * has not used for the longest time. A recording at a size that it keeps allocates nothing.
   */
  uint32_t kept_sizes;
} grisaille_host_effect_desc;

/**
 * Creates an effect without objects, with default parameter values but for `settings`.
 * @param device the device
 * @param desc describes the effect
 * @param[out] out the effect; null after an error
 * @retval 3201 No effect has this key.
 * @retval 5102 The effect has no output with one of the keys.
 * @retval 3202 The effect fails; the error line quotes its message.
 * @retval 1105 The width or the height is out of range.
 * @retval 5611 `rows` is not a grisaille_host_rows, or `layers` or `kept_sizes` is out of range.
 * @retval 3301 The effect has no parameter with the key of a setting.
 * @retval 3302 The value of a setting is out of the parameter's range.
 * @retval 3303 The value of a setting is not of the parameter's type.
 * @retval 1007 No device memory is left.
 * @retval 1008 The driver refuses a shader.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_create(grisaille_host_device* device,
                                                  const grisaille_host_effect_desc* desc,
                                                  grisaille_host_effect** out);

/**
 * Destroys an effect with its outputs. Its recordings may be in flight, but you must have submitted
 * every command buffer that holds one of them.
 * @param effect the effect; null: the call does nothing
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_destroy(grisaille_host_effect* effect);

/**
 * Sets a parameter, from the next recording on. That recording may compile shaders, unless you call
 * grisaille_host_effect_prepare() before.
 * @param effect the effect
 * @param key key of the parameter
 * @param value a number in the unit of the effect's table, the index of an enum entry, or 0 or 1
 * @retval 3301 The effect has no parameter with this key.
 * @retval 3302 The value is out of the parameter's range.
 * @retval 3303 The value is not of the parameter's type.
 */
GRISAILLE_EXPORT int grisaille_host_effect_set(grisaille_host_effect* effect, const char* key,
                                               double value);

/**
 * Sets a parameter from text; otherwise the same as grisaille_host_effect_set().
 * @param effect the effect
 * @param key key of the parameter
 * @param text the value as on the command line: "0.5", "true", the key of an enum entry
 * @retval 3301 The effect has no parameter with this key.
 * @retval 3302 The value is out of the parameter's range.
 * @retval 3303 The value is not of the parameter's type.
 */
GRISAILLE_EXPORT int grisaille_host_effect_set_text(grisaille_host_effect* effect, const char* key,
                                                    const char* text);

/**
 * Returns the value of a parameter.
 * @param effect the effect
 * @param key key of the parameter
 * @param[out] value the value, in the form that grisaille_host_effect_set() takes
 * @retval 3301 The effect has no parameter with this key.
 */
GRISAILLE_EXPORT int grisaille_host_effect_get(const grisaille_host_effect* effect, const char* key,
                                               double* value);

/**
 * Resizes an effect. Its outputs become new textures. The library destroys the old textures once no
 * recording in flight uses them.
 * @param effect the effect
 * @param width pixels, 1 to 16384
 * @param height pixels, 1 to 16384
 * @retval 1105 The width or the height is out of range.
 * @retval 1007 No device memory is left.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_resize(grisaille_host_effect* effect, uint32_t width,
                                                  uint32_t height);

/**
 * Sets the objects of an effect, from the next recording on. The library copies the objects and
 * their texts. Add new objects at the end: the effect processes only the objects from the first
 * changed one on.
 * @param effect the effect
 * @param objects the objects, laid out as grisaille_effect_desc::objects says, oldest first; may be
 *   null if `count` is 0
 * @param object_size bytes of one object
 * @param count number of objects
 * @retval 3205 The effect takes no objects.
 * @retval 5611 `object_size` differs from the effect's table.
 * @retval 3401 The value of a field is wrong.
 */
GRISAILLE_EXPORT int grisaille_host_effect_set_objects(grisaille_host_effect* effect,
                                                       const void* objects, uint32_t object_size,
                                                       uint64_t count);

/**
 * Sets the objects of an effect from a JSON file that the program `grisaille` saved.
 * @param effect the effect
 * @param path path of the file
 * @retval 3205 The effect takes no objects.
 * @retval 3411 The library cannot read the file.
 * @retval 3412 An object of the file is wrong.
 * @retval 3413 The library does not read this version of the file.
 */
GRISAILLE_EXPORT int grisaille_host_effect_load_objects(grisaille_host_effect* effect,
                                                        const char* path);

/**
 * @}
 * @defgroup host_frame libgrisaille: a frame
 * Functions that record an effect and return its outputs.
 * @{
 */

/** The meaning of the texels of a depth texture. */
typedef enum grisaille_host_depth {
  /**
   * A depth buffer, which holds 0 to 1: clip z / clip w or, with
   * #GRISAILLE_HOST_CLIP_MINUS_ONE_TO_ONE, half of it plus 1/2. The projection says whether depth
   * is reversed and where the planes lie; the sky has the far plane's depth.
   */
  GRISAILLE_HOST_DEPTH_BUFFER = 0,
  /** Metres along the view direction; in the sky 0, or the far plane's distance or more. */
  GRISAILLE_HOST_DEPTH_VIEW = 1,
  /**
   * Metres from the eye (orthographic: along the view direction); in the sky 0, or the far plane's
   * distance or more.
   */
  GRISAILLE_HOST_DEPTH_DISTANCE = 2
} grisaille_host_depth;

/** The range of clip z / clip w between the near and the far plane. */
typedef enum grisaille_host_clip {
  /** Vulkan's and Direct3D's; OpenGL's after glClipControl() with GL_ZERO_TO_ONE. */
  GRISAILLE_HOST_CLIP_ZERO_TO_ONE = 0,
  GRISAILLE_HOST_CLIP_MINUS_ONE_TO_ONE = 1 /**< OpenGL's, unless glClipControl() changed it */
} grisaille_host_clip;

/** The space of normals. */
typedef enum grisaille_host_normals {
  GRISAILLE_HOST_NORMALS_WORLD = 0, /**< world space */
  GRISAILLE_HOST_NORMALS_VIEW = 1   /**< view space */
} grisaille_host_normals;

/** How texels encode the components of normals. */
typedef enum grisaille_host_encoding {
  GRISAILLE_HOST_SIGNED = 0,   /**< components from -1 to 1, as sampled */
  GRISAILLE_HOST_UNSIGNED = 1, /**< (component + 1) / 2 */
  /**
   * Octahedral in the first two channels, each from -1 to 1: with n the normal over the sum of the
   * absolute values of its components, n.xy, or (1 - abs(n.yx)) * sign(n.xy) where n.z < 0 (Meyer
   * et al. 2010). For RG16_SNORM, RG16F.
   */
  GRISAILLE_HOST_OCTAHEDRAL_SIGNED = 2,
  /** The same as (x + 1) / 2: for RG16, RG8, RGB10A2 and other unsigned formats. */
  GRISAILLE_HOST_OCTAHEDRAL_UNSIGNED = 3
} grisaille_host_encoding;

/**
 * The camera that drew the frame, as matrices. Both are column-major: element [4 * column + row].
 *
 * A perspective projection may be off-centre (one eye of a headset, a tile of a large picture) and
 * jittered (for temporal anti-aliasing): pass the matrix that the vertex shader used. An
 * orthographic projection has the last row 0, 0, 0, 1. Depth may be reversed, and the far plane
 * infinite. The library does not use the sign of element 5: grisaille_host_effect_desc::rows says
 * which row of the picture is the top one.
 *
 * Not supported: mirrored, sheared or rotated projections, an oblique near plane, and a view space
 * that looks along +z.
 */
typedef struct grisaille_host_camera {
  uint32_t struct_size; /**< sizeof(grisaille_host_camera) */
  uint32_t clip;        /**< a grisaille_host_clip */
  /** World to view space: a rotation and a translation; the position is within 1e15 m. */
  double view[16];
  /**
   * View to clip space. Perspective: a near plane over 0, at most 1e6 m. Orthographic: planes
   * within 1e9 m, the near one may lie behind the eye.
   */
  double projection[16];
  /**
   * Pixels, x to the right, y down: by how much `projection` shifts the picture for temporal
   * antialiasing, each from -1 to 1; 0 without jitter.
   */
  double jitter[2];
} grisaille_host_camera;

/** A texture of yours that an effect reads by name: see grisaille_effect_desc::inputs. */
typedef struct grisaille_host_input {
  const char* key; /**< the input's key: "reactive", or "ssao.ao" for another effect's output */
  const grisaille_host_texture* texture; /**< the texture */
} grisaille_host_input;

/**
 * A part of the effect's textures, in texels, from the corner of texel (0, 0): the top left one
 * with #GRISAILLE_HOST_ROWS_FROM_TOP, else the bottom left one, as for glViewport().
 */
typedef struct grisaille_host_rectangle {
  uint32_t x;      /**< texels from the corner */
  uint32_t y;      /**< texels from the corner */
  uint32_t width;  /**< texels */
  uint32_t height; /**< texels */
} grisaille_host_rectangle;

/** One frame, as an effect reads it. All textures have the effect's size. */
typedef struct grisaille_host_frame {
  uint32_t struct_size;     /**< sizeof(grisaille_host_frame) */
  uint32_t depth_kind;      /**< a grisaille_host_depth */
  uint32_t normal_space;    /**< a grisaille_host_normals */
  uint32_t normal_encoding; /**< a grisaille_host_encoding */
  uint64_t number; /**< frame number; never decreases; the same for all recordings of a frame */
  void* command_buffer; /**< Vulkan: VkCommandBuffer, recording, outside a render pass; else null */
  /** The camera that drew the frame; as many as the effect has layers, all of one struct_size. */
  const grisaille_host_camera* camera;
  const grisaille_host_texture* depth;  /**< one channel, or a depth buffer */
  const grisaille_host_texture* normal; /**< see normal_encoding; null: facet normals, from depth */
  /**
   * Depth of the nearest surface at or behind the visible one that faces away, in the units of
   * `depth`; null: unknown.
   */
  const grisaille_host_texture* back_depth;
  const grisaille_host_texture* base_colour; /**< three channels, linear when sampled; or null */
  /**
   * One channel of floats: how thick the matter behind the visible surface is on average, metres: 0
   * for sheets such as leaves, for bodies 4 times the volume over the surface; below 0: unknown.
   * Null: unknown everywhere.
   */
  const grisaille_host_texture* thickness;
  /**
   * Depth of the nearest surface behind that of `back_depth` that faces the camera or is two-sided,
   * in the units of `depth`; null: unknown.
   */
  const grisaille_host_texture* next_depth;
  /**
   * Seconds that the effect may spend in this recording on work that can wait for later ones, such
   * as ray casts; 0: no limit. See grisaille_host_effect_report().
   */
  double patience;
  /**
   * The lit colour, linear when sampled: three channels, or four with straight alpha; null if the
   * effect does not read it. To chain two effects that change the colour, wrap the first one's
   * output and pass it to the second.
   */
  const grisaille_host_texture* colour;
  /**
   * Motion vectors in the first two channels: the surface's place in the previous frame minus its
   * place now, in any unit. Null: unknown.
   */
  const grisaille_host_texture* motion;
  /**
   * Factors that convert `motion` to pixels, x to the right, y down. Texture coordinates: width and
   * height; normalised device coordinates with y up: width / 2 and -height / 2; vectors from the
   * previous place to the present one: with the opposite sign.
   */
  double motion_scale[2];
  uint32_t
      motion_jittered;  /**< 1: `motion` includes the difference of the jitters; 0: it does not */
  uint32_t input_count; /**< number of `inputs` */
  const grisaille_host_input* inputs; /**< textures that effects read by name; others are ignored */
  /**
   * The part of all textures that holds the picture: a viewport, or the part that a dynamic
   * resolution draws. The effect reads and writes this part alone; the camera, motion and the
   * effect's results are as of a picture of its size. Other texels of the outputs keep their
   * contents, which are undefined until a recording writes them. All 0: the whole textures.
   */
  grisaille_host_rectangle rectangle;
} grisaille_host_frame;

/**
 * Records the commands of an effect, which write every wanted output at every pixel.
 *
 * The recording waits for all commands recorded before it, and all later commands wait for it. You
 * need no barriers. The library expects each texture in the layout that you wrapped it with, and
 * leaves it in that layout. It leaves an output in the layout that grisaille_host_effect_output()
 * returns. The output must have that layout at the next recording.
 *
 * From the second frame on, the call allocates nothing while size and parameters stay the same; see
 * grisaille_host_effect_desc::kept_sizes for sizes that change.
 *
 * Vulkan: submit the command buffers in the order of recording, each once and as a whole, or call
 * grisaille_host_effect_dropped(). The call changes the compute pipeline and descriptor set 0 of
 * the compute bind point. After error 3203, submit the command buffer nevertheless.
 *
 * @param effect the effect
 * @param frame the frame
 * @retval 5606 The frame's number decreases, or command_buffer is null for Vulkan or not null for
 *   OpenGL.
 * @retval 5607 The camera is wrong.
 * @retval 5605 A texture does not have the effect's size or layers, or the number of channels that
 *   the field takes; the line names its format.
 * @retval 5609 A texture belongs to another device.
 * @retval 5610 The effect reads base colours or the lit colour, but base_colour or colour is null,
 *   or it needs motion or an input that the frame lacks.
 * @retval 5611 A field is not a value of its enum, the rectangle does not lie in the textures, or
 *   your function returned a wrong hit.
 * @retval 3203 The effect fails; the error line quotes its message.
 * @retval 1007 No device memory is left.
 * @retval 1008 The driver refuses a shader.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_record(grisaille_host_effect* effect,
                                                  const grisaille_host_frame* frame);

/** Says what the recordings that follow will be like. */
typedef struct grisaille_host_prepare {
  uint32_t struct_size;  /**< sizeof(grisaille_host_prepare) */
  uint32_t orthographic; /**< 1: for orthographic cameras; 0: for perspective ones */
  /** GRISAILLE_READS() of the optional textures that the frames have, such as #GRISAILLE_NORMAL. */
  uint32_t inputs;
  uint32_t reserved; /**< 0 */
  void* context;     /**< your pointer, which the library passes to `progress` */
  /**
   * Null, or your function, which the call calls after each step, in the same thread. It must not
   * call the library.
   * @param context grisaille_host_prepare::context
   * @param done number of finished steps
   * @param count number of all steps
   */
  void (*progress)(void* context, uint32_t done, uint32_t count);
} grisaille_host_prepare;

/**
 * Compiles the shaders that recordings need with the effect's present parameters, size and objects:
 * a recording as described compiles nothing. Effects of a device share pipelines. Any thread may
 * call it, for example one that loads your program, while no other thread uses the device.
 * @param effect the effect
 * @param how the recordings; null: perspective, with depth alone
 * @retval 5611 A field is out of range.
 * @retval 3202 The effect fails; the error line quotes its message.
 * @retval 3203 The effect fails; the error line quotes its message.
 * @retval 1008 The driver refuses a shader.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_prepare(grisaille_host_effect* effect,
                                                   const grisaille_host_prepare* how);

/**
 * Tells how much memory an effect will take, before you create it. Nothing is created.
 * @param device the device
 * @param desc describes the effect; objects and what rays find may take more
 * @param how the recordings; null: perspective, with depth alone
 * @param[out] out the memory that grisaille_host_effect_memory() returns after some recordings at
 *   the whole size, within 2 %; set its `struct_size` before the call. Each kept size may take as
 *   much again.
 * @retval 5602 `out->struct_size` is not the size of a version of the struct.
 * @retval 5611 A field is out of range.
 * @retval 3201 No effect has this key.
 * @retval 5102 The effect has no output with one of the keys.
 * @retval 1105 The width or the height is out of range.
 * @retval 3202 The effect fails; the error line quotes its message.
 * @retval 3203 The effect fails; the error line quotes its message.
 * @retval 3301 The effect has no parameter with the key of a setting.
 * @retval 3302 The value of a setting is out of the parameter's range.
 * @retval 3303 The value of a setting is not of the parameter's type.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_memory_needed(grisaille_host_device* device,
                                                  const grisaille_host_effect_desc* desc,
                                                  const grisaille_host_prepare* how,
                                                  grisaille_host_memory_use* out);

/**
 * Returns the memory that an effect takes now: its outputs, what it keeps, and what recordings have
 * needed. `host_bytes` is its part of the device's upload buffers: what its largest recording has
 * copied, times the frames in flight.
 * @param effect the effect
 * @param[out] out the memory; set its `struct_size` before the call
 * @retval 5602 `out->struct_size` is not the size of a version of the struct.
 */
GRISAILLE_EXPORT int grisaille_host_effect_memory(const grisaille_host_effect* effect,
                                                  grisaille_host_memory_use* out);

/**
 * Forgets what recordings of an effect have written. Call it for each effect with a recording in a
 * command buffer that you drop instead of submitting, before you record one of them again, in the
 * same frame or in a later one. The effect keeps its parameters, objects and output textures; it
 * uploads again what it needs, and begins a history anew. OpenGL executes recordings at once: there
 * the call is allowed, but never needed.
 * @param effect the effect
 * @retval 3202 The effect fails; the error line quotes its message.
 * @retval 3203 The effect fails while it ends; the call has done its work nevertheless.
 * @retval 1007 No device memory is left.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_dropped(grisaille_host_effect* effect);

/** What an effect reported in its last recording. */
typedef struct grisaille_host_report {
  uint32_t struct_size; /**< sizeof(grisaille_host_report), set by the caller */
  uint32_t reserved;    /**< 0 */
  uint64_t waiting;     /**< pieces of work for later recordings; 0: the outputs are complete */
  uint64_t given_up;    /**< oldest objects for which a limit, say of memory, leaves no room */
  uint64_t coarser;     /**< objects that are drawn less exactly because of a limit */
} grisaille_host_report;

/**
 * Returns what an effect reported in its last recording.
 * @param effect the effect
 * @param[out] out the report; set its `struct_size` before the call
 * @retval 5602 `out->struct_size` is not the size of a version of the struct.
 */
GRISAILLE_EXPORT int grisaille_host_effect_report(const grisaille_host_effect* effect,
                                                  grisaille_host_report* out);

/**
 * Computes on the CPU what an effect draws at points of your scene's surfaces, whether or not a
 * camera sees them: keep score with it. Spread the points over the surfaces that count, in
 * proportion to their area: the share of the alpha with an owner is the share of that area that the
 * owner covers. 100,000 points have a standard error of 0.0016 or less. Keep points that
 * lie close together next to each other, which makes rays coherent.
 *
 * The effect draws the present objects with the present parameters, as recordings do, without the
 * fading of details that a camera's distance causes. Recordings place objects: those that wait, and
 * those that a limit gives up, draw nothing, see grisaille_host_effect_report(). The call casts
 * rays with the function of grisaille_host_device_set_rays(), in the same thread, some tens of
 * thousands in each call of your function. The call uses no graphics API.
 *
 * @param effect the effect
 * @param points `count` points
 * @param count number of points
 * @param[out] drawn `count` results, one per point, in the same order
 * @retval 3209 The effect cannot tell what it draws at points.
 * @retval 5611 A point's position or normal is out of range, or your function returned a wrong hit.
 * @retval 3202 The effect fails; the error line quotes its message.
 * @retval 3203 The effect fails; the error line quotes its message.
 */
GRISAILLE_EXPORT int grisaille_host_effect_draw_at(grisaille_host_effect* effect,
                                                   const grisaille_point* points, uint64_t count,
                                                   grisaille_drawn* drawn);

/** An output: a texture that the library owns. */
typedef struct grisaille_host_output {
  uint32_t struct_size;   /**< sizeof(grisaille_host_output), set by the caller */
  uint32_t format;        /**< a grisaille_format */
  uint32_t native_format; /**< Vulkan: VkFormat; OpenGL: the internal format */
  uint32_t layout;        /**< Vulkan: VkImageLayout after a recording; OpenGL: 0 */
  uint32_t width;         /**< pixels */
  uint32_t height;        /**< pixels */
  uint64_t image;    /**< Vulkan: VkImage, which you may sample and copy; OpenGL: texture name */
  uint64_t view;     /**< Vulkan: VkImageView of all layers; OpenGL: 0 */
  uint32_t layers;   /**< 1: a 2D texture; more: a 2D array */
  uint32_t reserved; /**< 0 */
} grisaille_host_output;

/**
 * Returns an output of an effect. The texture holds a result once you have recorded the effect. It
 * stays the same texture until you resize or destroy the effect.
 * @param effect the effect
 * @param key key of an output that you named when you created the effect
 * @param[out] out the output; set its `struct_size` before the call
 * @retval 5102 The effect has no output with this key, or was created without it.
 */
GRISAILLE_EXPORT int grisaille_host_effect_output(const grisaille_host_effect* effect,
                                                  const char* key, grisaille_host_output* out);

/** @} */

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_HOST_H */
