/* SPDX-License-Identifier: MIT
 *
 * The C interface of libgrisaille: the effects, in a program that has a renderer of its own.
 *
 * A host makes a device once, wraps the textures that it draws (depth; where it has them normals
 * and base colours), makes effects by name, and records them once a frame; each effect's outputs
 * are textures that it then samples. `find_package(Grisaille)` gives the target
 * Grisaille::grisaille; grisaille/host.hpp is the same in C++.
 *
 * Errors. A function that returns int returns 0, or the number of an error and has done nothing;
 * grisaille_host_last_error() then says what, why and what to do. Every function may return 5601
 * (a null pointer), 5602 (a struct_size that is not the struct's), 9002 (no memory), and where it
 * calls the graphics API 1005 and 1006 (the driver fails, or has lost the device); what else it may
 * return stands with it. No exception leaves the library, and no message is printed.
 *
 * Structs begin with their size, which the caller sets, and are otherwise 0 where nothing is meant.
 *
 * Ownership. What a function makes is the host's to destroy, effects and textures before their
 * device. Structs and strings are read during the call and not kept. What the library is handed of
 * the graphics API stays the host's: it is neither released nor changed but as said here, and it
 * outlives what is made of it.
 *
 * Threads. A device, and all that is made of it, belongs to one thread at a time; for OpenGL to one
 * that has the device's context. Devices know nothing of one another.
 *
 * Units are metres, radians, pixels. Matrices are column-major, vectors are columns. World axes are
 * right-handed; view space looks along -z with y up.
 *
 * Vulkan. The device has version 1.3 with shaderStorageImageExtendedFormats, synchronization2 and
 * maintenance4 enabled, which the library cannot see. It uses function tables of its own, of the
 * loader that the first device of the process names, and submits nothing.
 *
 * OpenGL. The context has version 4.5, of the core or the compatibility profile, made by GLX or
 * EGL. Recording leaves all state as it was, and is no part of conditional rendering. Making,
 * resizing and destroying change no state, but ask glGetError(), so that an error that waited there
 * is lost.
 */
#ifndef GRISAILLE_HOST_H
#define GRISAILLE_HOST_H

#include "grisaille/effect.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GRISAILLE_HOST_VERSION 1u /* grows when functions or fields are added */

/* What the library makes of the host's device or context, and on it. */
typedef struct grisaille_host_device grisaille_host_device;
/* One of the host's textures, as the library reads it. */
typedef struct grisaille_host_texture grisaille_host_texture;
/* An effect at work, with values of its own and the textures that it writes. */
typedef struct grisaille_host_effect grisaille_host_effect;

/* ---- The library ----------------------------------------------------------------------------- */

/* The library's GRISAILLE_HOST_VERSION, which is at least the header's where both are of one
 * installation. Cannot fail; any thread. */
GRISAILLE_EXPORT uint32_t grisaille_host_version(void);

/* The line of the calling thread's last call that failed: "error E5601: <what and why>; <what to
 * do>", or "" where none did. Good until that thread's next failure. Cannot fail; any thread. */
GRISAILLE_EXPORT const char* grisaille_host_last_error(void);

/* ---- Devices --------------------------------------------------------------------------------- */

typedef struct grisaille_host_vulkan {
  uint32_t struct_size;
  uint32_t queue_family;     /* of the queue that gets the command buffers: one that computes */
  uint32_t frames_in_flight; /* 1 ... 16: a frame's recordings have finished when those of the frame
                                so many later begin */
  uint32_t reserved;         /* 0 */
  void* instance;            /* VkInstance */
  void* physical_device;     /* VkPhysicalDevice */
  void* device;              /* VkDevice */
  void (*get_instance_proc_addr)(void); /* the loader's PFN_vkGetInstanceProcAddr; null:
                                           libvulkan.so.1's */
  const char*
      effect_folder; /* a further folder of effects, whose plugins are trusted; may be null */
} grisaille_host_vulkan;

typedef struct grisaille_host_opengl {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  const char*
      effect_folder; /* a further folder of effects, whose plugins are trusted; may be null */
} grisaille_host_opengl;

/* Makes a device of the host's Vulkan device. Loads the effects that are installed beside the
 * library, in lib/grisaille/effects, and those of `effect_folder`; plugins that do not fit are left
 * out. Errors: 5603 (handles, the queue family or what the device lacks), 5611 (frames_in_flight),
 * 1001 (no Vulkan loader), 1004 (the loader or the device is older than 1.3), 3106
 * (effect_folder). */
GRISAILLE_EXPORT int grisaille_host_device_vulkan(const grisaille_host_vulkan* vulkan,
                                                  grisaille_host_device** out);

/* The same of the OpenGL context that is current on this thread. Errors: 5604 (none is current),
 * 1004 (it is older than 4.5, or OpenGL ES), 3106 (effect_folder). */
GRISAILLE_EXPORT int grisaille_host_device_opengl(const grisaille_host_opengl* opengl,
                                                  grisaille_host_device** out);

/* Ends a device; the GPU has finished with all that was recorded with it. Null: nothing. Errors:
 * 5608 (an effect or a texture is left), 5604 (its context is not current). */
GRISAILLE_EXPORT int grisaille_host_device_destroy(grisaille_host_device* device);

/* The tables of all effects, by key: parameters with their ranges, outputs with their formats, as
 * grisaille/effect.h has them. Both results are good while the device lives. No errors of its
 * own. */
GRISAILLE_EXPORT int grisaille_host_effects(const grisaille_host_device* device,
                                            const grisaille_effect_desc* const** effects,
                                            uint32_t* count);

/* ---- The host's textures --------------------------------------------------------------------- */

/* A 2D texture of one sample, whose first level and layer are read; sampled as floats, so also a
 * depth buffer, with or without stencil. */
typedef struct grisaille_host_texture_desc {
  uint32_t struct_size;
  uint32_t format; /* Vulkan: VkFormat; OpenGL: 0 */
  uint32_t layout; /* Vulkan: the VkImageLayout that it is in whenever it is recorded, and again
                      afterwards; OpenGL: 0 */
  uint32_t width;  /* pixels; OpenGL: 0: as the texture has them */
  uint32_t height;
  uint32_t reserved; /* 0 */
  uint64_t image;    /* a VkImage of VK_IMAGE_USAGE_SAMPLED_BIT, exclusive to the queue's family or
                        shared by all; or an OpenGL texture's name */
} grisaille_host_texture_desc;

/* Wraps a texture. A texture that the host makes anew, as of another size, is wrapped anew. Errors:
 * 5605 (it cannot be read so), 1007 (no device memory), 5604 (the context is not current). */
GRISAILLE_EXPORT int grisaille_host_texture_wrap(grisaille_host_device* device,
                                                 const grisaille_host_texture_desc* desc,
                                                 grisaille_host_texture** out);

/* Ends a wrapping; the texture itself stays. Allowed while recordings with it are in flight, after
 * which alone the host destroys the VkImage. Null: nothing. Errors: 5604 (the context is not
 * current). */
GRISAILLE_EXPORT int grisaille_host_texture_destroy(grisaille_host_texture* texture);

/* Who casts rays through the host's scene. */
typedef struct grisaille_host_rays {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  void* context;     /* the host's, handed on as it is */
  /* Fills in one hit a ray, on the calling thread, inside grisaille_host_effect_record(); what it
   * leaves alone is GRISAILLE_HIT_NONE. It does not call the library. */
  void (*cast)(void* context, const grisaille_ray* rays, uint64_t count, grisaille_hit* hits);
} grisaille_host_rays;

/* Sets who casts rays for the device's effects from the next recording on. Null: nobody, as at
 * first; what an effect asks of rays then waits. Errors: 5611 (reserved). */
GRISAILLE_EXPORT int grisaille_host_device_set_rays(grisaille_host_device* device,
                                                    const grisaille_host_rays* rays);

/* Who decodes picture files that objects name. */
typedef struct grisaille_host_pictures {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  void* context;     /* the host's, handed on as it is */
  /* Fills in `out`, on the calling thread, inside grisaille_host_effect_record(). The pixels stay
   * valid until the next call or the end of the recording. Returns GRISAILLE_OK, or
   * GRISAILLE_FAILED where there is no such picture. It does not call the library. */
  grisaille_result (*read)(void* context, const char* path, grisaille_picture* out);
} grisaille_host_pictures;

/* Sets who decodes pictures for the device's effects from the next recording on. Null: nobody, as
 * at first; objects are then drawn without their pictures. Errors: 5611 (reserved). */
GRISAILLE_EXPORT int grisaille_host_device_set_pictures(grisaille_host_device* device,
                                                        const grisaille_host_pictures* pictures);

/* ---- Effects --------------------------------------------------------------------------------- */

typedef enum grisaille_host_rows {
  GRISAILLE_HOST_ROWS_FROM_TOP = 0,   /* Vulkan's way: texel (0, 0) is the picture's top left */
  GRISAILLE_HOST_ROWS_FROM_BOTTOM = 1 /* OpenGL's way, unless glClipControl says otherwise */
} grisaille_host_rows;

typedef struct grisaille_host_effect_desc {
  uint32_t struct_size;
  uint32_t width; /* pixels of the textures read and of the outputs, 1 ... 16384 */
  uint32_t height;
  uint32_t rows;              /* grisaille_host_rows, of the textures read and of the outputs */
  uint32_t output_count;      /* 0: the first of the effect's outputs alone */
  uint32_t reserved;          /* 0 */
  const char* effect;         /* its key: "ssao" */
  const char* const* outputs; /* keys of the outputs that are wanted: "ao" */
} grisaille_host_effect_desc;

/* Makes an effect with its parameters' defaults and no objects. Errors: 3201 (no such effect), 5102
 * (no such output), 3202 (the effect's own words), 1105 (width or height), 5611 (rows), 1007 (no
 * device memory), 1008 (the driver refuses a shader), 5604 (the context is not current). */
GRISAILLE_EXPORT int grisaille_host_effect_create(grisaille_host_device* device,
                                                  const grisaille_host_effect_desc* desc,
                                                  grisaille_host_effect** out);

/* Ends an effect with its outputs. Allowed while its recordings are in flight, but not while a
 * command buffer that holds one waits to be submitted. Null: nothing. Errors: 5604 (the context is
 * not current). */
GRISAILLE_EXPORT int grisaille_host_effect_destroy(grisaille_host_effect* effect);

/* Sets a parameter: a number in the unit of the effect's table, an enum's index, or 0 or 1. It
 * holds from the next recording on, which may compile shaders then. Errors: 3301 (no such
 * parameter), 3302 (out of its range), 3303 (not of its type). */
GRISAILLE_EXPORT int grisaille_host_effect_set(grisaille_host_effect* effect, const char* key,
                                               double value);

/* The same by text, as on the command line: "0.5", "true", an enum's key. Errors: 3301, 3302,
 * 3303. */
GRISAILLE_EXPORT int grisaille_host_effect_set_text(grisaille_host_effect* effect, const char* key,
                                                    const char* text);

/* A parameter's value, as grisaille_host_effect_set() takes it. Errors: 3301 (no such parameter).
 */
GRISAILLE_EXPORT int grisaille_host_effect_get(const grisaille_host_effect* effect, const char* key,
                                               double* value);

/* Gives it another size, in pixels. Its outputs are other textures then; those that were go once no
 * recording in flight uses them. Errors: 1105 (the size), 1007 (no device memory), 5604 (the
 * context is not current). */
GRISAILLE_EXPORT int grisaille_host_effect_resize(grisaille_host_effect* effect, uint32_t width,
                                                  uint32_t height);

/* Sets the objects that the effect works on from the next recording on: `count` of `object_size`
 * bytes each, laid out as grisaille_effect_desc.objects of the effect says, oldest first. They and
 * their texts are copied; null with a count of 0. Leading objects that are equal to those before
 * are not worked out again, so that objects are best added at the end. Errors: 3205 (the effect has
 * none), 5611 (object_size is not the table's), 3401 (a field's value; nothing is changed). */
GRISAILLE_EXPORT int grisaille_host_effect_set_objects(grisaille_host_effect* effect,
                                                       const void* objects, uint32_t object_size,
                                                       uint64_t count);

/* The same from a JSON file, as the program saves it. Errors: 3205, 3411 (it cannot be read), 3412
 * (an object of it), 3413 (its version). */
GRISAILLE_EXPORT int grisaille_host_effect_load_objects(grisaille_host_effect* effect,
                                                        const char* path);

/* ---- A frame --------------------------------------------------------------------------------- */

/* What the texels of a depth texture are. */
typedef enum grisaille_host_depth {
  GRISAILLE_HOST_DEPTH_CLIP = 0,          /* a depth buffer: 0 at the near plane, 1 at the far one,
                                             and in the sky */
  GRISAILLE_HOST_DEPTH_CLIP_REVERSED = 1, /* 1 at the near plane, 0 at the far one and in the sky */
  GRISAILLE_HOST_DEPTH_VIEW = 2,          /* metres along the view direction; sky: 0, or the far
                                             plane and more */
  GRISAILLE_HOST_DEPTH_DISTANCE = 3       /* metres from the eye; sky as above */
} grisaille_host_depth;

typedef enum grisaille_host_normals {
  GRISAILLE_HOST_NORMALS_WORLD = 0,
  GRISAILLE_HOST_NORMALS_VIEW = 1
} grisaille_host_normals;

typedef enum grisaille_host_encoding {
  GRISAILLE_HOST_SIGNED = 0,  /* components from -1 to 1, as the texture's format has them */
  GRISAILLE_HOST_UNSIGNED = 1 /* (component + 1) / 2 */
} grisaille_host_encoding;

/* A pinhole camera or an orthographic one, whose axis goes through the picture's centre and whose
 * pixels are square. */
typedef struct grisaille_host_camera {
  uint32_t struct_size;
  uint32_t reserved;  /* 0 */
  double position[3]; /* world, metres */
  double
      world_from_view[9]; /* rotation: its columns are the picture's right and up, and backwards */
  double vertical_angle;  /* radians that the picture's height spans, over 0 and under pi; 0:
                             orthographic */
  double orthographic_height; /* metres that the picture's height spans; of a pinhole: 0 */
  double near_plane;          /* metres, over 0; orthographic: finite */
  double far_plane;           /* metres, over the near plane; 0 or infinite: none, of a pinhole */
} grisaille_host_camera;

typedef struct grisaille_host_frame {
  uint32_t struct_size;
  uint32_t depth_kind;      /* grisaille_host_depth */
  uint32_t normal_space;    /* grisaille_host_normals */
  uint32_t normal_encoding; /* grisaille_host_encoding */
  uint64_t number;      /* of the host's frame: never falls, and what is recorded in one frame has
                           one number */
  void* command_buffer; /* Vulkan: VkCommandBuffer, recording, outside a render pass; else null */
  const grisaille_host_camera* camera;
  const grisaille_host_texture* depth;
  const grisaille_host_texture* normal; /* three channels; null: those of the facets, from depth */
  const grisaille_host_texture* back_depth; /* of the nearest surface at or behind the seen one that
                                               faces away, as `depth` otherwise; null: not known */
  const grisaille_host_texture* base_colour; /* three channels, linear when sampled; null: none */
} grisaille_host_frame;

/* Records an effect: all its wanted outputs, at every pixel. It waits for all that was recorded
 * before it and all that is recorded later waits for it, so that the host needs no barrier of its
 * own. Textures are read in the layout that they were wrapped with and left in it. Outputs are left
 * in the layout that grisaille_host_effect_output() tells, and are to be in it at the next
 * recording.
 *
 * Allocates nothing from the second frame on, as long as size and parameters stay. Vulkan: command
 * buffers are submitted in the order of recording, each once and whole; the compute pipeline and
 * the descriptor set 0 that were bound to compute are others afterwards. After an error past the
 * checks of what is given (3203), the command buffer is to be submitted all the same.
 *
 * Errors: 5606 (the frame's number falls, or the command buffer), 5607 (the camera), 5605 (a
 * texture's size or channels), 5609 (a texture of another device), 5610 (base colours are read, and
 * none are given), 5611 (an enum's value, or a hit of the host's rays), 3203 (the effect's own
 * words), 1007, 1008, 5604 (the context is not current). */
GRISAILLE_EXPORT int grisaille_host_effect_record(grisaille_host_effect* effect,
                                                  const grisaille_host_frame* frame);

/* A texture of the library's own. */
typedef struct grisaille_host_output {
  uint32_t struct_size;   /* set by the host */
  uint32_t format;        /* grisaille_format */
  uint32_t native_format; /* VkFormat, or OpenGL's internal format */
  uint32_t layout;        /* VkImageLayout after a recording; OpenGL: 0 */
  uint32_t width;         /* pixels */
  uint32_t height;
  uint64_t image; /* VkImage, which is sampled and copied from; or the OpenGL texture's name */
  uint64_t view;  /* VkImageView; OpenGL: 0 */
} grisaille_host_output;

/* An output that the effect was made with, by its key. It holds something once the effect is
 * recorded, and stays the same texture until the effect is resized or destroyed. Errors: 5102 (no
 * such output, or it was not asked for). */
GRISAILLE_EXPORT int grisaille_host_effect_output(const grisaille_host_effect* effect,
                                                  const char* key, grisaille_host_output* out);

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_HOST_H */
