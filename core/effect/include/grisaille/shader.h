/* SPDX-License-Identifier: MIT */
/**
 * @file
 * One compiled shader stage, as the CMake function `grisaille_add_shader` writes it.
 *
 * A grisaille_shader holds the SPIR-V that Vulkan takes, the GLSL 4.50 that OpenGL takes, and the
 * shader's interface. All of it is static constant data of the plugin, and nobody frees it.
 *
 * @par Binding numbers
 * In the source, every binding belongs to set 0 and to one of four classes. Declare bindings with
 * the macros of shaders/common/bindings.glsl: UNIFORM(n), STORAGE(n), TEXTURE(n), IMAGE(n), with n
 * from 0 to 15. In SPIR-V, slot n of a class is binding `GRISAILLE_SLOTS_PER_CLASS * class + n`. In
 * GLSL it is binding n, because OpenGL numbers the bindings of each class separately.
 */
#ifndef GRISAILLE_SHADER_H
#define GRISAILLE_SHADER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/**
 * @defgroup effect_shaders Effect: shaders
 * Compiled shaders and the resources that they read and write (shader.h).
 * @{
 */

/** Number of slots in each grisaille_slot_class. */
#define GRISAILLE_SLOTS_PER_CLASS 16u

/** The stage of a shader. */
typedef enum grisaille_stage {
  GRISAILLE_STAGE_VERTEX = 0,   /**< vertex shader */
  GRISAILLE_STAGE_FRAGMENT = 1, /**< fragment shader */
  GRISAILLE_STAGE_COMPUTE = 2   /**< compute shader, the only stage that effects use */
} grisaille_stage;

/** The class of a binding. Each class numbers its slots from 0. */
typedef enum grisaille_slot_class {
  GRISAILLE_SLOT_UNIFORM = 0, /**< uniform buffer, std140 */
  GRISAILLE_SLOT_STORAGE = 1, /**< storage buffer, std430 */
  GRISAILLE_SLOT_TEXTURE = 2, /**< texture with its sampler */
  GRISAILLE_SLOT_IMAGE = 3    /**< one mip level, read and written by texel */
} grisaille_slot_class;

/** The scalar type of a constant or of a location's components. */
typedef enum grisaille_scalar {
  GRISAILLE_SCALAR_UINT = 0,  /**< 32-bit unsigned integer */
  GRISAILLE_SCALAR_INT = 1,   /**< 32-bit signed integer */
  GRISAILLE_SCALAR_FLOAT = 2, /**< 32-bit float */
  GRISAILLE_SCALAR_BOOL = 3   /**< bool, stored as 0 or 1 */
} grisaille_scalar;

/** One slot that the shader uses. Arrays of resources are not supported. */
typedef struct grisaille_shader_slot {
  uint32_t slot_class; /**< a grisaille_slot_class */
  uint32_t slot;       /**< 0 to 15 within the class */
  uint32_t reads;      /**< 1 if the shader may read it, else 0 */
  uint32_t writes;     /**< 1 if the shader may write it, else 0 */
  uint32_t block_size; /**< bytes of a uniform block or of a storage block's fixed part; else 0 */
  uint32_t arrayed;    /**< 1: a 2D array texture or image; else 0 */
  const char* format;  /**< image format as GLSL spells it ("r32f"); "" for other classes */
  const char* name;    /**< name in the source, for messages */
} grisaille_shader_slot;

/** A specialization constant that the shader declares. */
typedef struct grisaille_shader_constant {
  uint32_t id;           /**< constant_id in the source */
  uint32_t type;         /**< a grisaille_scalar */
  uint32_t default_bits; /**< the default, as the bits of a uint, int or float; a bool is 0 or 1 */
  const char* name;      /**< name in the source, for messages */
} grisaille_shader_constant;

/** A vertex input or a fragment output: one location. */
typedef struct grisaille_shader_location {
  uint32_t location;   /**< location in the source */
  uint32_t type;       /**< a grisaille_scalar */
  uint32_t components; /**< 1 to 4 */
  const char* name;    /**< name in the source, for messages */
} grisaille_shader_location;

/** A compiled shader with its interface. */
typedef struct grisaille_shader {
  uint32_t struct_size;  /**< sizeof(grisaille_shader) when the shader was built */
  uint32_t stage;        /**< a grisaille_stage */
  const char* name;      /**< file name of the source with its variant, for messages */
  const uint32_t* spirv; /**< SPIR-V 1.6 with the entry point "main" */
  size_t spirv_words;    /**< number of 32-bit words in `spirv` */
  /** GLSL 4.50 core. The macro `SPIRV_CROSS_CONSTANT_ID_<id>` sets a specialization constant. */
  const char* glsl;
  const grisaille_shader_slot* slots;         /**< the slots that the shader uses */
  uint32_t slot_count;                        /**< number of `slots` */
  const grisaille_shader_constant* constants; /**< the specialization constants */
  uint32_t constant_count;                    /**< number of `constants` */
  const grisaille_shader_location* inputs;    /**< vertex stage: attributes; others: null */
  uint32_t input_count;                       /**< number of `inputs` */
  const grisaille_shader_location* outputs;   /**< fragment stage: colour targets; others: null */
  uint32_t output_count;                      /**< number of `outputs` */
  uint32_t local_size[3]; /**< compute stage: threads per workgroup on each axis; other stages: 0 */
} grisaille_shader;

/** @} */

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_SHADER_H */
