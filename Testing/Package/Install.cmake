# Installs the build to a fresh prefix.
file(REMOVE_RECURSE "${SCRATCH}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" --install "${ATRIA_BUILD}" --prefix "${SCRATCH}/prefix"
  OUTPUT_QUIET
  COMMAND_ERROR_IS_FATAL ANY)

# The package can be moved: no installed file of CMake may name the source or build folder.
file(GLOB_RECURSE files "${SCRATCH}/prefix/lib*/cmake/*.cmake")
foreach (file IN LISTS files)
  file(READ "${file}" text)
  foreach (folder IN ITEMS "${ATRIA_SOURCE}" "${ATRIA_BUILD}")
    string(FIND "${text}" "${folder}" found)
    if (NOT found EQUAL -1)
      message(SEND_ERROR "${file} names ${folder}")
    endif ()
  endforeach ()
endforeach ()
