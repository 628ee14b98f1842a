# Builds the ParaView plugin. The plugin holds the same modules as the package made against VTK.
paraview_plugin_scan(
  PLUGIN_FILES "${CMAKE_CURRENT_SOURCE_DIR}/ParaViewPlugin/paraview.plugin"
  PROVIDES_PLUGINS atria_plugins
  ENABLE_BY_DEFAULT ON
  HIDE_PLUGINS_FROM_CACHE ON)
paraview_plugin_build(
  PLUGINS ${atria_plugins}
  PLUGINS_FILE_NAME "atria.xml"
  AUTOLOAD ${atria_plugins})
