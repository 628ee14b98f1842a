# atria_wrap_python(<argument of vtk_module_wrap_python>...)
# The Python package `atria`, in the build tree at lib/python3/dist-packages and installed likewise.
set(atria_python_dir "lib/python3/dist-packages") # where Debian's Python looks, whatever the architecture
set(atria_python_sources "${CMAKE_CURRENT_LIST_DIR}/Python")
set(atria_python_files __init__.py drawing.py errors.py meshing.py picture.py py.typed vtk_check.py
  report/__init__.py report/__main__.py report/case.py report/charts.py report/comfort.py report/fields.py report/page.py
  report/pictures.py report/profile.py report/results.py report/rooms.py report/scalars.py report/scene.py report/screens.py
  report/speeds.py report/stack.py report/warmth.py report/writing.py report/yearly.py)

macro (atria_wrap_python)
  vtk_module_wrap_python(
    PYTHON_PACKAGE "atria"
    MODULE_DESTINATION "${atria_python_dir}"
    INSTALL_HEADERS OFF
    BUILD_STATIC OFF
    ${ARGN})
  foreach (file IN LISTS atria_python_files)
    configure_file("${atria_python_sources}/${file}" "${CMAKE_BINARY_DIR}/${atria_python_dir}/atria/${file}" COPYONLY)
    get_filename_component(folder "${file}" DIRECTORY)
    install(FILES "${atria_python_sources}/${file}" DESTINATION "${atria_python_dir}/atria/${folder}" COMPONENT python)
  endforeach ()
  set(atria_python_build "${CMAKE_BINARY_DIR}/${atria_python_dir}")
  file(CONFIGURE OUTPUT "${atria_python_build}/atria/_version.py" CONTENT
    "__version__ = \"${PROJECT_VERSION}\"\nvtk_version = (${VTK_MAJOR_VERSION}, ${VTK_MINOR_VERSION})\n")
  set(atria_python_metadata "${atria_python_build}/atria-${PROJECT_VERSION}.dist-info")
  configure_file("${atria_python_sources}/METADATA.in" "${atria_python_metadata}/METADATA" @ONLY)
  install(FILES "${atria_python_build}/atria/_version.py" DESTINATION "${atria_python_dir}/atria" COMPONENT python)
  install(DIRECTORY "${atria_python_metadata}" DESTINATION "${atria_python_dir}" COMPONENT python)
endmacro ()

# atria_make_stubs(): for editors and type checkers, from the wrapped classes; they must be importable where they are built.
function (atria_make_stubs)
  set(stub "${CMAKE_BINARY_DIR}/${atria_python_dir}/atria/__init__.pyi")
  add_custom_command(OUTPUT "${stub}"
    COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${CMAKE_BINARY_DIR}/${atria_python_dir}" PYTHONDONTWRITEBYTECODE=1
            "${Python3_EXECUTABLE}" "${atria_python_sources}/make_stubs.py" "${stub}"
    DEPENDS ${ARGN} "${atria_python_sources}/make_stubs.py"
    VERBATIM)
  add_custom_target(AtriaPythonStubs ALL DEPENDS "${stub}")
  install(FILES "${stub}" DESTINATION "${atria_python_dir}/atria" COMPONENT python)
endfunction ()
