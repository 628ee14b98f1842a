#!/usr/bin/env bash
# Installs what is missing, builds against VTK and against ParaView, and runs every test of both.
#
#   run.sh           what every change must pass
#   run.sh --full    also the long tests (large meshes, all models)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
for argument in "$@"; do
  case $argument in
    --full) export ATRIA_TEST_FULL=1 ;;
    *)
      echo "usage: $0 [--full]" >&2
      exit 2
      ;;
  esac
done

Testing/check-layers.sh
.ci/install-dependencies.sh test
Testing/check-format.sh
if [ -z "${ATRIA_COMPILER_LAUNCHER+set}" ]; then export ATRIA_COMPILER_LAUNCHER=ccache; fi
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$root} # builds of several presets share the core's objects
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-2} # a test has more than one thread only some of the time

failed=()
for preset in vtk paraview; do
  cmake --preset "$preset" -DATRIA_BUILD_TESTING=ON
  cmake --build --preset "$preset"
  # Both are tested even if the first fails: one run tells all.
  ctest --preset "$preset" --no-tests=error || failed+=("$preset")
done
Testing/Package/debian.sh ${ATRIA_TEST_FULL:+--full} || failed+=(packages)
if [ "${#failed[@]}" -gt 0 ]; then
  echo "tests failed in: ${failed[*]}" >&2
  exit 1
fi
echo "All tests passed."
