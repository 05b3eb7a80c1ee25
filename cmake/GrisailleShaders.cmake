# SPDX-License-Identifier: MIT
# grisaille_add_shader(<target> <name> <source> [DEFINES <NAME[=VALUE]>...])
#
# Compiles one Vulkan GLSL stage (.vert .frag .comp) into <target>. glslc compiles it to SPIR-V 1.6,
# from which the project's shader compiler generates GLSL 4.50 and reflection. The target can use
#   #include "shaders/<name>.h"    extern const grisaille_shader grisaille_shader_<name>;
# For every uniform block of the shader this header has a macro that checks a C++ struct against it:
#   GRISAILLE_CHECK_BLOCK_<name>_<Block>(Struct);
# Sources may include "common/..." (the shared GLSL) and files in their own folder.


function(grisaille_add_shader target name source)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(NOT C IN_LIST languages)
    message(FATAL_ERROR "grisaille_add_shader(${target} ${name}): the language C is not enabled; a "
                        "compiled shader is a C file: add C to project(... LANGUAGES)")
  endif()
  if(NOT GRISAILLE_GLSLC)
    message(FATAL_ERROR "grisaille_add_shader(${target} ${name}): glslc is missing, which compiles "
                        "shaders: install the package glslc")
  endif()
  cmake_parse_arguments(ARG "" "" "DEFINES" ${ARGN})
  cmake_path(ABSOLUTE_PATH source NORMALIZE OUTPUT_VARIABLE source)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_shaders)
  set(stem ${folder}/shaders/${name})
  set(defines ${ARG_DEFINES})
  list(TRANSFORM defines PREPEND -D)
  cmake_path(GET source PARENT_PATH beside)
  file(MAKE_DIRECTORY ${folder}/shaders)
  add_custom_command(
    OUTPUT ${stem}.c ${stem}.h
    COMMAND ${GRISAILLE_GLSLC} --target-env=vulkan1.3 -O -g ${defines}
            -I ${GRISAILLE_SHADER_INCLUDE} -I ${beside} -MD -MF ${stem}.d -MT ${stem}.c
            ${source} -o ${stem}.spv
    COMMAND Grisaille::shader_compiler ${stem}.spv ${name} ${stem}
    DEPENDS ${source} Grisaille::shader_compiler
    DEPFILE ${stem}.d
    COMMENT "Compiling shader ${name}"
    VERBATIM)
  # Each of these files defines `spirv`, `glsl` and other static names: a unity build would clash.
  set_source_files_properties(${stem}.c PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE ${stem}.c ${stem}.h)
  set_property(GLOBAL APPEND PROPERTY GRISAILLE_GENERATED ${stem}.h)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
