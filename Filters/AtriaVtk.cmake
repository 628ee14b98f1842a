# What differs between versions of VTK when sources are compiled.

# atria_use_smp_tools(<source>...): these include vtkSMPTools.h, which in VTK 9.1 names constructors by template-id. C++20
# forbids that.
function (atria_use_smp_tools)
  if (VTK_VERSION VERSION_LESS 9.2)
    set_source_files_properties(${ARGN} PROPERTIES
      COMPILE_OPTIONS "$<IF:$<CXX_COMPILER_ID:MSVC>,/std:c++17,-std=c++17>")
  endif ()
endfunction ()
