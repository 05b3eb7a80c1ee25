# SPDX-License-Identifier: MIT
# grisaille_add_effect(<name> SOURCES <file>... [SHADERS <shader>=<file>...] [DEFINES <NAME[=VALUE]>...]
#                      [PRESETS <file>] [OUTPUT_DIR <folder>])
#
# Builds the plugin <name>.so as the target effect_<name>. It sees the installed effect headers and
# its own shaders (`#include "shaders/<shader>.h"`), nothing else of the project; what more it needs
# is linked with target_link_libraries(effect_<name> PRIVATE ...). Nothing but the symbol
# `grisaille_plugin` leaves it, and all that it calls must be linked, so that it loads and unloads
# anywhere. OUTPUT_DIR is lib/grisaille/effects of the build folder, where the program looks; those
# that go there are installed, to lib/grisaille/effects, with their presets.

function(grisaille_add_effect name)
  cmake_parse_arguments(ARG "" "OUTPUT_DIR;PRESETS" "SOURCES;SHADERS;DEFINES" ${ARGN})
  if(ARG_UNPARSED_ARGUMENTS OR NOT ARG_SOURCES)
    message(FATAL_ERROR "grisaille_add_effect(${name}): give SOURCES; unknown: ${ARG_UNPARSED_ARGUMENTS}")
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
  # Folders included by the directory above would let the project's own headers in.
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
    # The sanitizers' functions are the program's, found when the plugin is loaded.
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
  # For the viewer, which builds the plugin anew when one of these changes.
  foreach(source ${ARG_SOURCES})
    cmake_path(ABSOLUTE_PATH source NORMALIZE)
    list(APPEND watched ${source})
  endforeach()
  list(REMOVE_DUPLICATES watched)
  list(JOIN watched "\", \"" watched)
  file(WRITE ${ARG_OUTPUT_DIR}/${name}.build.json
    "{\"build\": \"${CMAKE_BINARY_DIR}\", \"target\": \"${target}\", \"watch\": [\"${watched}\"]}\n")
endfunction()
