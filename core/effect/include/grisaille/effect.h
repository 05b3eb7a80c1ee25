/* SPDX-License-Identifier: MIT
 *
 * The C interface of a Grisaille effect.
 *
 * A plugin is a shared library that exports one constant data symbol, `grisaille_plugin`, of type
 * grisaille_plugin_desc. The host checks it before it calls any function of the plugin, and refuses
 * by name and reason what does not fit. Every table is static constant data of the plugin: it stays
 * valid and unchanged while the library is loaded, and the host never frees it.
 *
 * Versions. The major number changes when old plugins no longer run; the host takes only its own.
 * The minor number grows when fields are appended; the host takes its own and older ones. Every
 * struct that crosses begins with its size as the side that filled it knows it, so that a field
 * beyond that size reads as zero. A struct that is longer than the reader knows is refused.
 *
 * Threads. The host calls an effect's functions from one thread at a time, though not always the
 * same. Host functions may be called only from inside an effect's own functions, on that thread.
 *
 * Errors. Functions that return grisaille_result return GRISAILLE_OK or an error; an effect that
 * fails says why through grisaille_host.fail first. No exception may cross.
 *
 * Units are metres, radians, pixels, seconds. Matrices are column-major, vectors are columns. World
 * axes are right-handed with +y up; view space looks along -z. Clip space has y up, depth 1 at the
 * near plane and 0 at infinity. Row 0 of every texture is the top row.
 */
#ifndef GRISAILLE_EFFECT_H
#define GRISAILLE_EFFECT_H

#include "grisaille/shader.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GRISAILLE_MAGIC 0x53495247u /* "GRIS" */
#define GRISAILLE_ABI_MAJOR 1u
#define GRISAILLE_ABI_MINOR 0u

#if defined(_WIN32)
#define GRISAILLE_EXPORT __declspec(dllexport)
#else
#define GRISAILLE_EXPORT __attribute__((visibility("default")))
#endif

typedef enum grisaille_result {
  GRISAILLE_OK = 0,
  GRISAILLE_FAILED = 1,     /* the call did nothing; the host has noted why */
  GRISAILLE_UNSUPPORTED = 2 /* this host does not offer the service */
} grisaille_result;

/* ---- Parameters ------------------------------------------------------------------------------ */

/* Every value crosses as a double: floats and ints as they are, a bool as 0 or 1, an enum as its
 * index. Panel, command line, settings files, sweeps and documentation are made from the table. */
typedef enum grisaille_param_type {
  GRISAILLE_PARAM_FLOAT = 0,
  GRISAILLE_PARAM_INT = 1,
  GRISAILLE_PARAM_BOOL = 2,
  GRISAILLE_PARAM_ENUM = 3
} grisaille_param_type;

typedef enum grisaille_param_flags {
  GRISAILLE_PARAM_LOG = 1,     /* sliders run on a logarithmic scale; soft_min must be over 0 */
  GRISAILLE_PARAM_ADVANCED = 2 /* folded away in the panel */
} grisaille_param_flags;

typedef struct grisaille_param_desc {
  uint32_t struct_size;
  uint32_t type;       /* grisaille_param_type */
  uint32_t flags;      /* of grisaille_param_flags */
  uint32_t enum_count; /* enum: number of entries, 2 ... 64; else 0 */
  const char* key;     /* a-z, 0-9, _; begins with a letter; unique in the effect */
  const char* label;   /* for people: "Kernel size" */
  const char* unit;    /* "m", "px", "rad", "s", or "" */
  const char* tooltip; /* one sentence, without a line break */
  double hard_min;     /* no value outside is ever accepted; bool and enum: 0 */
  double hard_max;     /* bool: 1; enum: enum_count - 1 */
  double soft_min;     /* a slider's range, inside the hard one */
  double soft_max;
  double default_value;
  double step;                    /* a slider's step, over 0 unless the scale is logarithmic */
  const char* const* enum_keys;   /* enum: as on the command line: a-z, 0-9, _, -; unique */
  const char* const* enum_labels; /* enum: for people */
} grisaille_param_desc;

/* ---- What an effect reads and writes --------------------------------------------------------- */

/* Attachments: pictures of the scene that the host draws only when an active effect reads them. */
typedef enum grisaille_attachment {
  GRISAILLE_DEPTH = 0,       /* d32f: clip depth as drawn: 1 near, 0 infinitely far and sky */
  GRISAILLE_VIEW_DEPTH = 1,  /* r32f: distance along the view direction, metres; sky: 0 */
  GRISAILLE_NORMAL = 2,      /* rgba16f: unit world normal, facing the camera, in xyz; sky: 0 */
  GRISAILLE_BASE_COLOUR = 3, /* rgba8 sRGB, read as linear: base colour; sky: 0 */
  /* rgba16f: unit world normal of the triangle itself, facing the camera; sky: 0 */
  GRISAILLE_FACET_NORMAL = 4,
  /* r32f: the view depth, metres, of the nearest surface at or behind the seen one that faces away
   * or has two sides: where the visible body ends. 0 where there is no such surface, and sky */
  GRISAILLE_BACK_DEPTH = 5,
  GRISAILLE_ATTACHMENT_COUNT = 6
} grisaille_attachment;

#define GRISAILLE_READS(attachment) (1u << (attachment))

typedef enum grisaille_format {
  GRISAILLE_FORMAT_R8 = 1,
  GRISAILLE_FORMAT_RGBA8 = 2,
  GRISAILLE_FORMAT_R16F = 3,
  GRISAILLE_FORMAT_RGBA16F = 4,
  GRISAILLE_FORMAT_R32F = 5,
  GRISAILLE_FORMAT_RG32F = 6,
  GRISAILLE_FORMAT_RGBA32F = 7,
  GRISAILLE_FORMAT_R32UI = 8
} grisaille_format;

/* How the composed picture uses an output. */
typedef enum grisaille_role {
  GRISAILLE_ROLE_NONE = 0, /* not at all: only written to a file or shown on its own */
  /* first channel in [0,1], 1 = open: multiplies the light; no R32UI */
  GRISAILLE_ROLE_VISIBILITY = 1,
  /* rgba, straight alpha, linear: laid over the surface's colour */
  GRISAILLE_ROLE_OVERLAY = 2,
  /* r32ui, not composed: 1 + index of the object that the overlay of a pixel belongs to; 0: none */
  GRISAILLE_ROLE_OWNER = 3,
  /* rgb in [0,1], 1 = open: multiplies the light where the picture shows base colours, instead of
   * the effect's other visibilities; four channels */
  GRISAILLE_ROLE_TINT = 4
} grisaille_role;

typedef struct grisaille_output_desc {
  uint32_t struct_size;
  uint32_t format;     /* grisaille_format */
  uint32_t role;       /* grisaille_role */
  const char* key;     /* as in --write KEY=FILE; same alphabet as a parameter's */
  const char* tooltip; /* what the channels mean, with units and range; one line */
} grisaille_output_desc;

/* ---- Resources ------------------------------------------------------------------------------- */

/* 0 names nothing. */
typedef struct grisaille_texture {
  uint32_t id;
} grisaille_texture;
typedef struct grisaille_buffer {
  uint32_t id;
} grisaille_buffer;
typedef struct grisaille_sampler {
  uint32_t id;
} grisaille_sampler;
typedef struct grisaille_pipeline {
  uint32_t id;
} grisaille_pipeline;

typedef struct grisaille_range {
  grisaille_buffer buffer;
  uint32_t reserved; /* 0 */
  uint64_t offset;   /* bytes */
  uint64_t size;     /* bytes; 0: to the buffer's end */
} grisaille_range;

typedef struct grisaille_constant {
  uint32_t id;   /* constant_id in the shader */
  uint32_t bits; /* the bits of a uint, int or float; a bool is 0 or 1 */
} grisaille_constant;

typedef struct grisaille_pipeline_desc {
  uint32_t struct_size;
  uint32_t constant_count;
  const char* label;
  const grisaille_shader* shader; /* a compute shader; valid while the pipeline lives */
  const grisaille_constant* constants;
} grisaille_pipeline_desc;

typedef enum grisaille_texture_usage {
  GRISAILLE_TEXTURE_SAMPLED = 1,
  GRISAILLE_TEXTURE_STORAGE = 2
} grisaille_texture_usage;

typedef struct grisaille_texture_desc {
  uint32_t struct_size;
  uint32_t format; /* grisaille_format */
  uint32_t usage;  /* of grisaille_texture_usage */
  uint32_t width;  /* texels, 1 ... the device's limit */
  uint32_t height;
  uint32_t mips;   /* 0 counts as 1 */
  uint32_t layers; /* 0 counts as 1; more: a shader sees an array, as it may a single layer */
  const char* label;
} grisaille_texture_desc;

typedef struct grisaille_buffer_desc {
  uint32_t struct_size;
  uint32_t reserved; /* 0 */
  uint64_t bytes;    /* a storage buffer of this size */
  const char* label;
} grisaille_buffer_desc;

typedef struct grisaille_sampler_desc {
  uint32_t struct_size;
  uint32_t linear;     /* 1: bilinear within a level, else nearest */
  uint32_t linear_mip; /* 1: between levels */
  uint32_t repeat;     /* 1: repeat, else clamp to the edge */
  const char* label;
} grisaille_sampler_desc;

/* One slot of a dispatch. Fields that its class does not use are ignored. */
typedef struct grisaille_binding {
  uint32_t slot_class; /* grisaille_slot_class */
  uint32_t slot;
  grisaille_range range;     /* uniform, storage */
  grisaille_texture texture; /* texture, image */
  grisaille_sampler sampler; /* texture */
  uint32_t mip;              /* first level; an image is this one level */
  uint32_t mip_count;        /* texture: 0: all that follow */
} grisaille_binding;

typedef struct grisaille_dispatch {
  uint32_t struct_size;
  grisaille_pipeline pipeline;
  const grisaille_binding* bindings;
  uint32_t binding_count;
  uint32_t groups[3];
} grisaille_dispatch;

/* ---- Objects that users make ----------------------------------------------------------------- */

/* An effect may work on a list of objects that users make: decals, probes, brush strokes. Its table
 * says what fields an object has and how a user places one. The list itself, its files, the command
 * line's --add, --load and --save, the panel's list and tools, and undo come from the table. */
typedef enum grisaille_field_type {
  GRISAILLE_FIELD_NUMBER = 0,    /* double, min ... max */
  GRISAILLE_FIELD_COLOUR = 1,    /* float[3]: linear red, green, blue, each 0 ... 1 */
  GRISAILLE_FIELD_POINT = 2,     /* double[3]: world, metres, each within 1e9 of 0 */
  GRISAILLE_FIELD_DIRECTION = 3, /* float[3]: world, unit */
  GRISAILLE_FIELD_TEXT = 4,      /* const char*: one line of UTF-8 of up to 4096 bytes; not null */
  GRISAILLE_FIELD_FILE = 5       /* const char*: a path, otherwise as a text; "": none */
} grisaille_field_type;

typedef enum grisaille_field_flags {
  GRISAILLE_FIELD_REQUIRED = 1 /* a file without it is refused; the default is for the panel */
} grisaille_field_flags;

typedef struct grisaille_field_desc {
  uint32_t struct_size;
  uint32_t type;   /* grisaille_field_type */
  uint32_t flags;  /* of grisaille_field_flags */
  uint32_t offset; /* bytes from the object's beginning, a multiple of the element's size */
  const char* key; /* as in files and on the command line; a parameter's alphabet; unique */
  const char* label;
  const char* unit;         /* of a number, as a parameter's; else "" */
  const char* tooltip;      /* one line */
  double min;               /* number: finite; else 0 */
  double max;               /* number: finite, over min; else 0 */
  double default_value[3];  /* number: the first; text and file: 0 */
  const char* default_text; /* text, file: not null; else null */
} grisaille_field_desc;

/* What placing an object with the pointer sets. */
typedef enum grisaille_placement {
  GRISAILLE_PLACE_RAY = 0,    /* point: the camera's eye; direction: through the pixel */
  GRISAILLE_PLACE_SURFACE = 1 /* point: on the surface that is seen; direction: its facet's normal,
                                 towards the camera. Nothing is placed on the sky. */
} grisaille_placement;

typedef struct grisaille_object_desc {
  uint32_t struct_size;
  uint32_t object_size;     /* bytes of one object, a multiple of 8, up to 4096 */
  uint32_t field_count;     /* 1 ... 64 */
  uint32_t placement;       /* grisaille_placement */
  uint32_t point_field;     /* index of the point that placing sets */
  uint32_t direction_field; /* index of the direction that placing sets */
  const char* key;          /* of the list in files: "decals"; a parameter's alphabet */
  const char* label;        /* of the list, for people: "Decals" */
  const char* tooltip;      /* what one object is, in one line */
  const grisaille_field_desc* fields;
} grisaille_object_desc;

/* The list as one frame sees it. */
typedef struct grisaille_objects {
  uint32_t struct_size;
  uint32_t stride;     /* bytes from one object to the next: grisaille_object_desc.object_size */
  const void* objects; /* oldest first; valid during record */
  uint64_t count;
  uint64_t kept; /* number of leading objects unchanged since the last frame that this instance
                    recorded without an error */
} grisaille_objects;

/* ---- Rays and pictures ----------------------------------------------------------------------- */

typedef struct grisaille_ray {
  double origin[3];   /* world, metres */
  float direction[3]; /* unit */
  float reach;        /* metres, over 0; may be infinite */
} grisaille_ray;

typedef enum grisaille_hit_kind {
  GRISAILLE_HIT_NONE = 0,    /* nothing within reach */
  GRISAILLE_HIT_SURFACE = 1, /* the first surface, from either side; what is cut out lets through */
  GRISAILLE_HIT_UNKNOWN = 2  /* this host cannot tell now; it may in a later frame */
} grisaille_hit_kind;

typedef struct grisaille_hit {
  uint32_t kind;   /* grisaille_hit_kind; the rest is 0 unless a surface is hit */
  float distance;  /* metres along the ray */
  float normal[3]; /* world, unit: of the triangle, towards the ray's origin */
} grisaille_hit;

/* A picture that the host has decoded. */
typedef struct grisaille_picture {
  uint32_t struct_size; /* set by the effect */
  uint32_t width;       /* pixels, over 0 */
  uint32_t height;
  uint32_t reserved;   /* 0 */
  const uint8_t* rgba; /* sRGB, straight alpha, 4 bytes a pixel, top row first; valid until the next
                          read_picture() of this instance or the end of the effect's function */
} grisaille_picture;

/* ---- The host's services --------------------------------------------------------------------- */

/* Valid from create to destroy of one instance; never freed by the effect. `self` is always the
 * table's own address. Resources belong to the instance: it destroys them, and the host destroys
 * what is left after grisaille_effect_desc.destroy. Data is read during the call and not kept. */
typedef struct grisaille_host {
  uint32_t struct_size;
  uint32_t abi_minor; /* what this host offers */
  void* context;      /* the host's own */

  /* Notes why the effect is about to return GRISAILLE_FAILED: one line, copied. */
  void (*fail)(const struct grisaille_host* self, const char* why);

  /* Makes a compute pipeline. GRISAILLE_FAILED: a description that is wrong, a shader of another
   * stage or that the driver refuses, or no memory. This and the other services that make
   * something: inside create() and record(). */
  grisaille_result (*create_pipeline)(const struct grisaille_host* self,
                                      const grisaille_pipeline_desc* desc, grisaille_pipeline* out);
  /* Makes a texture, contents undefined. GRISAILLE_FAILED: a description that is wrong, a size or
   * use that the device does not have, or no memory. */
  grisaille_result (*create_texture)(const struct grisaille_host* self,
                                     const grisaille_texture_desc* desc, grisaille_texture* out);
  /* Makes a storage buffer, contents undefined. GRISAILLE_FAILED: as with textures. */
  grisaille_result (*create_buffer)(const struct grisaille_host* self,
                                    const grisaille_buffer_desc* desc, grisaille_buffer* out);
  /* Makes a sampler. GRISAILLE_FAILED: a description that is wrong, or no memory. */
  grisaille_result (*create_sampler)(const struct grisaille_host* self,
                                     const grisaille_sampler_desc* desc, grisaille_sampler* out);
  /* Ends what the instance owns, inside any of its functions; id 0 does nothing. The memory goes
   * once no frame in flight uses it. Another's id makes the function that is running fail. */
  void (*destroy_pipeline)(const struct grisaille_host* self, grisaille_pipeline pipeline);
  /* As destroy_pipeline. */
  void (*destroy_texture)(const struct grisaille_host* self, grisaille_texture texture);
  /* As destroy_pipeline. */
  void (*destroy_buffer)(const struct grisaille_host* self, grisaille_buffer buffer);
  /* As destroy_pipeline. */
  void (*destroy_sampler)(const struct grisaille_host* self, grisaille_sampler sampler);

  /* What `count` rays hit, one an element of `hits`. GRISAILLE_UNSUPPORTED where the host casts
   * none. Only inside record(). GRISAILLE_FAILED: a ray that is not as said. */
  grisaille_result (*cast_rays)(const struct grisaille_host* self, const grisaille_ray* rays,
                                uint64_t count, grisaille_hit* hits);
  /* Decodes a picture file, such as a FILE field names. GRISAILLE_UNSUPPORTED where the host
   * decodes none. Only inside record(). GRISAILLE_FAILED: the file cannot be read; the host warns
   * of it once, and the effect may go on without it. */
  grisaille_result (*read_picture)(const struct grisaille_host* self, const char* path,
                                   grisaille_picture* out);
} grisaille_host;

/* The camera of a frame, in double precision. The same in single precision, for shaders, is the
 * uniform block of shaders/common/view.glsl. */
typedef struct grisaille_view {
  uint32_t struct_size;
  uint32_t reserved;         /* 0 */
  double position[3];        /* world, metres */
  double world_from_view[9]; /* rotation, column-major 3x3 */
  double clip_from_view[16]; /* a pinhole; reversed depth, infinitely far */
  double near_plane;         /* metres */
  double pixel_slope;        /* height of a pixel at 1 m view depth, metres */
} grisaille_view;

/* One frame of one effect, valid during `record`. */
typedef struct grisaille_frame {
  uint32_t struct_size;
  uint32_t width; /* pixels, of every output, and of every attachment but for the guard band */
  uint32_t height;
  uint32_t wanted;      /* bit n: somebody uses output n; others have texture id 0 */
  uint64_t index;       /* counts the frames of this instance from 0 */
  void* context;        /* the host's own */
  const double* values; /* one a parameter, in the table's order, inside its hard range */
  const grisaille_view* view;
  grisaille_range view_block;           /* uniform buffer for shaders/common/view.glsl */
  const grisaille_texture* attachments; /* GRISAILLE_ATTACHMENT_COUNT; id 0: not asked for */
  const grisaille_texture* outputs;     /* one an output, in the table's order */

  /* Named, timed, not nested; work is recorded only inside. The label is copied. This and what
   * follows: only inside record(). GRISAILLE_FAILED: no label, or inside another pass. */
  grisaille_result (*begin_pass)(const struct grisaille_frame* self, const char* label);
  /* GRISAILLE_FAILED: no pass is open. */
  grisaille_result (*end_pass)(const struct grisaille_frame* self);
  /* Records a dispatch, which sees what was recorded before. Read during the call.
   * GRISAILLE_FAILED: outside a pass, a slot that nothing is bound to, or something bound that is
   * neither the instance's nor the frame's; attachments are only read. */
  grisaille_result (*dispatch)(const struct grisaille_frame* self, const grisaille_dispatch* work);
  /* 1 ... 65536 bytes, copied, as a uniform buffer for this frame. GRISAILLE_FAILED: more, or none;
   * no memory. */
  grisaille_result (*uniform)(const struct grisaille_frame* self, const void* data, uint32_t bytes,
                              grisaille_range* out);
  /* A texture for this frame alone, contents undefined; not destroyed by the effect.
   * GRISAILLE_FAILED: as create_texture. */
  grisaille_result (*transient)(const struct grisaille_frame* self,
                                const grisaille_texture_desc* desc, grisaille_texture* out);
  /* Copies so many bytes to an offset inside one of the instance's buffers. GRISAILLE_FAILED: it is
   * another's; no memory. */
  grisaille_result (*upload_buffer)(const struct grisaille_frame* self, grisaille_buffer buffer,
                                    uint64_t offset, const void* data, uint64_t bytes);
  /* The whole of one level and layer, copied: rows tightly packed, top row first. GRISAILLE_FAILED:
   * it is neither the instance's nor an output; no memory. */
  grisaille_result (*upload_texture)(const struct grisaille_frame* self, grisaille_texture texture,
                                     uint32_t mip, uint32_t layer, const void* data,
                                     uint64_t bytes);

  const grisaille_objects* objects; /* null unless the effect's table declares objects */
  /* Seconds of work that can wait which this frame may still do; may be infinite. */
  double patience;
  /* Tells how many things wait to be drawn in a later frame: the host renders again soon. 0, as
   * before the first call: the picture is whole. */
  grisaille_result (*waiting)(const struct grisaille_frame* self, uint64_t count);

  /* Pixels by which every attachment goes beyond the picture on each side: texture coordinates are
   * what attachmentAt() of shaders/common/view.glsl says. At least what the effect's guard_band
   * asked for, or 0 where the host has nothing beyond the picture. */
  uint32_t guard;
  uint32_t reserved; /* 0 */
} grisaille_frame;

/* ---- The effect ------------------------------------------------------------------------------ */

typedef enum grisaille_effect_flags {
  GRISAILLE_EFFECT_DEFAULT = 1 /* runs where nobody names effects; only of the program's own */
} grisaille_effect_flags;

typedef struct grisaille_effect_desc {
  uint32_t struct_size;
  uint32_t param_count;  /* 0 ... 256 */
  uint32_t output_count; /* 1 ... 16 */
  uint32_t flags;        /* of grisaille_effect_flags */
  const char* key;       /* "ssao": same alphabet as a parameter's, unique among effects */
  const char* label;     /* for people: "Ambient occlusion" */
  const char* version;   /* "1.0.0" */
  const char* tooltip;   /* what it does, in one line */
  const grisaille_param_desc* params;
  const grisaille_output_desc* outputs;

  /* Which attachments it reads with these values for the outputs of which `wanted` holds the bits,
   * as grisaille_frame.wanted does: GRISAILLE_READS(...) combined. May depend on the arguments
   * alone; called at any time, also without an instance. Cannot fail. */
  uint32_t (*reads)(const double* values, uint32_t wanted);

  /* Makes an instance; *out is handed to the others. After a failure no other function is called.
   */
  grisaille_result (*create)(const grisaille_host* host, void** out);

  /* Records one frame. Writes every wanted output at every pixel. After a failure the frame is
   * dropped and the instance stays usable. */
  grisaille_result (*record)(void* instance, const grisaille_frame* frame);

  /* Ends an instance. */
  void (*destroy)(void* instance);

  /* Null: 0. The guard band it wants with these values: by what share of the picture's height,
   * 0 ... 1, the attachments that it reads go beyond the picture on every side. Effects without one
   * get attachments of the picture's size, drawn by themselves. */
  double (*guard_band)(const double* values);

  /* The objects that users make for it; null: none. */
  const grisaille_object_desc* objects;
} grisaille_effect_desc;

typedef struct grisaille_plugin_desc {
  uint32_t magic;     /* GRISAILLE_MAGIC */
  uint32_t abi_major; /* GRISAILLE_ABI_MAJOR */
  uint32_t abi_minor; /* GRISAILLE_ABI_MINOR */
  uint32_t struct_size;
  uint32_t effect_count; /* 1 ... 64 */
  uint32_t reserved;     /* 0 */
  const grisaille_effect_desc* const* effects;
} grisaille_plugin_desc;

#define GRISAILLE_PLUGIN_SYMBOL "grisaille_plugin"

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_EFFECT_H */
