# SPDX-License-Identifier: MIT
# Writes the files that find_package(Grisaille) needs: for the installation, and for the build
# folder, which then serves as an installation prefix (its bin/ on the PATH is enough). Then
# configures the Debian package.
include(CMakePackageConfigHelpers)

function(grisaille_write_config folder shaders functions prefix)
  set(GRISAILLE_SHADERS ${shaders})
  set(GRISAILLE_FUNCTIONS ${functions})
  configure_package_config_file(
    ${CMAKE_SOURCE_DIR}/cmake/GrisailleConfig.cmake.in ${folder}/GrisailleConfig.cmake
    INSTALL_DESTINATION lib/cmake/Grisaille INSTALL_PREFIX ${prefix}
    PATH_VARS GRISAILLE_SHADERS GRISAILLE_FUNCTIONS NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file(${folder}/GrisailleConfigVersion.cmake
    COMPATIBILITY SameMajorVersion)
endfunction()

set(here ${CMAKE_BINARY_DIR}/lib/cmake/Grisaille)
grisaille_write_config(${here} ${CMAKE_SOURCE_DIR}/shaders ${CMAKE_SOURCE_DIR}/cmake
  ${CMAKE_BINARY_DIR})
export(EXPORT GrisailleTargets NAMESPACE Grisaille:: FILE ${here}/GrisailleTargets.cmake)

set(installed ${CMAKE_BINARY_DIR}/installed)
grisaille_write_config(${installed} share/grisaille/shaders lib/cmake/Grisaille
  ${CMAKE_INSTALL_PREFIX})
install(FILES ${installed}/GrisailleConfig.cmake ${installed}/GrisailleConfigVersion.cmake
              cmake/GrisailleShaders.cmake cmake/GrisailleEffect.cmake
        DESTINATION lib/cmake/Grisaille)
install(EXPORT GrisailleTargets NAMESPACE Grisaille:: DESTINATION lib/cmake/Grisaille)
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
