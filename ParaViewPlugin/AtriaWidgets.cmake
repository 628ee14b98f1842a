# Widgets of the panels, by the name that the XML has for them, and the toolbar: sets ui_interfaces and ui_sources.
set(ui_sources
  Widgets/AtriaModelNames.cxx
  Widgets/AtriaModelNames.h)

# atria_add_panel_widget(<kind> <name in the XML> <class>)
macro (atria_add_panel_widget kind type class)
  paraview_plugin_add_property_widget(
    KIND ${kind}
    TYPE ${type}
    CLASS_NAME ${class}
    INTERFACES interface
    SOURCES sources)
  list(APPEND ui_interfaces ${interface})
  list(APPEND ui_sources ${sources} Widgets/${class}.cxx Widgets/${class}.h)
endmacro ()

atria_add_panel_widget(GROUP_WIDGET AtriaBox pqAtriaBoxWidget)
atria_add_panel_widget(WIDGET atria_surface_name pqAtriaNameWidget)
atria_add_panel_widget(WIDGET atria_surface_rules pqAtriaRuleTable)
atria_add_panel_widget(WIDGET atria_estimate pqAtriaEstimateWidget)

paraview_plugin_add_toolbar(
  CLASS_NAME pqAtriaToolBar
  INTERFACES interface
  SOURCES sources)
list(APPEND ui_interfaces ${interface})
list(APPEND ui_sources ${sources} Widgets/pqAtriaToolBar.cxx Widgets/pqAtriaToolBar.h)
