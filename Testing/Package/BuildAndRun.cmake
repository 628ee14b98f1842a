# Configures a project of its own against the installed package, builds and runs it.
set(build "${SCRATCH}/${NAME}")
execute_process(
  COMMAND "${CMAKE_COMMAND}" -S "${ATRIA_SOURCE}/${PROJECT}" -B "${build}" -G "${GENERATOR}"
    "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
    "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "-DCMAKE_CXX_FLAGS=${FLAGS}"
    "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix"
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND "${CMAKE_COMMAND}" --build "${build}"
  COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE "|" ";" command "${RUN}")
list(POP_FRONT command program)
execute_process(
  COMMAND "${build}/${program}" ${command}
  WORKING_DIRECTORY "${build}"
  COMMAND_ERROR_IS_FATAL ANY)
