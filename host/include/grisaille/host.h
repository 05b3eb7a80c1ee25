/* SPDX-License-Identifier: MIT */
/**
 * @file
 * The C interface of libgrisaille: the effects in a renderer of your own.
 *
 * Create a device once. Wrap the textures that you draw: depth, and if you have them normals and
 * base colours. Create effects by name. Record them once a frame, and sample their outputs.
 * `find_package(Grisaille)` gives the CMake target Grisaille::grisaille. The same in C++20 is
 * grisaille/host.hpp.
 *
 * @par Errors
 * A function that returns int returns 0, or the number of an error and has done nothing.
 * grisaille_host_last_error() then returns a line: what is wrong, why, and what to do. Each
 * function lists its numbers. Every function may also return
 * - 5601: an argument or a pointer in a struct is null,
 * - 5602: a struct_size is not the struct's,
 * - 5611: a reserved field is not 0,
 * - 9001: a fault of the library,
 * - 9002: no memory,
 * - 1005, 1006, if it calls the graphics API: the driver fails, or has lost the device.
 *
 * No exception leaves the library, and it prints nothing.
 *
 * @par Structs
 * A struct begins with its size, which the caller sets. A field that you do not use is 0.
 *
 * @par Ownership
 * You destroy what you create, effects and textures before their device. The library reads structs
 * and strings during the call and keeps none of them. Objects of the graphics API that you hand
 * over stay yours: the library does not release them, and changes them only as this header says.
 * They outlive everything that is made from them.
 *
 * @par Threads
 * A device, and everything made from it, belongs to one thread at a time. For OpenGL, that thread
 * has the device's context. Devices are independent of one another.
 *
 * @par Units
 * Metres, radians, pixels. Matrices are column-major, vectors are columns. World axes are
 * right-handed; view space looks along -z with y up.
 *
 * @par Vulkan
 * The device has version 1.3 with shaderStorageImageExtendedFormats, synchronization2 and
 * maintenance4 enabled. The library cannot see which features you enabled. It uses function tables
 * of its own, from the loader that the first device of the process names, and submits nothing.
 *
 * @par OpenGL
 * The context has version 4.5, of the core or the compatibility profile, made by GLX or EGL.
 * Recording leaves all state as it was; do not record inside conditional rendering. Creating,
 * resizing and destroying change no state, but call glGetError(), which loses a pending error.
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
 * @return the library's GRISAILLE_HOST_VERSION, at least the header's if both are of one
 * installation
 */
GRISAILLE_EXPORT uint32_t grisaille_host_version(void);

/**
 * Returns the error of the calling thread's last call that failed. It cannot fail. Any thread may
 * call it.
 * @return the line, such as "error E5601: device is null; give what the message names"; "" if no
 * call failed. It is valid until the thread's next failure.
 */
GRISAILLE_EXPORT const char* grisaille_host_last_error(void);

/**
 * @}
 * @defgroup host_devices libgrisaille: devices
 * Your Vulkan device or OpenGL context.
 * @{
 */

/** The library's device on your Vulkan device or OpenGL context. */
typedef struct grisaille_host_device grisaille_host_device;

/** Your Vulkan device. */
typedef struct grisaille_host_vulkan {
  uint32_t struct_size;  /**< sizeof(grisaille_host_vulkan) */
  uint32_t queue_family; /**< of the queue that gets the command buffers; it can compute */
  /** 1 to 16: after this many frames, the recordings of a frame have finished. */
  uint32_t frames_in_flight;
  uint32_t reserved;     /**< 0 */
  void* instance;        /**< VkInstance */
  void* physical_device; /**< VkPhysicalDevice */
  void* device;          /**< VkDevice */
  /** PFN_vkGetInstanceProcAddr of your loader; null: that of libvulkan.so.1 */
  void (*get_instance_proc_addr)(void);
  const char* effect_folder; /**< a further folder of effects, which the library trusts; or null */
} grisaille_host_vulkan;

/** Your OpenGL context: the current one. */
typedef struct grisaille_host_opengl {
  uint32_t struct_size;      /**< sizeof(grisaille_host_opengl) */
  uint32_t reserved;         /**< 0 */
  const char* effect_folder; /**< a further folder of effects, which the library trusts; or null */
} grisaille_host_opengl;

/**
 * Creates a device on your Vulkan device. It loads the effects that are installed beside the
 * library, in lib/grisaille/effects, and those of `effect_folder`. It leaves out plugins that do
 * not fit.
 * @param vulkan your Vulkan device
 * @param[out] out the device; null after an error
 * @retval 5603 The device lacks version 1.3, a feature, or a queue family that computes.
 * @retval 5611 frames_in_flight is out of range.
 * @retval 1001 There is no Vulkan loader.
 * @retval 1004 The loader is older than 1.3.
 * @retval 3106 The library cannot read effect_folder.
 */
GRISAILLE_EXPORT int grisaille_host_device_vulkan(const grisaille_host_vulkan* vulkan,
                                                  grisaille_host_device** out);

/**
 * Creates a device on the OpenGL context that is current on this thread. It loads effects as
 * grisaille_host_device_vulkan() does.
 * @param opengl your OpenGL context
 * @param[out] out the device; null after an error
 * @retval 5604 No context is current.
 * @retval 1004 The context is older than 4.5, or OpenGL ES.
 * @retval 3106 The library cannot read effect_folder.
 */
GRISAILLE_EXPORT int grisaille_host_device_opengl(const grisaille_host_opengl* opengl,
                                                  grisaille_host_device** out);

/**
 * Destroys a device. Before the call, the GPU has finished all that was recorded with it.
 * @param device the device; null: nothing happens
 * @retval 5608 An effect or a texture is left.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_device_destroy(grisaille_host_device* device);

/**
 * Returns the tables of all effects, sorted by key: parameters with their ranges, outputs with
 * their formats. Both results are valid while the device lives.
 * @param device the device
 * @param[out] effects the tables
 * @param[out] count number of tables
 * @return 0, or an error that every function may return
 */
GRISAILLE_EXPORT int grisaille_host_effects(const grisaille_host_device* device,
                                            const grisaille_effect_desc* const** effects,
                                            uint32_t* count);

/**
 * @}
 * @defgroup host_scene libgrisaille: textures, rays, pictures
 * What you give the effects of your scene.
 * @{
 */

/** One of your textures, as the library reads it. */
typedef struct grisaille_host_texture grisaille_host_texture;

/**
 * Describes a 2D texture of one sample. The library reads its first level and layer. It samples the
 * texture as floats, so that a depth buffer with or without stencil fits too.
 */
typedef struct grisaille_host_texture_desc {
  uint32_t struct_size; /**< sizeof(grisaille_host_texture_desc) */
  uint32_t format;      /**< Vulkan: VkFormat; OpenGL: 0 */
  /** Vulkan: VkImageLayout of the image before and after each recording; OpenGL: 0 */
  uint32_t layout;
  uint32_t width;    /**< pixels; OpenGL: 0 stands for the texture's own */
  uint32_t height;   /**< pixels; OpenGL: 0 stands for the texture's own */
  uint32_t reserved; /**< 0 */
  /**
   * Vulkan: VkImage with VK_IMAGE_USAGE_SAMPLED_BIT, exclusive to the queue's family or shared by
   * all families. OpenGL: name of the texture.
   */
  uint64_t image;
} grisaille_host_texture_desc;

/**
 * Wraps a texture. If you create the texture again, in another size for example, wrap it again.
 * @param device the device
 * @param desc describes the texture
 * @param[out] out the wrapped texture; null after an error
 * @retval 5605 The library cannot sample the texture as described.
 * @retval 1007 No device memory is left.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_texture_wrap(grisaille_host_device* device,
                                                 const grisaille_host_texture_desc* desc,
                                                 grisaille_host_texture** out);

/**
 * Destroys the wrapping; the texture itself stays. Recordings with it may be in flight. Destroy the
 * VkImage only after they have finished.
 * @param texture the wrapped texture; null: nothing happens
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_texture_destroy(grisaille_host_texture* texture);

/** Your function that casts rays through your scene. */
typedef struct grisaille_host_rays {
  uint32_t struct_size; /**< sizeof(grisaille_host_rays) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< yours; the library hands it on */
  /**
   * Casts rays. The library calls it inside grisaille_host_effect_record(), on the same thread. It
   * must not call the library.
   * @param context grisaille_host_rays::context
   * @param rays `count` rays
   * @param count number of rays
   * @param[out] hits one for each ray; an untouched one is #GRISAILLE_HIT_NONE
   */
  void (*cast)(void* context, const grisaille_ray* rays, uint64_t count, grisaille_hit* hits);
} grisaille_host_rays;

/**
 * Sets who casts rays for the device's effects, from the next recording on. Without rays, work that
 * needs them waits.
 * @param device the device
 * @param rays your function; null, as at first: nobody
 * @return 0, or an error that every function may return
 */
GRISAILLE_EXPORT int grisaille_host_device_set_rays(grisaille_host_device* device,
                                                    const grisaille_host_rays* rays);

/** Your function that decodes the picture files that objects name. */
typedef struct grisaille_host_pictures {
  uint32_t struct_size; /**< sizeof(grisaille_host_pictures) */
  uint32_t reserved;    /**< 0 */
  void* context;        /**< yours; the library hands it on */
  /**
   * Decodes a picture. The library calls it inside grisaille_host_effect_record(), on the same
   * thread. It must not call the library.
   * @param context grisaille_host_pictures::context
   * @param path path of the file
   * @param[out] out the picture; its pixels stay valid until the next call or the end of the
   *   recording
   * @return GRISAILLE_OK, or GRISAILLE_FAILED if the picture does not exist
   */
  grisaille_result (*read)(void* context, const char* path, grisaille_picture* out);
} grisaille_host_pictures;

/**
 * Sets who decodes pictures for the device's effects, from the next recording on. Without it,
 * objects are drawn without their pictures.
 * @param device the device
 * @param pictures your function; null, as at first: nobody
 * @return 0, or an error that every function may return
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
  GRISAILLE_HOST_ROWS_FROM_TOP = 0,   /**< as in Vulkan: texel (0, 0) is the picture's top left */
  GRISAILLE_HOST_ROWS_FROM_BOTTOM = 1 /**< as in OpenGL, unless glClipControl says otherwise */
} grisaille_host_rows;

/** Describes an effect. */
typedef struct grisaille_host_effect_desc {
  uint32_t struct_size;       /**< sizeof(grisaille_host_effect_desc) */
  uint32_t width;             /**< pixels of the textures read and of the outputs, 1 to 16384 */
  uint32_t height;            /**< pixels, as `width` */
  uint32_t rows;              /**< a grisaille_host_rows, of the textures read and of the outputs */
  uint32_t output_count;      /**< number of `outputs`; 0: the effect's first output alone */
  uint32_t reserved;          /**< 0 */
  const char* effect;         /**< the effect's key: "ssao" */
  const char* const* outputs; /**< keys of the wanted outputs: "ao" */
} grisaille_host_effect_desc;

/**
 * Creates an effect with the defaults of its parameters and without objects.
 * @param device the device
 * @param desc describes the effect
 * @param[out] out the effect; null after an error
 * @retval 3201 There is no such effect.
 * @retval 5102 The effect has no such output.
 * @retval 3202 The effect fails; the line holds its own words.
 * @retval 1105 The width or the height is out of range.
 * @retval 5611 `rows` is none.
 * @retval 1007 No device memory is left.
 * @retval 1008 The driver refuses a shader.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_create(grisaille_host_device* device,
                                                  const grisaille_host_effect_desc* desc,
                                                  grisaille_host_effect** out);

/**
 * Destroys an effect with its outputs. Its recordings may be in flight, but no command buffer that
 * holds one may still wait for its submission.
 * @param effect the effect; null: nothing happens
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_destroy(grisaille_host_effect* effect);

/**
 * Sets a parameter from the next recording on, which may compile shaders.
 * @param effect the effect
 * @param key key of the parameter
 * @param value a number in the unit of the effect's table, an enum's index, or 0 or 1
 * @retval 3301 The effect has no such parameter.
 * @retval 3302 The value is out of the parameter's range.
 * @retval 3303 The value is not of the parameter's type.
 */
GRISAILLE_EXPORT int grisaille_host_effect_set(grisaille_host_effect* effect, const char* key,
                                               double value);

/**
 * Sets a parameter by text, as grisaille_host_effect_set() does by number.
 * @param effect the effect
 * @param key key of the parameter
 * @param text the value as on the command line: "0.5", "true", an enum's key
 * @retval 3301 The effect has no such parameter.
 * @retval 3302 The value is out of the parameter's range.
 * @retval 3303 The value is not of the parameter's type.
 */
GRISAILLE_EXPORT int grisaille_host_effect_set_text(grisaille_host_effect* effect, const char* key,
                                                    const char* text);

/**
 * Returns the value of a parameter.
 * @param effect the effect
 * @param key key of the parameter
 * @param[out] value the value, as grisaille_host_effect_set() takes it
 * @retval 3301 The effect has no such parameter.
 */
GRISAILLE_EXPORT int grisaille_host_effect_get(const grisaille_host_effect* effect, const char* key,
                                               double* value);

/**
 * Gives an effect another size. Its outputs are other textures then. The library destroys the old
 * ones once no recording in flight uses them.
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
 * Sets the objects of an effect from the next recording on. The library copies them and their
 * texts. Add new objects at the end: the effect processes only those from the first changed one on.
 * @param effect the effect
 * @param objects the objects, laid out as grisaille_effect_desc::objects says, oldest first; may be
 *   null if `count` is 0
 * @param object_size bytes of one object
 * @param count number of objects
 * @retval 3205 The effect has no objects.
 * @retval 5611 object_size is not the table's.
 * @retval 3401 The value of a field is wrong.
 */
GRISAILLE_EXPORT int grisaille_host_effect_set_objects(grisaille_host_effect* effect,
                                                       const void* objects, uint32_t object_size,
                                                       uint64_t count);

/**
 * Sets the objects of an effect from a JSON file, as the program `grisaille` saves it.
 * @param effect the effect
 * @param path path of the file
 * @retval 3205 The effect has no objects.
 * @retval 3411 The library cannot read the file.
 * @retval 3412 An object of the file is wrong.
 * @retval 3413 The file has another version.
 */
GRISAILLE_EXPORT int grisaille_host_effect_load_objects(grisaille_host_effect* effect,
                                                        const char* path);

/**
 * @}
 * @defgroup host_frame libgrisaille: a frame
 * Recording an effect and reading its outputs.
 * @{
 */

/** What the texels of a depth texture are. */
typedef enum grisaille_host_depth {
  /** A depth buffer: 0 at the near plane, 1 at the far plane and in the sky. */
  GRISAILLE_HOST_DEPTH_CLIP = 0,
  /** A reversed depth buffer: 1 at the near plane, 0 at the far plane and in the sky. */
  GRISAILLE_HOST_DEPTH_CLIP_REVERSED = 1,
  /** Metres along the view direction; in the sky 0, or the far plane's distance or more. */
  GRISAILLE_HOST_DEPTH_VIEW = 2,
  /** Metres from the eye; in the sky 0, or the far plane's distance or more. */
  GRISAILLE_HOST_DEPTH_DISTANCE = 3
} grisaille_host_depth;

/** The space of normals. */
typedef enum grisaille_host_normals {
  GRISAILLE_HOST_NORMALS_WORLD = 0, /**< world space */
  GRISAILLE_HOST_NORMALS_VIEW = 1   /**< view space */
} grisaille_host_normals;

/** How texels encode the components of normals. */
typedef enum grisaille_host_encoding {
  GRISAILLE_HOST_SIGNED = 0,  /**< components from -1 to 1, as sampled */
  GRISAILLE_HOST_UNSIGNED = 1 /**< (component + 1) / 2 */
} grisaille_host_encoding;

/**
 * A pinhole camera or an orthographic one. Its axis goes through the picture's centre, and its
 * pixels are square.
 */
typedef struct grisaille_host_camera {
  uint32_t struct_size; /**< sizeof(grisaille_host_camera) */
  uint32_t reserved;    /**< 0 */
  double position[3];   /**< world, metres */
  /** Rotation: its columns are the picture's right and up, and backwards, in world space. */
  double world_from_view[9];
  double vertical_angle;      /**< radians that the height spans, 0.01 to 3.1; 0: orthographic */
  double orthographic_height; /**< metres that the height spans, over 0, at most 1e9; pinhole: 0 */
  double near_plane;          /**< metres, over 0, at most 1e6 */
  /** Metres, over near_plane. Pinhole: 0 or infinity means none; orthographic: at most 1e9. */
  double far_plane;
} grisaille_host_camera;

/** One frame, as an effect reads it. All textures have the effect's size. */
typedef struct grisaille_host_frame {
  uint32_t struct_size;     /**< sizeof(grisaille_host_frame) */
  uint32_t depth_kind;      /**< a grisaille_host_depth */
  uint32_t normal_space;    /**< a grisaille_host_normals */
  uint32_t normal_encoding; /**< a grisaille_host_encoding */
  uint64_t number;          /**< never falls; all recordings of one frame have the same */
  void* command_buffer; /**< Vulkan: VkCommandBuffer, recording, outside a render pass; else null */
  const grisaille_host_camera* camera;  /**< the camera that drew the frame */
  const grisaille_host_texture* depth;  /**< one channel, or a depth buffer */
  const grisaille_host_texture* normal; /**< three channels; null: facet normals from depth */
  /**
   * Depth of the nearest surface at or behind the visible one that faces away, in the units of
   * `depth`; null: not known.
   */
  const grisaille_host_texture* back_depth;
  const grisaille_host_texture* base_colour; /**< three channels, linear when sampled; null: none */
} grisaille_host_frame;

/**
 * Records an effect: all its wanted outputs, at every pixel.
 *
 * The recording waits for all commands recorded before it, and all later commands wait for it. You
 * need no barrier of your own. The library reads each texture in the layout that you wrapped it
 * with, and leaves it in that layout. It leaves an output in the layout that
 * grisaille_host_effect_output() returns. The output must have that layout at the next recording.
 *
 * From the second frame on, the call allocates nothing while the size and the parameters stay.
 *
 * Vulkan: submit command buffers in the order of recording, each once and whole. After the call,
 * another compute pipeline and another descriptor set 0 are bound to compute. After error 3203,
 * submit the command buffer all the same.
 *
 * @param effect the effect
 * @param frame the frame
 * @retval 5606 The frame's number falls, or the command buffer is missing or not expected.
 * @retval 5607 The camera is wrong.
 * @retval 5605 A texture has another size, or too few channels.
 * @retval 5609 A texture is of another device.
 * @retval 5610 The effect reads base colours, and there are none.
 * @retval 5611 The value of an enum is none, or a hit of your rays is wrong.
 * @retval 3203 The effect fails; the line holds its own words.
 * @retval 1007 No device memory is left.
 * @retval 1008 The driver refuses a shader.
 * @retval 5604 The device's context is not current.
 */
GRISAILLE_EXPORT int grisaille_host_effect_record(grisaille_host_effect* effect,
                                                  const grisaille_host_frame* frame);

/** An output: a texture of the library. */
typedef struct grisaille_host_output {
  uint32_t struct_size;   /**< sizeof(grisaille_host_output), set by the caller */
  uint32_t format;        /**< a grisaille_format */
  uint32_t native_format; /**< Vulkan: VkFormat; OpenGL: the internal format */
  uint32_t layout;        /**< Vulkan: VkImageLayout after a recording; OpenGL: 0 */
  uint32_t width;         /**< pixels */
  uint32_t height;        /**< pixels */
  uint64_t image; /**< Vulkan: VkImage, to sample and to copy from; OpenGL: name of the texture */
  uint64_t view;  /**< Vulkan: VkImageView; OpenGL: 0 */
} grisaille_host_output;

/**
 * Returns an output of an effect. It holds a result once the effect is recorded. It stays the same
 * texture until the effect is resized or destroyed.
 * @param effect the effect
 * @param key key of an output that the effect was created with
 * @param[out] out the output; set its `struct_size` before the call
 * @retval 5102 The effect has no such output, or was created without it.
 */
GRISAILLE_EXPORT int grisaille_host_effect_output(const grisaille_host_effect* effect,
                                                  const char* key, grisaille_host_output* out);

/** @} */

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_HOST_H */
