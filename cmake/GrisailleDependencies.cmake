# SPDX-License-Identifier: MIT
# Finds the libraries and tools that a build needs. If any are missing, CMake stops with a list of
# all of them, each with the part that needs it and its Debian package.

set_property(GLOBAL PROPERTY GRISAILLE_MISSING "")

# grisaille_found(VARIABLE NAME PACKAGE REASON): records NAME as missing if VARIABLE is false.
function(grisaille_found variable name package reason)
  if(NOT ${variable})
    set_property(GLOBAL APPEND_STRING PROPERTY GRISAILLE_MISSING
      "\n  ${name}, for ${reason}: Debian's ${package}")
    set_property(GLOBAL APPEND PROPERTY GRISAILLE_MISSING_PACKAGES ${package})
  endif()
endfunction()

# Finds a CMake package. Its targets are visible in the calling directory.
macro(grisaille_package name package reason)
  find_package(${name} QUIET ${ARGN})
  grisaille_found(${name}_FOUND ${name} ${package} "${reason}")
endmacro()

# Finds a pkg-config module, as the target PkgConfig::PREFIX.
macro(grisaille_module prefix module package reason)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${module})
  endif()
  grisaille_found(${prefix}_FOUND ${module} ${package} "${reason}")
endmacro()

# Finds the header of a library without files for CMake or pkg-config.
function(grisaille_header variable header package reason)
  find_path(${variable} ${header})
  mark_as_advanced(${variable})
  grisaille_found(${variable} ${header} ${package} "${reason}")
endfunction()

# Stops if anything is missing.
function(grisaille_require_found)
  get_property(missing GLOBAL PROPERTY GRISAILLE_MISSING)
  get_property(packages GLOBAL PROPERTY GRISAILLE_MISSING_PACKAGES)
  if(NOT missing)
    return()
  endif()
  list(REMOVE_DUPLICATES packages)
  list(JOIN packages " " packages)
  message(FATAL_ERROR
    "Grisaille needs these libraries and tools, which CMake does not find:${missing}\n"
    "On Debian or Ubuntu: sudo apt install ${packages}\n"
    "Or turn parts off: -DGRISAILLE_VIEWER=OFF, -DGRISAILLE_TRUTH=OFF, -DGRISAILLE_TESTS=OFF, "
    "-DGRISAILLE_PROGRAMS=OFF.")
endfunction()

grisaille_package(PkgConfig pkg-config "the build, which finds libraries with it")
grisaille_package(Threads libc6-dev "threads")
grisaille_package(fmt libfmt-dev "text")
grisaille_package(glm libglm-dev "vectors")
grisaille_package(nlohmann_json nlohmann-json3-dev "JSON")
grisaille_module(EPOXY epoxy libepoxy-dev "the OpenGL backend")
grisaille_header(EGL_HEADER EGL/eglplatform.h libegl-dev "the OpenGL backend")
grisaille_header(VOLK_HEADER volk.h libvulkan-volk-dev "the Vulkan backend")
grisaille_header(VULKAN_HEADER vulkan/vulkan.h libvulkan-dev "the Vulkan backend")
# As a shared library, or as static ones, whose CMake configs name each other in this order.
if(PKG_CONFIG_FOUND)
  pkg_check_modules(SPIRV_CROSS QUIET IMPORTED_TARGET spirv-cross-c-shared)
endif()
set(GRISAILLE_SPIRV_CROSS PkgConfig::SPIRV_CROSS)
if(NOT SPIRV_CROSS_FOUND)
  foreach(part core glsl hlsl msl cpp reflect util c)
    find_package(spirv_cross_${part} CONFIG QUIET)
  endforeach()
  set(SPIRV_CROSS_FOUND ${spirv_cross_c_FOUND})
  set(GRISAILLE_SPIRV_CROSS spirv-cross-c)
endif()
grisaille_found(SPIRV_CROSS_FOUND spirv-cross-c-shared libspirv-cross-c-shared-dev "compiling shaders")
find_program(GRISAILLE_GLSLC glslc)
grisaille_found(GRISAILLE_GLSLC glslc glslc "compiling shaders")
if(NOT GRISAILLE_PROGRAMS)
  grisaille_require_found()
  return()
endif()

grisaille_package(CLI11 libcli11-dev "the command line")
grisaille_package(TinyGLTF libtinygltf-dev "glTF scenes")
grisaille_package(draco libdraco-dev "compressed glTF scenes")
grisaille_package(meshoptimizer libmeshoptimizer-dev "compressed glTF scenes")
grisaille_package(TBB libtbb-dev "work on all cores")
grisaille_module(TOMLPLUSPLUS tomlplusplus libtomlplusplus-dev "settings files")
# OpenImageIO's CMake config names a folder that Debian lacks; its pkg-config file is correct.
grisaille_module(OPENIMAGEIO OpenImageIO libopenimageio-dev "reading pictures")
grisaille_module(OPENEXR OpenEXR libopenexr-dev "writing pictures")
grisaille_module(PNG libpng libpng-dev "reading and writing PNGs")

if(GRISAILLE_TRUTH)
  # core/trace/embree.h supports both major releases.
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3.13 QUIET)
  endif()
  grisaille_found(embree_FOUND "Embree 3.13 or 4" libembree-dev "rays through the scene (GRISAILLE_TRUTH)")
endif()

if(GRISAILLE_VIEWER)
  grisaille_package(glfw3 libglfw3-dev "windows (GRISAILLE_VIEWER)" 3.3)
  grisaille_module(IMGUI imgui libimgui-dev "the panel (GRISAILLE_VIEWER)")
  grisaille_module(X11 x11 libx11-dev "touchpads (GRISAILLE_VIEWER)")
  grisaille_module(XI "xi>=1.8" libxi-dev "touchpads (GRISAILLE_VIEWER)")
  # Programs that use Debian's libimgui must link stb; elsewhere Dear ImGui has its own copy.
  find_library(STB_LIBRARY stb)
  mark_as_advanced(STB_LIBRARY)
endif()

if(GRISAILLE_TESTS)
  grisaille_package(GTest libgtest-dev "the tests (GRISAILLE_TESTS)")
  grisaille_module(XCB xcb libxcb1-dev "windows in tests (GRISAILLE_TESTS)")
  grisaille_header(INPUTTEST_HEADER xorg/xf86-input-inputtest-protocol.h xserver-xorg-dev
    "touchpads in tests (GRISAILLE_TESTS)")
endif()

grisaille_require_found()
