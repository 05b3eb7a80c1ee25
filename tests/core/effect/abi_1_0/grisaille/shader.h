/* SPDX-License-Identifier: MIT
 *
 * One compiled shader stage as the build's `grisaille_add_shaders` writes it: the SPIR-V that
 * Vulkan takes, the GLSL 4.50 that OpenGL takes, and what both read and write. Static constant
 * data; a plugin hands out pointers to it, nobody frees it.
 *
 * Binding numbers. In source, all bindings are of set 0 and of one of four classes, written with
 * the macros of shaders/common/bindings.glsl: UNIFORM(n), STORAGE(n), TEXTURE(n), IMAGE(n), n = 0
 * ... 15. In SPIR-V slot n of a class is binding `GRISAILLE_SLOTS_PER_CLASS * class + n`; in GLSL
 * it is n, since OpenGL counts each class by itself.
 */
#ifndef GRISAILLE_SHADER_H
#define GRISAILLE_SHADER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GRISAILLE_SLOTS_PER_CLASS 16u

typedef enum grisaille_stage {
  GRISAILLE_STAGE_VERTEX = 0,
  GRISAILLE_STAGE_FRAGMENT = 1,
  GRISAILLE_STAGE_COMPUTE = 2
} grisaille_stage;

typedef enum grisaille_slot_class {
  GRISAILLE_SLOT_UNIFORM = 0, /* uniform buffer, std140 */
  GRISAILLE_SLOT_STORAGE = 1, /* storage buffer, std430 */
  GRISAILLE_SLOT_TEXTURE = 2, /* texture with its sampler */
  GRISAILLE_SLOT_IMAGE = 3    /* one mip level, read and written by texel */
} grisaille_slot_class;

typedef enum grisaille_scalar {
  GRISAILLE_SCALAR_UINT = 0,
  GRISAILLE_SCALAR_INT = 1,
  GRISAILLE_SCALAR_FLOAT = 2,
  GRISAILLE_SCALAR_BOOL = 3
} grisaille_scalar;

/* One slot that the shader uses. Arrays of resources are not supported. */
typedef struct grisaille_shader_slot {
  uint32_t slot_class; /* grisaille_slot_class */
  uint32_t slot;       /* 0 ... 15 within the class */
  uint32_t reads;      /* 1 when the shader may read it */
  uint32_t writes;     /* 1 when the shader may write it */
  uint32_t block_size; /* bytes of a uniform block, or of a storage block's fixed part; else 0 */
  uint32_t arrayed;    /* 1 for a 2D array texture or image */
  const char* format;  /* image format as GLSL spells it ("r32f"), "" for other classes */
  const char* name;    /* the name in the source, for messages */
} grisaille_shader_slot;

typedef struct grisaille_shader_constant {
  uint32_t id;           /* constant_id */
  uint32_t type;         /* grisaille_scalar */
  uint32_t default_bits; /* the default, as the bits of a uint, int or float; a bool is 0 or 1 */
  const char* name;
} grisaille_shader_constant;

/* A vertex input or a fragment output: one location. */
typedef struct grisaille_shader_location {
  uint32_t location;
  uint32_t type;       /* grisaille_scalar */
  uint32_t components; /* 1 ... 4 */
  const char* name;
} grisaille_shader_location;

typedef struct grisaille_shader {
  uint32_t struct_size;  /* sizeof(grisaille_shader) when it was built */
  uint32_t stage;        /* grisaille_stage */
  const char* name;      /* the source's file name with its variant, for messages */
  const uint32_t* spirv; /* SPIR-V 1.6, entry point "main" */
  size_t spirv_words;
  const char* glsl; /* GLSL 4.50 core; specialization constants are SPIRV_CROSS_CONSTANT_ID_<id> */
  const grisaille_shader_slot* slots;
  uint32_t slot_count;
  const grisaille_shader_constant* constants;
  uint32_t constant_count;
  const grisaille_shader_location* inputs; /* vertex stage: attributes; else none */
  uint32_t input_count;
  const grisaille_shader_location* outputs; /* fragment stage: colour targets; else none */
  uint32_t output_count;
  uint32_t local_size[3]; /* compute stage: threads of a group on each axis; else 0 */
} grisaille_shader;

#ifdef __cplusplus
}
#endif

#endif /* GRISAILLE_SHADER_H */
