# Debian packages, by `cpack` in builds of the presets `package` and `package-paraview`, which install to /usr as Debian
# does. A package is a component of the installation.
set(documents "${CMAKE_INSTALL_DATADIR}/doc")

# atria_debian_package(<component> NAME <package> SECTION <section> TEXT <description> [DEPENDS <dependency>...] [CONFLICTS <package>])
# Dependencies on shared libraries of others are found by dpkg-shlibdeps.
macro (atria_debian_package component)
  cmake_parse_arguments(arg "" "NAME;SECTION;TEXT;CONFLICTS" "DEPENDS" ${ARGN})
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${arg_NAME}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${arg_SECTION}")
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${arg_TEXT}")
  list(JOIN arg_DEPENDS ", " CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS)
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONFLICTS "${arg_CONFLICTS}")
  install(FILES "${PROJECT_SOURCE_DIR}/docs/copyright" "${CMAKE_BINARY_DIR}/changelog.Debian.gz"
    DESTINATION "${documents}/${arg_NAME}" COMPONENT ${component})
endmacro ()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Atria developers <developers@atria.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "meshes of architecture for flow simulation")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(CPACK_COMPONENTS_ALL)
set(same_version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# Changes are in CHANGELOG.md; Debian wants a file of its own form.
cmake_host_system_information(RESULT suite QUERY DISTRIB_VERSION_CODENAME)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/changelog.Debian" CONTENT
"atria (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) ${suite}; urgency=medium

  * Release ${PROJECT_VERSION}; CHANGELOG.md in atria-doc lists the changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
file(ARCHIVE_CREATE OUTPUT "${CMAKE_BINARY_DIR}/changelog.Debian.gz" PATHS "${CMAKE_BINARY_DIR}/changelog.Debian"
  FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)

if (ATRIA_BUILD_PARAVIEW_PLUGIN)
  # ParaView is not installed where the plugin is built, so dpkg-shlibdeps finds its libraries, but not their package.
  list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${ParaView_DIR}/../.."
    "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/${atria_plugins_subdirectory}/Atria")
  math(EXPR next_minor "${ParaView_VERSION_MINOR} + 1")
  set(paraview "${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "atria-assimp")
  atria_debian_package(runtime NAME paraview-atria SECTION science
    DEPENDS "paraview (>= ${paraview})" "paraview (<< ${ParaView_VERSION_MAJOR}.${next_minor}~)"
    TEXT "The plugin of ParaView, which ParaView loads when it starts.")
  atria_debian_package(python NAME python3-atria-paraview SECTION python CONFLICTS python3-atria
    DEPENDS "paraview-atria ${same_version}" python3-paraview
    TEXT "The Python package atria for pvpython and pvbatch, which have a VTK of their own.")
else ()
  set(library libatria${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  atria_debian_package(runtime NAME ${library} SECTION libs TEXT "The library: filters, readers and writers for VTK.")
  atria_debian_package(development NAME libatria-dev SECTION libdevel
    DEPENDS "${library} ${same_version}" "libvtk9-dev (>= 9.1)" "libeigen3-dev (>= 3.4)"
    TEXT "Headers, and what find_package(Atria) of CMake needs.")
  atria_debian_package(command_line NAME atria SECTION science DEPENDS "${library} ${same_version}"
    TEXT "The command line, with its manual page and completion for shells.")
  set(CPACK_DEBIAN_COMMAND_LINE_PACKAGE_RECOMMENDS python3-atria) # for atria report
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "xvfb, xauth") # for pictures without a display
  if (TARGET atria-assimp)
    atria_debian_package(assimp NAME atria-assimp SECTION science
      TEXT "The program by which the library reads COLLADA, 3DS, FBX and IFC.")
    set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "atria-assimp")
  endif ()
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  atria_debian_package(python NAME python3-atria SECTION python CONFLICTS python3-atria-paraview
    DEPENDS "${library} ${same_version}" "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}~)"
      "python3 (<< ${Python3_VERSION_MAJOR}.${next_minor})" python3-vtk9 python3-numpy
    TEXT "The Python package atria.")
  atria_debian_package(documentation NAME atria-doc SECTION doc TEXT "Documents and examples.")
  set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
  install(DIRECTORY docs/ DESTINATION "${documents}/atria-doc" COMPONENT documentation
    PATTERN copyright EXCLUDE PATTERN site EXCLUDE)
  install(DIRECTORY "${CMAKE_BINARY_DIR}/site/html" DESTINATION "${documents}/atria-doc" COMPONENT documentation OPTIONAL)
  install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION "${documents}/atria-doc" COMPONENT documentation)
  install(DIRECTORY Examples/CommandLine Examples/Cxx Examples/Data Examples/Python
    DESTINATION "${documents}/atria-doc/examples" COMPONENT documentation)
endif ()
include(CPack)
