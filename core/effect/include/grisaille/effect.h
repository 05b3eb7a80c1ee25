/* SPDX-License-Identifier: MIT */
/**
 * @file
 * The C interface of a Grisaille effect.
 *
 * A plugin is a shared library that exports one constant data symbol, `grisaille_plugin`, of type
 * grisaille_plugin_desc. The host is the program that loads the plugin. The host checks the tables
 * before it calls any function of the plugin. If a table is wrong, the host refuses the plugin and
 * reports the field and the reason. Every table is static constant data of the plugin: it stays
 * valid and unchanged while the library is loaded, and the host never frees it.
 *
 * @par Versions
 * The major number changes when the host cannot run older plugins; a host loads only plugins of its
 * own major number. The minor number grows when fields are appended; a host loads plugins of its
 * own minor number and of older ones. A struct that may grow begins with struct_size, the size of
 * the struct in the version that its writer was built with. A field beyond that size reads as zero.
 * The reader refuses a struct that is longer than in its own version.
 *
 * @par Threads
 * The host calls an effect's functions from one thread at a time, though not always the same one.
 * An effect calls the host's functions only from inside its own functions, on that thread.
 *
 * @par Errors
 * A function that returns grisaille_result returns GRISAILLE_OK or an error. An effect that fails
 * calls grisaille_host::fail with the reason before it returns. No exception may leave a function.
 *
 * @par Units
 * Metres, radians, pixels, seconds. Matrices are column-major, vectors are columns. World axes are
 * right-handed with +y up; view space looks along -z. Clip space has y up, depth 1 at the near
 * plane and 0 at the far plane, or at infinity. Row 0 of every texture is the top row.
 *
 * @par Keys
 * A key names a table entry in files and on the command line. It consists of a-z, 0-9 and _, begins
 * with a letter, and is unique in its table.
 */
#ifndef GRISAILLE_EFFECT_H
#define GRISAILLE_EFFECT_H

#include "grisaille/shader.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup effect_results Effect: versions and results
 * The version of the interface, the export macro, and result codes.
 * @{
 */

#define GRISAILLE_MAGIC 0x53495247u /**< "GRIS", for grisaille_plugin_desc::magic */
#define GRISAILLE_ABI_MAJOR 1u      /**< major number of this interface */
#define GRISAILLE_ABI_MINOR 0u      /**< minor number of this interface */

/** Exports a symbol from a shared library. */
#if defined(_WIN32)
#define GRISAILLE_EXPORT __declspec(dllexport)
#else
#define GRISAILLE_EXPORT __attribute__((visibility("default")))
#endif

/** The result of a call. */
typedef enum grisaille_result {
  GRISAILLE_OK = 0,         /**< the call succeeded */
  GRISAILLE_FAILED = 1,     /**< the call did nothing; the host has recorded why */
  GRISAILLE_UNSUPPORTED = 2 /**< this host does not offer the service */
} grisaille_result;

/**
 * @}
 * @defgroup effect_parameters Effect: parameters
 * The values that users set.
 *
 * The host passes every value as a double: a float or an int unchanged, a bool as 0 or 1, an enum
 * as its index. The program generates the panel, the command line, settings files, sweeps and the
 * documentation from the table.
 * @{
 */

/** The type of a parameter. */
typedef enum grisaille_param_type {
  GRISAILLE_PARAM_FLOAT = 0, /**< a number */
  GRISAILLE_PARAM_INT = 1,   /**< a whole number, up to 2^53 */
  GRISAILLE_PARAM_BOOL = 2,  /**< 0 or 1 */
  GRISAILLE_PARAM_ENUM = 3   /**< an index into grisaille_param_desc::enum_keys */
} grisaille_param_type;

/** What a parameter is for, how the panel shows it, and how the program chooses its value. */
typedef enum grisaille_param_flags {
  /** The slider has a logarithmic scale; soft_min must be over 0. Only for floats and ints. */
  GRISAILLE_PARAM_LOG = 1,
  GRISAILLE_PARAM_ADVANCED = 2, /**< the panel hides it in a folded section */
  /**
   * A length of the scene. The default suits a scene in which ambient occlusion has a radius of
   * 0.5 m, such as a hall. If nobody sets the parameter, the program scales the default to its
   * scene. Only for floats with the unit m and a default over 0; hosts of libgrisaille get the
   * default.
   */
  GRISAILLE_PARAM_SCENE_LENGTH = 4,
  /** A matter of taste, such as an intensity: a search for accuracy leaves it alone. */
  GRISAILLE_PARAM_LOOK = 8
} grisaille_param_flags;

/** One parameter. All numbers are finite; the numbers of an int are whole. */
typedef struct grisaille_param_desc {
  uint32_t struct_size; /**< sizeof(grisaille_param_desc) */
  uint32_t type;        /**< a grisaille_param_type */
  uint32_t flags;       /**< grisaille_param_flags combined, or 0 */
  uint32_t enum_count;  /**< enum: number of entries, 2 to 64; other types: 0 */
  const char* key;      /**< a-z, 0-9, _; begins with a letter; unique in the effect */
  const char* label;    /**< name shown to users: "Kernel size" */
  const char* unit;     /**< "m", "px", "rad", "s", "MB", or "" */
  const char* tooltip;  /**< one sentence, without a line break */
  double hard_min;      /**< least value that the host accepts; bool and enum: 0 */
  double hard_max;      /**< greatest value that the host accepts; bool: 1; enum: enum_count - 1 */
  double soft_min;      /**< where the slider begins, at least hard_min */
  double soft_max;      /**< where the slider ends, over soft_min, at most hard_max */
  double default_value; /**< from hard_min to hard_max */
  double step;          /**< step of the slider, over 0; 0 only with #GRISAILLE_PARAM_LOG */
  const char* const* enum_keys;   /**< enum: keys for files, command line: a-z, 0-9, _, -; unique */
  const char* const* enum_labels; /**< enum: names shown to users, one per key */
  /** Key of an enum or bool of the same effect: hosts show that this parameter does nothing unless
   * that one has the value `used_when_value`. Null: this parameter is always used. */
  const char* used_when_key;
  uint32_t used_when_value; /**< index of the enum's entry, or 0 or 1 for a bool; no key: 0 */
} grisaille_param_desc;

/**
 * @}
 * @defgroup effect_pictures Effect: attachments and outputs
 * The textures that an effect reads and writes.
 * @{
 */

/** The G-buffer attachments. The host draws an attachment only when an active effect reads it. */
typedef enum grisaille_attachment {
  /** d32f: clip depth; 1 at the near plane, 0 in the sky. viewDepthOf() of view.glsl converts it.
   */
  GRISAILLE_DEPTH = 0,
  GRISAILLE_VIEW_DEPTH = 1,  /**< r32f: distance along the view direction, metres; sky: 0 */
  GRISAILLE_NORMAL = 2,      /**< rgba16f: unit world normal, facing the camera, in xyz; sky: 0 */
  GRISAILLE_BASE_COLOUR = 3, /**< rgba8 sRGB, read as linear: base colour; sky: 0 */
  /** rgba16f: unit world normal of the triangle, facing the camera, in xyz; sky: 0 */
  GRISAILLE_FACET_NORMAL = 4,
  /**
   * r32f: view depth, metres, of the nearest surface at or behind the visible one that faces away
   * or is two-sided. The visible body ends there. 0 where no such surface exists, and for the sky.
   */
  GRISAILLE_BACK_DEPTH = 5,
  /**
   * rgba16f: the motion of the visible surface since the previous frame, of camera and object.
   * - xy: the surface's place in the previous frame minus its place now, pixels of this frame's
   *   size, x to the right, y down.
   * - z: (its view depth then - its view depth now) / its view depth now.
   * - w: 2 where the surface moves in the world, 1 where it rests; 0 in the sky and where the
   * motion is unknown, and xyz are 0 too. It is unknown in the first frame, where the surface lay
   * behind the camera, and everywhere if something moved while an effect that reads it did not run.
   *
   * A host without motion leaves the texture's id at 0, although the effect reads it.
   */
  GRISAILLE_MOTION = 6,
  /**
   * r32f: how thick the matter behind the visible surface is on average, metres: the
   * mean chord of a body, 4 times its volume over its surface; 0 for sheets and the sky; below 0
   * where it is unknown. It takes no pass of its own: the host draws it with the normals.
   *
   * A host without it leaves the texture's id at 0, although the effect reads it.
   */
  GRISAILLE_THICKNESS = 7,
  /**
   * r32f: view depth, metres, of the nearest surface behind the one of GRISAILLE_BACK_DEPTH that
   * faces the camera or is two-sided. 0 where no such surface exists, and where that depth is 0.
   *
   * A host without it leaves the texture's id at 0, although the effect reads it.
   */
  GRISAILLE_NEXT_DEPTH = 8,
  /**
   * rgba16f: the lit colour of the picture so far, linear light with straight alpha: what the
   * effects before this one in the chain make of it. The sky has the colour of the background.
   * - The program `grisaille` has no lights: its colour is white or the base colour, with the
   *   overlays of those effects, times their visibilities or tints.
   * - A host of libgrisaille passes the colour that its renderer has lit.
   *
   * It has no guard band: sample it with coordinates of the picture. A host needs it for an effect
   * that reads it.
   */
  GRISAILLE_COLOUR = 9,
  GRISAILLE_ATTACHMENT_COUNT = 10 /**< number of attachments */
} grisaille_attachment;

/** The bit for a grisaille_attachment in the result of grisaille_effect_desc::reads. */
#define GRISAILLE_READS(attachment) (1u << (attachment))

/** The format of a texture. */
typedef enum grisaille_format {
  GRISAILLE_FORMAT_R8 = 1,      /**< one channel, 8-bit unorm */
  GRISAILLE_FORMAT_RGBA8 = 2,   /**< four channels, 8-bit unorm */
  GRISAILLE_FORMAT_R16F = 3,    /**< one channel, 16-bit float */
  GRISAILLE_FORMAT_RGBA16F = 4, /**< four channels, 16-bit float */
  GRISAILLE_FORMAT_R32F = 5,    /**< one channel, 32-bit float */
  GRISAILLE_FORMAT_RG32F = 6,   /**< two channels, 32-bit float */
  GRISAILLE_FORMAT_RGBA32F = 7, /**< four channels, 32-bit float */
  GRISAILLE_FORMAT_R32UI = 8    /**< one channel, 32-bit unsigned integer */
} grisaille_format;

/**
 * How the composed picture uses an output. Overlays are composited first, in the chain's order;
 * then visibilities and tints multiply the result. An effect that reads #GRISAILLE_COLOUR divides
 * the chain: it gets the picture of the effects before it, and the layers of later effects lie on
 * the picture behind it.
 */
typedef enum grisaille_role {
  GRISAILLE_ROLE_NONE = 0, /**< not composed: the user writes it to a file or views it on its own */
  /** The first channel, 0 to 1, multiplies the light; 1 = open. Any format but R32UI. */
  GRISAILLE_ROLE_VISIBILITY = 1,
  /** Linear RGBA with straight alpha, composited over the surface's colour. Four channels. */
  GRISAILLE_ROLE_OVERLAY = 2,
  /**
   * Not composed. Each pixel holds 1 + the index of the object that the overlay shows at that
   * pixel, or 0 for no object. R32UI.
   */
  GRISAILLE_ROLE_OWNER = 3,
  /**
   * The channels rgb, 0 to 1, multiply the light; 1 = open. Where the picture shows base colours, a
   * tint replaces the effect's visibilities. Four channels.
   */
  GRISAILLE_ROLE_TINT = 4,
  /**
   * The colour of the picture, which replaces #GRISAILLE_COLOUR for everything behind the effect in
   * the chain. RGBA16F: linear light with straight alpha. An effect has at most one, and then no
   * other output that is composed.
   */
  GRISAILLE_ROLE_COLOUR = 5
} grisaille_role;

/** Further properties of an input. */
typedef enum grisaille_input_flags {
  /** The effect cannot run without the input; otherwise the texture's id is 0 if it is missing. */
  GRISAILLE_INPUT_REQUIRED = 1
} grisaille_input_flags;

/**
 * A texture that the effect reads by name, beside the attachments.
 * - "ssao.ao": an output of another effect. The program passes it if that effect is on and runs
 *   earlier in the chain.
 * - A name without a dot, such as "reactive": a texture of the host's own, which only hosts of
 *   libgrisaille pass.
 *
 * It has the picture's size and is read as floats, through a sampler.
 */
typedef struct grisaille_input_desc {
  uint32_t struct_size; /**< sizeof(grisaille_input_desc) */
  uint32_t flags;       /**< grisaille_input_flags combined, or 0 */
  const char* key;      /**< a key, or two keys with a dot between them; unique in the effect */
  const char* tooltip;  /**< one line: what the channels mean, with units and range */
} grisaille_input_desc;

/** One output. */
typedef struct grisaille_output_desc {
  uint32_t struct_size; /**< sizeof(grisaille_output_desc) */
  uint32_t format;      /**< a grisaille_format */
  uint32_t role;        /**< a grisaille_role */
  const char* key;      /**< a key, for `--write KEY=FILE`; unique in the effect */
  const char* tooltip;  /**< one line: what the channels mean, with units and range */
} grisaille_output_desc;

/**
 * @}
 * @defgroup effect_resources Effect: resources
 * Textures, buffers, samplers, pipelines, and the dispatches that use them.
 * @{
 */

/** A texture of the host. */
typedef struct grisaille_texture {
  uint32_t id; /**< 0: none */
} grisaille_texture;
/** A buffer of the host. */
typedef struct grisaille_buffer {
  uint32_t id; /**< 0: none */
} grisaille_buffer;
/** A sampler of the host. */
typedef struct grisaille_sampler {
  uint32_t id; /**< 0: none */
} grisaille_sampler;
/** A compute pipeline of the host. */
typedef struct grisaille_pipeline {
  uint32_t id; /**< 0: none */
} grisaille_pipeline;

/** A part of a buffer. */
typedef struct grisaille_range {
  grisaille_buffer buffer; /**< the buffer */
  uint32_t reserved;       /**< 0 */
  uint64_t offset;         /**< bytes from the start of the buffer */
  uint64_t size;           /**< bytes; 0: to the buffer's end */
} grisaille_range;

/** The value of a specialization constant. */
typedef struct grisaille_constant {
  uint32_t id;   /**< constant_id in the shader */
  uint32_t bits; /**< the bits of a uint, int or float; a bool is 0 or 1 */
} grisaille_constant;

/** Describes a compute pipeline. */
typedef struct grisaille_pipeline_desc {
  uint32_t struct_size;                /**< sizeof(grisaille_pipeline_desc) */
  uint32_t constant_count;             /**< number of `constants` */
  const char* label;                   /**< for messages and debuggers; may be null */
  const grisaille_shader* shader;      /**< a compute shader; valid while the pipeline lives */
  const grisaille_constant* constants; /**< null: the shader's defaults */
} grisaille_pipeline_desc;

/** How shaders use a texture. */
typedef enum grisaille_texture_usage {
  GRISAILLE_TEXTURE_SAMPLED = 1, /**< through a sampler */
  GRISAILLE_TEXTURE_STORAGE = 2  /**< as an image */
} grisaille_texture_usage;

/** Describes a 2D texture. */
typedef struct grisaille_texture_desc {
  uint32_t struct_size; /**< sizeof(grisaille_texture_desc) */
  uint32_t format;      /**< a grisaille_format */
  uint32_t usage;       /**< grisaille_texture_usage combined */
  uint32_t width;       /**< texels, 1 to the device's limit */
  uint32_t height;      /**< texels, 1 to the device's limit */
  uint32_t mips;        /**< number of levels; 0 counts as 1 */
  uint32_t layers;      /**< number of layers; 0 counts as 1; over 1: an array in shaders */
  const char* label;    /**< for messages and debuggers; may be null */
} grisaille_texture_desc;

/** Describes a storage buffer. */
typedef struct grisaille_buffer_desc {
  uint32_t struct_size; /**< sizeof(grisaille_buffer_desc) */
  uint32_t reserved;    /**< 0 */
  uint64_t bytes;       /**< size, 1 to the device's limit */
  const char* label;    /**< for messages and debuggers; may be null */
} grisaille_buffer_desc;

/** Describes a sampler. */
typedef struct grisaille_sampler_desc {
  uint32_t struct_size; /**< sizeof(grisaille_sampler_desc) */
  uint32_t linear;      /**< 1: bilinear within a level; 0: nearest */
  uint32_t linear_mip;  /**< 1: linear between levels; 0: nearest */
  uint32_t repeat;      /**< 1: repeat; 0: clamp to the edge */
  const char* label;    /**< for messages and debuggers; may be null */
} grisaille_sampler_desc;

/** One slot of a dispatch. The host ignores fields that the slot's class does not use. */
typedef struct grisaille_binding {
  uint32_t slot_class;       /**< a grisaille_slot_class */
  uint32_t slot;             /**< 0 to 15 within the class */
  grisaille_range range;     /**< uniform, storage: part of a buffer */
  grisaille_texture texture; /**< texture, image */
  grisaille_sampler sampler; /**< texture */
  uint32_t mip;              /**< texture: the first level; image: the only one */
  uint32_t mip_count;        /**< texture: number of levels; 0: all from `mip` on */
} grisaille_binding;

/** One dispatch of a compute pipeline. */
typedef struct grisaille_dispatch {
  uint32_t struct_size;              /**< sizeof(grisaille_dispatch) */
  grisaille_pipeline pipeline;       /**< a pipeline of the instance */
  const grisaille_binding* bindings; /**< one per slot that the shader uses */
  uint32_t binding_count;            /**< number of `bindings` */
  uint32_t groups[3];                /**< workgroups on each axis, 1 to the device's limit */
} grisaille_dispatch;

/**
 * @}
 * @defgroup effect_objects Effect: objects
 * A list of objects that users make: decals, probes, brush strokes.
 *
 * An effect may declare one list of objects. Its table says which fields an object has and how a
 * user places an object. From the table, the program generates the list and its files, the options
 * --add, --load and --save, the panel's list and tools, and undo.
 * @{
 */

/** The type of a field, and its type in the object's struct. */
typedef enum grisaille_field_type {
  GRISAILLE_FIELD_NUMBER = 0,    /**< double, from min to max */
  GRISAILLE_FIELD_COLOUR = 1,    /**< float[3]: linear red, green, blue, each 0 to 1 */
  GRISAILLE_FIELD_POINT = 2,     /**< double[3]: world, metres, each from -1e9 to 1e9 */
  GRISAILLE_FIELD_DIRECTION = 3, /**< float[3]: world, unit length */
  GRISAILLE_FIELD_TEXT = 4, /**< const char*: one line of UTF-8, at most 4096 bytes; not null */
  GRISAILLE_FIELD_FILE = 5  /**< const char*: a path, with the limits of a text; "": no file */
} grisaille_field_type;

/** Further properties of a field. */
typedef enum grisaille_field_flags {
  /** Every object in a file must have the field; only the panel uses the default. */
  GRISAILLE_FIELD_REQUIRED = 1
} grisaille_field_flags;

/** One field of an object. */
typedef struct grisaille_field_desc {
  uint32_t struct_size; /**< sizeof(grisaille_field_desc) */
  uint32_t type;        /**< a grisaille_field_type */
  uint32_t flags;       /**< grisaille_field_flags combined, or 0 */
  uint32_t offset;      /**< bytes from the start of the object, a multiple of the element's size */
  const char* key;      /**< a key, for files and the command line; unique in the object */
  const char* label;    /**< name shown to users */
  const char* unit;     /**< number: see grisaille_param_desc::unit; other types: "" */
  const char* tooltip;  /**< one line */
  double min;           /**< number: least value, finite; other types: 0 */
  double max;           /**< number: greatest value, finite, over min; other types: 0 */
  double default_value[3];  /**< a number uses the first; text and file: 0 */
  const char* default_text; /**< text, file: the default, not null; other types: null */
} grisaille_field_desc;

/** How a click sets the point and the direction of an object that the user places. */
typedef enum grisaille_placement {
  /** The point is the camera's position; the direction goes through the pixel. */
  GRISAILLE_PLACE_RAY = 0,
  /**
   * The point lies on the visible surface; the direction is the facet normal, facing the camera. A
   * click on the sky places nothing.
   */
  GRISAILLE_PLACE_SURFACE = 1
} grisaille_placement;

/** The objects of an effect. */
typedef struct grisaille_object_desc {
  uint32_t struct_size;               /**< sizeof(grisaille_object_desc) */
  uint32_t object_size;               /**< bytes of one object, a multiple of 8, at most 4096 */
  uint32_t field_count;               /**< 1 to 64 */
  uint32_t placement;                 /**< a grisaille_placement */
  uint32_t point_field;               /**< index of the point field that a click sets */
  uint32_t direction_field;           /**< index of the direction field that a click sets */
  const char* key;                    /**< key of the list in files: "decals"; not "version" */
  const char* label;                  /**< name of the list, shown to users: "Decals" */
  const char* tooltip;                /**< one line: what one object is */
  const grisaille_field_desc* fields; /**< `field_count` of them */
} grisaille_object_desc;

/** The list in one frame, valid during grisaille_effect_desc::record. */
typedef struct grisaille_objects {
  uint32_t struct_size; /**< sizeof(grisaille_objects) */
  uint32_t stride;     /**< bytes from one object to the next: grisaille_object_desc::object_size */
  const void* objects; /**< oldest first */
  uint64_t count;      /**< number of objects */
  /** Leading objects unchanged since the last frame that this instance recorded without error, or
   * since the last points if these came later. */
  uint64_t kept;
} grisaille_objects;

/**
 * @}
 * @defgroup effect_points Effect: points of surfaces
 * What an effect draws on the scene's surfaces, whether or not a camera sees them.
 * @{
 */

/** A point of a surface, on one of its sides. */
typedef struct grisaille_point {
  double position[3]; /**< world, metres, each from -1e9 to 1e9 */
  float normal[3];    /**< of the triangle, towards that side: world, unit length */
  uint32_t reserved;  /**< 0 */
} grisaille_point;

/** What an effect draws at a point. */
typedef struct grisaille_drawn {
  float colour[3]; /**< linear, each 0 to 1; 0 where `alpha` is 0 */
  float alpha;     /**< straight alpha, 0 to 1 */
  uint64_t owner;  /**< 1 + index of the object that shows; 0 where `alpha` is 0 */
} grisaille_drawn;

/** Points, valid during grisaille_effect_desc::draw_at. */
typedef struct grisaille_points {
  uint32_t struct_size;          /**< size of this struct in the host's version */
  uint32_t reserved;             /**< 0 */
  uint64_t count;                /**< number of points */
  const grisaille_point* points; /**< `count` of them; neighbours lie close together */
  grisaille_drawn* drawn;        /**< one result per point, preset to 0 */
  const double* values;          /**< see grisaille_frame::values */
  /** Null unless the effect's table declares objects; `kept` counts since the last frame, or the
   * last points, whichever was later. */
  const grisaille_objects* objects;
} grisaille_points;

/**
 * @}
 * @defgroup effect_rays Effect: rays and pictures
 * Ray casts through the scene, and decoded picture files.
 * @{
 */

/** A ray through the scene. */
typedef struct grisaille_ray {
  double origin[3];   /**< world, metres, finite */
  float direction[3]; /**< world, unit length */
  float reach;        /**< metres, over 0; may be infinite */
} grisaille_ray;

/** Whether a ray hit something. */
typedef enum grisaille_hit_kind {
  GRISAILLE_HIT_NONE = 0, /**< nothing within reach */
  /**
   * The first surface that is drawn. Rays pass through the holes of a cut-out material, and through
   * backs that the host does not draw.
   */
  GRISAILLE_HIT_SURFACE = 1,
  GRISAILLE_HIT_UNKNOWN = 2 /**< the host does not know yet; it may know in a later frame */
} grisaille_hit_kind;

/** The result of one ray. */
typedef struct grisaille_hit {
  uint32_t kind; /**< a grisaille_hit_kind; unless #GRISAILLE_HIT_SURFACE, the other fields are 0 */
  float distance;  /**< metres along the ray */
  float normal[3]; /**< the triangle's normal: world, unit length, towards the ray's origin */
} grisaille_hit;

/** A square depth picture, in perspective, as one draws a shadow map. */
typedef struct grisaille_depth_view {
  double origin[3];   /**< world, metres, finite */
  float direction[3]; /**< towards the middle of the picture; world, unit length */
  float up[3];        /**< upwards in the picture; world, unit length, normal to `direction` */
  float slope;        /**< half the picture's width and height at a distance of 1; over 0 */
  uint32_t size;      /**< width and height, pixels, 1 ... 4096 */
} grisaille_depth_view;

/** A picture that the host has decoded. */
typedef struct grisaille_picture {
  uint32_t struct_size; /**< sizeof(grisaille_picture), set by the caller */
  uint32_t width;       /**< pixels, over 0 */
  uint32_t height;      /**< pixels, over 0 */
  uint32_t reserved;    /**< 0 */
  /**
   * sRGB with straight alpha, 4 bytes per pixel, top row first. Valid until the instance calls
   * grisaille_host::read_picture again or the effect's function returns.
   */
  const uint8_t* rgba;
} grisaille_picture;

/**
 * @}
 * @defgroup effect_host Effect: services of the host
 * The functions that the host offers to one instance of an effect.
 * @{
 */

/**
 * The host's services for one instance.
 *
 * The table is valid from create() to destroy() of the instance, and the effect never frees it.
 * Resources belong to the instance, which destroys them; the host destroys the remaining resources
 * after grisaille_effect_desc::destroy. The host reads arguments during the call and keeps no
 * pointer to them.
 */
typedef struct grisaille_host {
  uint32_t struct_size; /**< size of this table in the host's version */
  uint32_t abi_minor;   /**< minor number of the host's interface */
  void* context;        /**< for the host's use only */

  /**
   * Reports why the effect is about to return #GRISAILLE_FAILED.
   * @param self this table
   * @param why one line; the host copies it
   */
  void (*fail)(const struct grisaille_host* self, const char* why);

  /**
   * Creates a compute pipeline. Call the functions that create resources only inside create() and
   * record().
   * @param self this table
   * @param desc describes the pipeline
   * @param[out] out the pipeline
   * @retval GRISAILLE_FAILED The description is wrong, the shader is not a compute shader, the
   *   driver refuses the shader, or memory is exhausted.
   */
  grisaille_result (*create_pipeline)(const struct grisaille_host* self,
                                      const grisaille_pipeline_desc* desc, grisaille_pipeline* out);
  /**
   * Creates a texture. Its contents are undefined.
   * @param self this table
   * @param desc describes the texture
   * @param[out] out the texture
   * @retval GRISAILLE_FAILED The description is wrong, the device does not support the size or the
   *   usage, or memory is exhausted.
   */
  grisaille_result (*create_texture)(const struct grisaille_host* self,
                                     const grisaille_texture_desc* desc, grisaille_texture* out);
  /**
   * Creates a storage buffer. Its contents are undefined.
   * @param self this table
   * @param desc describes the buffer
   * @param[out] out the buffer
   * @retval GRISAILLE_FAILED The description is wrong, the device does not support the size, or
   *   memory is exhausted.
   */
  grisaille_result (*create_buffer)(const struct grisaille_host* self,
                                    const grisaille_buffer_desc* desc, grisaille_buffer* out);
  /**
   * Creates a sampler.
   * @param self this table
   * @param desc describes the sampler
   * @param[out] out the sampler
   * @retval GRISAILLE_FAILED The description is wrong, or memory is exhausted.
   */
  grisaille_result (*create_sampler)(const struct grisaille_host* self,
                                     const grisaille_sampler_desc* desc, grisaille_sampler* out);
  /**
   * Destroys a pipeline of the instance. Call it inside any function of the effect. The host frees
   * the memory once no frame in flight uses it. If the pipeline belongs to another instance, the
   * effect's running function fails.
   * @param self this table
   * @param pipeline a pipeline of the instance; id 0: the call does nothing
   */
  void (*destroy_pipeline)(const struct grisaille_host* self, grisaille_pipeline pipeline);
  /**
   * Destroys a texture. The rules of grisaille_host::destroy_pipeline apply.
   * @param self this table
   * @param texture a texture of the instance; id 0: the call does nothing
   */
  void (*destroy_texture)(const struct grisaille_host* self, grisaille_texture texture);
  /**
   * Destroys a buffer. The rules of grisaille_host::destroy_pipeline apply.
   * @param self this table
   * @param buffer a buffer of the instance; id 0: the call does nothing
   */
  void (*destroy_buffer)(const struct grisaille_host* self, grisaille_buffer buffer);
  /**
   * Destroys a sampler. The rules of grisaille_host::destroy_pipeline apply.
   * @param self this table
   * @param sampler a sampler of the instance; id 0: the call does nothing
   */
  void (*destroy_sampler)(const struct grisaille_host* self, grisaille_sampler sampler);

  /**
   * Casts rays through the scene. Call it only inside record() and draw_at().
   * @param self this table
   * @param rays `count` rays
   * @param count number of rays
   * @param[out] hits `count` hits, one per ray
   * @retval GRISAILLE_UNSUPPORTED The host does not cast rays.
   * @retval GRISAILLE_FAILED A ray is outside the limits of grisaille_ray.
   */
  grisaille_result (*cast_rays)(const struct grisaille_host* self, const grisaille_ray* rays,
                                uint64_t count, grisaille_hit* hits);
  /**
   * Draws the first surface that a point sees in each direction. Call it only inside record().
   * @param self this table
   * @param view origin, direction and size of the picture
   * @param[out] depth `size` x `size` values, by rows from the top, for the pixels' centres: the
   *   distance of the first surface along the view's direction, metres; infinity: no surface; NaN:
   *   the host does not know yet, and may know in a later frame
   * @retval GRISAILLE_UNSUPPORTED The host does not draw depth pictures.
   * @retval GRISAILLE_FAILED The view is outside the limits of grisaille_depth_view.
   */
  grisaille_result (*draw_depth)(const struct grisaille_host* self,
                                 const grisaille_depth_view* view, float* depth);
  /**
   * Decodes a picture file, such as the value of a #GRISAILLE_FIELD_FILE. Call it only inside
   * record().
   * @param self this table
   * @param path path of the file
   * @param[out] out the picture; set its `struct_size` before the call
   * @retval GRISAILLE_UNSUPPORTED The host does not decode pictures.
   * @retval GRISAILLE_FAILED The host cannot read the file; it warns the user once. The effect may
   *   continue without the picture.
   */
  grisaille_result (*read_picture)(const struct grisaille_host* self, const char* path,
                                   grisaille_picture* out);
} grisaille_host;

/**
 * @}
 * @defgroup effect_frame Effect: a frame
 * The inputs, outputs and functions with which an effect records one frame.
 * @{
 */

/**
 * The camera of a frame, in double precision. Shaders read the same camera in single precision from
 * the uniform block of shaders/common/view.glsl.
 */
typedef struct grisaille_view {
  uint32_t struct_size;      /**< sizeof(grisaille_view) */
  uint32_t orthographic;     /**< 1: orthographic; 0: perspective */
  double position[3];        /**< world, metres */
  double world_from_view[9]; /**< rotation, column-major 3x3 */
  /**
   * View-space x and y of the surface that a pixel shows: pixel * [0, 1] + [2, 3], metres.
   * Perspective: times the view depth. The view axis may pass anywhere through the picture, and
   * pixels may have any aspect ratio. [1] is below 0, because row 0 is the top row.
   */
  double view_from_pixel[4];
  double near_plane; /**< metres */
  double far_plane;  /**< metres; perspective: 0, which means none */
  /**
   * Pixels, x to the right, y down: by how much the camera of this frame shifts the picture for
   * temporal antialiasing, each at most 1. The camera above includes the shift, and
   * GRISAILLE_MOTION the difference between two frames' shifts. 0 without jitter.
   */
  double jitter[2];
} grisaille_view;

/** One frame of one effect, valid during grisaille_effect_desc::record. */
typedef struct grisaille_frame {
  uint32_t struct_size; /**< size of this table in the host's version */
  uint32_t width;       /**< pixels of every output, and of every attachment without guard band */
  uint32_t height;      /**< pixels; see `width` */
  uint32_t wanted;      /**< bit n: output n is in use; an unused output has id 0 */
  uint64_t index;       /**< number of the frame, counted from 0 for each instance */
  void* context;        /**< for the host's use only */
  const double* values; /**< one per parameter, in the table's order, inside its hard range */
  const grisaille_view* view;           /**< the camera */
  grisaille_range view_block;           /**< uniform buffer for shaders/common/view.glsl */
  const grisaille_texture* attachments; /**< by grisaille_attachment; id 0: not named by reads(), or
                                           an attachment that the host lacks */
  const grisaille_texture* outputs;     /**< one per output, in the table's order */

  /**
   * Begins a pass: a named, timed group of commands. Passes do not nest. Record commands only
   * inside a pass. Call the functions of the frame only inside record().
   * @param self this frame
   * @param label names the pass; the host copies it
   * @retval GRISAILLE_FAILED The label is empty, or another pass is open.
   */
  grisaille_result (*begin_pass)(const struct grisaille_frame* self, const char* label);
  /**
   * Ends the pass.
   * @param self this frame
   * @retval GRISAILLE_FAILED No pass is open.
   */
  grisaille_result (*end_pass)(const struct grisaille_frame* self);
  /**
   * Records a dispatch, which sees the results of all commands recorded before it. It may read
   * attachments but not write them.
   * @param self this frame
   * @param work the dispatch; the host reads it during the call
   * @retval GRISAILLE_FAILED No pass is open, a slot of the shader has no binding, or a bound
   *   resource belongs neither to the instance nor to the frame.
   */
  grisaille_result (*dispatch)(const struct grisaille_frame* self, const grisaille_dispatch* work);
  /**
   * Copies bytes into a uniform buffer for this frame.
   * @param self this frame
   * @param data the bytes
   * @param bytes number of bytes in `data`, 1 to 65536
   * @param[out] out the part of a buffer that holds the copy
   * @retval GRISAILLE_FAILED `bytes` is out of range, or memory is exhausted.
   */
  grisaille_result (*uniform)(const struct grisaille_frame* self, const void* data, uint32_t bytes,
                              grisaille_range* out);
  /**
   * Creates a texture for this frame only. Its contents are undefined. The host owns and destroys
   * it.
   * @param self this frame
   * @param desc describes the texture
   * @param[out] out the texture
   * @retval GRISAILLE_FAILED See grisaille_host::create_texture.
   */
  grisaille_result (*transient)(const struct grisaille_frame* self,
                                const grisaille_texture_desc* desc, grisaille_texture* out);
  /**
   * Copies bytes into a buffer of the instance.
   * @param self this frame
   * @param buffer the buffer
   * @param offset bytes from the start of the buffer
   * @param data the bytes
   * @param bytes number of bytes in `data`; the range must lie inside the buffer
   * @retval GRISAILLE_FAILED The buffer belongs to another instance, the range is not inside the
   *   buffer, or memory is exhausted.
   */
  grisaille_result (*upload_buffer)(const struct grisaille_frame* self, grisaille_buffer buffer,
                                    uint64_t offset, const void* data, uint64_t bytes);
  /**
   * Copies texels into one whole mip level of one layer.
   * @param self this frame
   * @param texture a texture of the instance or of the frame, but not an attachment
   * @param mip the level
   * @param layer the layer
   * @param data rows, tightly packed, top row first
   * @param bytes number of bytes in `data`
   * @retval GRISAILLE_FAILED The texture is an attachment or belongs to another instance,
   *   `bytes` is not the size of the level, or memory is exhausted.
   */
  grisaille_result (*upload_texture)(const struct grisaille_frame* self, grisaille_texture texture,
                                     uint32_t mip, uint32_t layer, const void* data,
                                     uint64_t bytes);

  const grisaille_objects* objects; /**< null unless the effect's table declares objects */
  /** Seconds that the effect may spend in this frame on work that can wait; may be infinite. */
  double patience;
  /**
   * Reports how many pieces of work wait for a later frame. The host then renders again soon.
   * @param self this frame
   * @param count number of waiting pieces; 0 (the value without a call): the picture is complete
   */
  grisaille_result (*waiting)(const struct grisaille_frame* self, uint64_t count);
  /**
   * Reports how many objects the effect gave up: a limit that its user chose, of memory say, leaves
   * no room for them. The host tells the user.
   * @param self this frame
   * @param count number of leading objects of the list that have no effect in any frame until the
   *   list or the limit changes; 0 (the value without a call): none
   */
  grisaille_result (*given_up)(const struct grisaille_frame* self, uint64_t count);

  /**
   * The guard band: the number of pixels by which every attachment extends beyond the picture on
   * each side. It is at least the width that grisaille_effect_desc::guard_band requests, or 0 if
   * the host has no pixels beyond the picture. attachmentAt() of shaders/common/view.glsl converts
   * a pixel of the picture to texture coordinates in an attachment.
   */
  uint32_t guard;
  uint32_t reserved;               /**< 0 */
  const grisaille_texture* inputs; /**< by index in grisaille_effect_desc::inputs; id 0: missing */
  /**
   * Reports how many objects the effect draws less exactly, because a limit that its user chose, of
   * memory say, is near. The host tells the user.
   * @param self this frame
   * @param count number of these objects; 0 (the value without a call): none
   */
  grisaille_result (*coarser)(const struct grisaille_frame* self, uint64_t count);
} grisaille_frame;

/**
 * @}
 * @defgroup effect_table Effect: the effect and its plugin
 * The tables that a plugin exports.
 * @{
 */

/** Further properties of an effect. */
typedef enum grisaille_effect_flags {
  /** The effect runs when the user names no effects. Only the program's own effects may use it. */
  GRISAILLE_EFFECT_DEFAULT = 1,
  /**
   * The effect keeps a history: what it writes depends on the instance's earlier frames. Without
   * the flag, equal frames must give equal outputs, bit for bit.
   */
  GRISAILLE_EFFECT_HISTORY = 2,
  /**
   * The effect wants a camera that shifts the picture by up to half a pixel, another way in each
   * frame: see grisaille_view::jitter. The program does so while the effect runs; a host of
   * libgrisaille may.
   */
  GRISAILLE_EFFECT_JITTER = 4
} grisaille_effect_flags;

/** One effect. */
typedef struct grisaille_effect_desc {
  uint32_t struct_size;                 /**< sizeof(grisaille_effect_desc) */
  uint32_t param_count;                 /**< 0 to 256 */
  uint32_t output_count;                /**< 1 to 16 */
  uint32_t flags;                       /**< grisaille_effect_flags combined, or 0 */
  const char* key;                      /**< a key: "ssao"; unique among effects */
  const char* label;                    /**< name shown to users: "Ambient occlusion" */
  const char* version;                  /**< "1.0.0" */
  const char* tooltip;                  /**< one line: what the effect does */
  const grisaille_param_desc* params;   /**< `param_count` of them */
  const grisaille_output_desc* outputs; /**< `output_count` of them */

  /**
   * Returns the attachments that the effect reads. The result must depend only on the arguments.
   * The host calls it at any time, even without an instance. It cannot fail.
   * @param values one per parameter, in the table's order
   * @param wanted bit n: output n is in use, same as grisaille_frame::wanted
   * @return GRISAILLE_READS() of each attachment, combined
   */
  uint32_t (*reads)(const double* values, uint32_t wanted);

  /**
   * Creates an instance. If this fails, the host calls no other function for the instance.
   * @param host the services for this instance
   * @param[out] out the instance, which the host passes to the other functions
   * @return GRISAILLE_OK, or GRISAILLE_FAILED after grisaille_host::fail
   */
  grisaille_result (*create)(const grisaille_host* host, void** out);

  /**
   * Records one frame. It writes every wanted output at every pixel. After a failure the host drops
   * the frame, and the instance stays usable.
   * @param instance the instance
   * @param frame the frame
   * @return GRISAILLE_OK, or GRISAILLE_FAILED after grisaille_host::fail
   */
  grisaille_result (*record)(void* instance, const grisaille_frame* frame);

  /**
   * Destroys an instance.
   * @param instance the instance
   */
  void (*destroy)(void* instance);

  /**
   * Returns the width of the guard band that the effect wants. Null means no guard band. The host
   * draws separate attachments of the picture's size for effects without a guard band.
   * @param values one per parameter, in the table's order
   * @return width of the band on each side, as a fraction of the picture's height, 0 to 1
   */
  double (*guard_band)(const double* values);

  const grisaille_object_desc* objects; /**< the objects that users make; null: no objects */

  /**
   * Computes on the CPU what the effect's overlay shows at points of surfaces, whether or not a
   * camera sees them. Null: the effect cannot tell. It leaves out objects that wait or are given
   * up, as record() does, and places none of them: hosts record frames first. Call only
   * grisaille_host::fail and grisaille_host::cast_rays inside it.
   * @param instance the instance
   * @param points the points; the effect writes `drawn`
   * @return GRISAILLE_OK, or GRISAILLE_FAILED after grisaille_host::fail
   */
  grisaille_result (*draw_at)(void* instance, const grisaille_points* points);

  /**
   * GRISAILLE_READS() of the attachments without which the effect cannot run although a host may
   * lack them, such as #GRISAILLE_MOTION, combined. The host then reports their names and does not
   * run the effect. 0: the effect copes with an id of 0.
   */
  uint32_t needs;
  uint32_t input_count;               /**< 0 to 16 */
  const grisaille_input_desc* inputs; /**< textures read by name; `input_count` of them */
} grisaille_effect_desc;

/** The table that a plugin exports. */
typedef struct grisaille_plugin_desc {
  uint32_t magic;                              /**< GRISAILLE_MAGIC */
  uint32_t abi_major;                          /**< GRISAILLE_ABI_MAJOR */
  uint32_t abi_minor;                          /**< GRISAILLE_ABI_MINOR */
  uint32_t struct_size;                        /**< sizeof(grisaille_plugin_desc) */
  uint32_t effect_count;                       /**< 1 to 64 */
  uint32_t reserved;                           /**< 0 */
  const grisaille_effect_desc* const* effects; /**< `effect_count` of them */
} grisaille_plugin_desc;

/** The name of the symbol that a plugin exports. */
#define GRISAILLE_PLUGIN_SYMBOL "grisaille_plugin"

/** @} */

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_EFFECT_H */
