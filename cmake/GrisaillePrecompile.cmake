# SPDX-License-Identifier: MIT
# Precompiles the headers that most sources include, which takes 2 s of each C++ source's compilation.
# A precompiled header fits the options that it was compiled with: there is one for the libraries and
# one for the tests, which are executables. Targets with other options (-ffp-contract, -pthread), or
# without fmt, set the property DISABLE_PRECOMPILE_HEADERS.

# Puts the targets of a folder and of those below it into the variable `out`.
function(grisaille_targets_below folder out)
  get_property(found DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(each IN LISTS below)
    grisaille_targets_below(${each} more)
    list(APPEND found ${more})
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# grisaille_precompile(<name> <header> TYPES <target type>... FOLDERS <folder>... [LINK <library>...])
#
# Compiles the header as the target <name>, for the targets of these types in these folders.
function(grisaille_precompile name header)
  if(NOT GRISAILLE_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "TYPES;FOLDERS;LINK" ${ARGN})
  foreach(folder IN LISTS ARG_FOLDERS)
    grisaille_targets_below(${CMAKE_SOURCE_DIR}/${folder} below)
    list(APPEND targets ${below})
  endforeach()
  # The C source is for targets that have C sources too: CMake asks for a header for each language.
  set(sources ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp ${CMAKE_BINARY_DIR}/precompiled/${name}.c)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled/${name}.cpp CONTENT "int main() {}\n")
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled/${name}.c CONTENT "typedef int Unused;\n")
  if(EXECUTABLE IN_LIST ARG_TYPES)
    add_executable(${name} ${sources})
  else()
    add_library(${name} OBJECT ${sources})
  endif()
  target_link_libraries(${name} PRIVATE fmt::fmt-header-only ${ARG_LINK})
  target_precompile_headers(${name} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:${CMAKE_SOURCE_DIR}/cmake/${header}> $<$<COMPILE_LANGUAGE:C>:<stddef.h$<ANGLE-R>>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${name} PUBLIC -fpch-preprocess)  # for ccache
  endif()
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    get_target_property(sources ${target} SOURCES)
    if(type IN_LIST ARG_TYPES AND "${sources}" MATCHES "\\.cpp")
      target_precompile_headers(${target} REUSE_FROM ${name})
    endif()
  endforeach()
endfunction()
