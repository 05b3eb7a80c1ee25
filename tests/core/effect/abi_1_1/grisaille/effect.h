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
#define GRISAILLE_ABI_MINOR 1u

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
  /* Since 1.1. rgba16f: unit world normal of the triangle itself, facing the camera; sky: 0 */
  GRISAILLE_FACET_NORMAL = 4,
  GRISAILLE_ATTACHMENT_COUNT = 5
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
  GRISAILLE_ROLE_VISIBILITY =
      1,                    /* first channel in [0,1], 1 = open: multiplies the light; no R32UI */
  GRISAILLE_ROLE_PAINT = 2, /* rgba, straight alpha, linear: laid over the surface's colour */
  /* Since 1.1; r32ui, not composed: whose the paint of a pixel is, 1 + number of the shot; 0: none
   */
  GRISAILLE_ROLE_OWNER = 3
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
  uint32_t layers; /* 0 counts as 1 */
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

/* ---- Rays and shots, since 1.1 --------------------------------------------------------------- */

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

/* What the user has fired, once and for good: a muzzle, a direction, a colour. The host checks that
 * all is finite and inside its range. */
typedef struct grisaille_shot {
  double origin[3];   /* world, metres */
  float direction[3]; /* unit */
  float color[3];     /* linear, each 0 ... 1 */
  float range;        /* metres, over 0; 0: as the effect's parameter says */
  uint32_t reserved;  /* 0 */
} grisaille_shot;

/* The shots as a frame sees them. */
typedef struct grisaille_shots {
  uint32_t struct_size;
  uint32_t stride;             /* bytes from one shot to the next */
  const grisaille_shot* shots; /* oldest first; valid during record */
  uint64_t count;
  uint64_t kept; /* so many of the first are those that this instance's frame before had */
} grisaille_shots;

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

  grisaille_result (*create_pipeline)(const struct grisaille_host* self,
                                      const grisaille_pipeline_desc* desc, grisaille_pipeline* out);
  grisaille_result (*create_texture)(const struct grisaille_host* self,
                                     const grisaille_texture_desc* desc, grisaille_texture* out);
  grisaille_result (*create_buffer)(const struct grisaille_host* self,
                                    const grisaille_buffer_desc* desc, grisaille_buffer* out);
  grisaille_result (*create_sampler)(const struct grisaille_host* self,
                                     const grisaille_sampler_desc* desc, grisaille_sampler* out);
  /* Allowed at any time; id 0 does nothing. The memory goes once no frame in flight uses it. */
  void (*destroy_pipeline)(const struct grisaille_host* self, grisaille_pipeline pipeline);
  void (*destroy_texture)(const struct grisaille_host* self, grisaille_texture texture);
  void (*destroy_buffer)(const struct grisaille_host* self, grisaille_buffer buffer);
  void (*destroy_sampler)(const struct grisaille_host* self, grisaille_sampler sampler);

  /* Since 1.1. What `count` rays hit, one an element of `hits`. GRISAILLE_UNSUPPORTED where the
   * host casts none. Only inside record(). */
  grisaille_result (*cast_rays)(const struct grisaille_host* self, const grisaille_ray* rays,
                                uint64_t count, grisaille_hit* hits);
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
  uint32_t width; /* pixels, of every attachment and output */
  uint32_t height;
  uint32_t wanted;      /* bit n: somebody uses output n; others have texture id 0 */
  uint64_t index;       /* counts the frames of this instance from 0 */
  void* context;        /* the host's own */
  const double* values; /* one a parameter, in the table's order, inside its hard range */
  const grisaille_view* view;
  grisaille_range view_block;           /* uniform buffer for shaders/common/view.glsl */
  const grisaille_texture* attachments; /* GRISAILLE_ATTACHMENT_COUNT; id 0: not asked for */
  const grisaille_texture* outputs;     /* one an output, in the table's order */

  /* Named, timed, not nested; work is recorded only inside. The label is copied. */
  grisaille_result (*begin_pass)(const struct grisaille_frame* self, const char* label);
  grisaille_result (*end_pass)(const struct grisaille_frame* self);
  grisaille_result (*dispatch)(const struct grisaille_frame* self, const grisaille_dispatch* work);
  /* 1 ... 65536 bytes as a uniform buffer for this frame. */
  grisaille_result (*uniform)(const struct grisaille_frame* self, const void* data, uint32_t bytes,
                              grisaille_range* out);
  /* A texture for this frame alone, contents undefined; not destroyed by the effect. */
  grisaille_result (*transient)(const struct grisaille_frame* self,
                                const grisaille_texture_desc* desc, grisaille_texture* out);
  grisaille_result (*upload_buffer)(const struct grisaille_frame* self, grisaille_buffer buffer,
                                    uint64_t offset, const void* data, uint64_t bytes);
  /* The whole of one level and layer: rows tightly packed, top row first. */
  grisaille_result (*upload_texture)(const struct grisaille_frame* self, grisaille_texture texture,
                                     uint32_t mip, uint32_t layer, const void* data,
                                     uint64_t bytes);

  /* Since 1.1. */
  const grisaille_shots* shots; /* null unless the effect takes shots */
  double
      patience; /* seconds of work that can wait which this frame may still do; may be infinite */
  /* So many things wait to be drawn: the host renders again soon. 0, as before the first call: the
   * picture is whole. */
  grisaille_result (*waiting)(const struct grisaille_frame* self, uint64_t count);
} grisaille_frame;

/* ---- The effect ------------------------------------------------------------------------------ */

typedef enum grisaille_effect_flags {
  GRISAILLE_EFFECT_TAKES_SHOTS = 1 /* since 1.1: frames carry the user's shots */
} grisaille_effect_flags;

typedef struct grisaille_effect_desc {
  uint32_t struct_size;
  uint32_t param_count;  /* 0 ... 256 */
  uint32_t output_count; /* 1 ... 16 */
  uint32_t reserved;     /* 0 */
  const char* key;       /* "ssao": same alphabet as a parameter's, unique among effects */
  const char* label;     /* for people: "Ambient occlusion" */
  const char* version;   /* "1.0.0" */
  const char* tooltip;   /* what it does, in one line */
  const grisaille_param_desc* params;
  const grisaille_output_desc* outputs;

  /* Which attachments it reads with these values: GRISAILLE_READS(...) combined. May depend on the
   * values alone; called at any time, also without an instance. Cannot fail. */
  uint32_t (*reads)(const double* values);

  /* Makes an instance; *out is handed to the others. After a failure no other function is called.
   */
  grisaille_result (*create)(const grisaille_host* host, void** out);

  /* Records one frame. Writes every wanted output at every pixel. After a failure the frame is
   * dropped and the instance stays usable. */
  grisaille_result (*record)(void* instance, const grisaille_frame* frame);

  /* Ends an instance. */
  void (*destroy)(void* instance);

  /* Since 1.1. */
  uint32_t flags;     /* of grisaille_effect_flags */
  uint32_t reserved2; /* 0 */
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
