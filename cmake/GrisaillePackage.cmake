# SPDX-License-Identifier: MIT
# Writes the files that find_package(Grisaille) and pkg-config need: for the installation, and for the
# build folder, which then serves as an installation prefix (its bin/ on the PATH is enough). Then
# configures the Debian package.
include(CMakePackageConfigHelpers)

# The targets of each component of find_package, beside those that all components share.
set(sets GrisailleTargets GrisailleHostTargets GrisailleEffectTargets)
if(GRISAILLE_PROGRAMS)
  list(APPEND sets GrisailleProgramTargets)
endif()

function(grisaille_write_config folder shaders prefix)
  set(GRISAILLE_SHADERS ${shaders})
  set(GRISAILLE_EFFECTS lib/grisaille/effects)
  configure_package_config_file(
    ${CMAKE_SOURCE_DIR}/cmake/GrisailleConfig.cmake.in ${folder}/GrisailleConfig.cmake
    INSTALL_DESTINATION lib/cmake/Grisaille INSTALL_PREFIX ${prefix}
    PATH_VARS GRISAILLE_SHADERS GRISAILLE_EFFECTS
    NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file(${folder}/GrisailleConfigVersion.cmake
    COMPATIBILITY SameMajorVersion)
endfunction()

set(here ${CMAKE_BINARY_DIR}/lib/cmake/Grisaille)
grisaille_write_config(${here} ${CMAKE_SOURCE_DIR}/shaders ${CMAKE_BINARY_DIR})
set(installed ${CMAKE_BINARY_DIR}/installed)
grisaille_write_config(${installed} share/grisaille/shaders ${CMAKE_INSTALL_PREFIX})
foreach(functions GrisailleShaders GrisailleEffect)
  configure_file(cmake/${functions}.cmake ${here}/${functions}.cmake COPYONLY)
  configure_file(cmake/${functions}.cmake ${installed}/${functions}.cmake COPYONLY)
endforeach()
install(DIRECTORY ${installed}/ DESTINATION lib/cmake/Grisaille FILES_MATCHING PATTERN *.cmake)
foreach(set IN LISTS sets)
  export(EXPORT ${set} NAMESPACE Grisaille:: FILE ${here}/${set}.cmake)
  install(EXPORT ${set} NAMESPACE Grisaille:: DESTINATION lib/cmake/Grisaille)
endforeach()

# For pkg-config. The static library has a file of its own beside the shared one, because a linker
# takes the shared library where it finds both.
function(grisaille_write_pc name libs private)
  set(GRISAILLE_LIBS ${libs})
  set(GRISAILLE_LIBS_PRIVATE ${private})
  configure_file(${CMAKE_SOURCE_DIR}/cmake/grisaille.pc.in ${installed}/${name}.pc @ONLY)
  install(FILES ${installed}/${name}.pc DESTINATION lib/pkgconfig)
endfunction()
set(needed "-lepoxy -lstdc++ -lm -ldl")
grisaille_write_pc(grisaille -lgrisaille "${needed}")
if(TARGET grisaille_host AND TARGET grisaille_static)
  grisaille_write_pc(grisaille-static "-l:libgrisaille.a ${needed}" "")
endif()

install(DIRECTORY shaders/common DESTINATION share/grisaille/shaders)
install(FILES LICENSE DESTINATION share/doc/grisaille RENAME copyright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME grisaille)
set(CPACK_PACKAGE_VENDOR "The Grisaille authors")
set(CPACK_PACKAGE_DESCRIPTION "Ambient occlusion and paint as plugins over OpenGL and Vulkan, a viewer that tunes them live, and
a study of the cost and error of each setting. Includes everything needed to write an effect: see
`grisaille new-effect`.")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Grisaille authors <grisaille@localhost>")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# The program loads drivers at run time, so that shlibdeps does not find them. One is enough.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1 | libvulkan1")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
  "fonts-dejavu-core, libegl1, libgl1, libgl1-mesa-dri, libvulkan1, mesa-vulkan-drivers")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, g++, glslc, make, vulkan-validationlayers")
include(CPack)
