# SPDX-License-Identifier: MIT
# grisaille_add_effect(<name> SOURCES <file>... [SHADERS <shader>=<file>...] [DEFINES <NAME[=VALUE]>...]
#                      [PRESETS <file>] [OUTPUT_DIR <folder>])
#
# Builds the plugin <name>.so as the target effect_<name>.
# - It may include the effect interface's headers and its own shaders
#   (`#include "shaders/<shader>.h"`), no other header of the project. Link further libraries with
#   target_link_libraries(effect_<name> PRIVATE ...).
# - It exports only the symbol `grisaille_plugin`, and must link every library that it calls, so
#   that any process can load and unload it.
# - OUTPUT_DIR is by default lib/grisaille/effects of the build folder, where the program looks for
#   effects. Without OUTPUT_DIR, the plugin and its presets are installed to lib/grisaille/effects.

function(grisaille_add_effect name)
  cmake_parse_arguments(ARG "" "OUTPUT_DIR;PRESETS" "SOURCES;SHADERS;DEFINES" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SOURCES)
    message(FATAL_ERROR "grisaille_add_effect(${name}): SOURCES is missing, or these arguments are "
                        "unknown: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  set(target effect_${name})
  add_library(${target} MODULE ${ARG_SOURCES})
  if(NOT ARG_OUTPUT_DIR)
    set(ARG_OUTPUT_DIR ${CMAKE_BINARY_DIR}/lib/grisaille/effects)
    install(TARGETS ${target} LIBRARY DESTINATION lib/grisaille/effects)
    if(ARG_PRESETS)
      install(FILES ${ARG_PRESETS} DESTINATION lib/grisaille/effects RENAME ${name}.presets.toml)
    endif()
  endif()
  # The include folders of the parent directory would make the project's own headers visible.
  set_target_properties(${target} PROPERTIES
    PREFIX "" OUTPUT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY ${ARG_OUTPUT_DIR}
    INCLUDE_DIRECTORIES "" C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${target} PRIVATE Grisaille::abi)
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if(CXX IN_LIST languages)
    target_compile_features(${target} PRIVATE cxx_std_20)
  endif()
  target_compile_definitions(${target} PRIVATE ${ARG_DEFINES})
  # A unique symbol of the standard library's templates would keep the plugin from unloading.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>)
  if(NOT GRISAILLE_SANITIZE)
    # The program defines the sanitizers' functions; they are resolved when the plugin is loaded.
    target_link_options(${target} PRIVATE LINKER:-z,defs)
  endif()
  if(ARG_PRESETS)
    configure_file(${ARG_PRESETS} ${ARG_OUTPUT_DIR}/${name}.presets.toml COPYONLY)
  endif()
  set(watched ${GRISAILLE_SHADER_INCLUDE}/common)
  foreach(shader ${ARG_SHADERS})
    if(NOT shader MATCHES "^([A-Za-z0-9_]+)=(.+)$")
      message(FATAL_ERROR "grisaille_add_effect(${name}): a shader is <name>=<file>, not ${shader}")
    endif()
    grisaille_add_shader(${target} ${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    cmake_path(ABSOLUTE_PATH CMAKE_MATCH_2 NORMALIZE OUTPUT_VARIABLE file)
    cmake_path(GET file PARENT_PATH folder)
    list(APPEND watched ${folder})
  endforeach()
  # For the viewer, which rebuilds the plugin when one of these files changes.
  foreach(source ${ARG_SOURCES})
    cmake_path(ABSOLUTE_PATH source NORMALIZE)
    list(APPEND watched ${source})
  endforeach()
  list(REMOVE_DUPLICATES watched)
  list(JOIN watched "\", \"" watched)
  file(WRITE ${ARG_OUTPUT_DIR}/${name}.build.json
    "{\"build\": \"${CMAKE_BINARY_DIR}\", \"target\": \"${target}\", \"watch\": [\"${watched}\"]}\n")
endfunction()
