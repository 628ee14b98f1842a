# atria_wrap_python(<argument of vtk_module_wrap_python>...)
# The Python package `atria`, in the build tree at lib/python3/dist-packages and installed likewise.
set(atria_python_dir "${CMAKE_INSTALL_LIBDIR}/python3/dist-packages")
set(atria_python_sources "${CMAKE_CURRENT_LIST_DIR}/Python")
set(atria_python_files __init__.py errors.py)

macro (atria_wrap_python)
  vtk_module_wrap_python(
    PYTHON_PACKAGE "atria"
    MODULE_DESTINATION "${atria_python_dir}"
    INSTALL_HEADERS OFF
    BUILD_STATIC OFF
    ${ARGN})
  foreach (file IN LISTS atria_python_files)
    configure_file("${atria_python_sources}/${file}" "${CMAKE_BINARY_DIR}/${atria_python_dir}/atria/${file}" COPYONLY)
    install(FILES "${atria_python_sources}/${file}" DESTINATION "${atria_python_dir}/atria")
  endforeach ()
endmacro ()
