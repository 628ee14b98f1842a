#!/usr/bin/env bash
# Wind about a square building, from its model to a comparison with measurement: installs what is missing, builds Atria,
# meshes half of the wind tunnel, runs OpenFOAM and writes tables. Everything goes to build/validation.
#
#   run.sh           one mesh of 86,000 elements: some minutes
#   run.sh --study   all rows of docs/validation.md: an hour or two. It goes on where it stopped; rows may be named
set -euo pipefail

what=case
# shellcheck source=Examples/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/../build.sh"

rows=(layered16)
if [ "${1:-}" = --study ]; then
  shift
  rows=("$@")
elif [ $# -ne 0 ]; then
  echo "usage: $0 [--study [ROW ...]]" >&2
  exit 2
fi
export PYTHONPATH="$root/build/vtk/lib/python3/dist-packages"
/usr/bin/python3 Examples/SquareBuilding/study.py build/vtk/bin/atria build/validation "${rows[@]}"
