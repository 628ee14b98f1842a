# Builds the modules, their Python package and the CMake package `find_package(Atria)` finds.
set(atria_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Atria")

vtk_module_scan(
  MODULE_FILES ${atria_module_files}
  PROVIDES_MODULES atria_modules
  REQUEST_MODULES Atria::FiltersMeshing Atria::FiltersQuality Atria::IOSurface Atria::IOVRML Atria::IOModel Atria::IOCFD
    Atria::IOWeather Atria::IOClimate
  ENABLE_TESTS OFF)
vtk_module_build(
  MODULES ${atria_modules}
  PACKAGE Atria
  INSTALL_EXPORT Atria
  INSTALL_HEADERS ON
  HEADERS_DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/atria"
  CMAKE_DESTINATION "${atria_package_dir}"
  LIBRARY_NAME_SUFFIX ""
  VERSION "${PROJECT_VERSION}"
  SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}"
  TEST_DIRECTORY_NAME NONE)

if (ATRIA_BUILD_PYTHON)
  include(Filters/AtriaPython.cmake)
  atria_wrap_python(
    MODULES ${atria_modules}
    INSTALL_EXPORT Atria
    CMAKE_DESTINATION "${atria_package_dir}"
    LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(atria_python_modules)
  foreach (module IN LISTS atria_modules)
    string(REPLACE "::" "" target "${module}Python")
    if (TARGET ${target}) # modules without classes are not wrapped
      list(APPEND atria_python_modules ${target})
    endif ()
  endforeach ()
  atria_make_stubs(${atria_python_modules})
endif ()

file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/${atria_package_dir}/AtriaConfig.cmake" @ONLY CONTENT [=[
include(CMakeFindDependencyMacro)
find_dependency(VTK @VTK_MAJOR_VERSION@.@VTK_MINOR_VERSION@ COMPONENTS @atria_vtk_components@)
if (NOT "${VTK_MAJOR_VERSION}.${VTK_MINOR_VERSION}" STREQUAL "@VTK_MAJOR_VERSION@.@VTK_MINOR_VERSION@")
  set(Atria_FOUND FALSE)
  set(Atria_NOT_FOUND_MESSAGE "this Atria was built with VTK @VTK_MAJOR_VERSION@.@VTK_MINOR_VERSION@, and VTK ${VTK_VERSION} \
was found in ${VTK_DIR}: let VTK_DIR name the one that Atria was built with, or build Atria with yours")
  return()
endif ()
find_dependency(Eigen3 NO_MODULE) # in the headers of the core
include("${CMAKE_CURRENT_LIST_DIR}/Atria-targets.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/Atria-vtk-module-properties.cmake")
]=])
include(CMakePackageConfigHelpers)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/${atria_package_dir}/AtriaConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_BINARY_DIR}/${atria_package_dir}/AtriaConfig.cmake"
  "${CMAKE_BINARY_DIR}/${atria_package_dir}/AtriaConfigVersion.cmake"
  DESTINATION "${atria_package_dir}"
  COMPONENT development)
