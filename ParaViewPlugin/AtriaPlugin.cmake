# Builds the ParaView plugin. The plugin holds the same modules as the package made against VTK.
list(APPEND atria_module_files "${CMAKE_CURRENT_SOURCE_DIR}/ParaViewPlugin/Display/vtk.module")
paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/ParaViewPlugin/paraview.plugin"
  PROVIDES_PLUGINS atria_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
set(atria_plugins_subdirectory "paraview-${ParaView_VERSION_MAJOR}.${ParaView_VERSION_MINOR}/plugins")
paraview_plugin_build(
  PLUGINS ${atria_plugins}
  LIBRARY_SUBDIRECTORY "${atria_plugins_subdirectory}"
  PLUGINS_FILE_NAME "atria.xml"
  PLUGINS_COMPONENT runtime
  TARGET_COMPONENT runtime
  INSTALL_HEADERS OFF
  AUTOLOAD ${atria_plugins})

# The list of plugins that ParaView 5.11 loads lies beside its program; Debian's package has none.
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/paraview.conf" CONTENT
  "../${CMAKE_INSTALL_LIBDIR}/${atria_plugins_subdirectory}/atria.xml\n")
install(FILES "${CMAKE_BINARY_DIR}/paraview.conf" DESTINATION "${CMAKE_INSTALL_BINDIR}"
  COMPONENT runtime EXCLUDE_FROM_ALL)
