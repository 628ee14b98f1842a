#!/usr/bin/env bash
# Wind through a building in a wind tunnel, by meshes of several kinds: installs what is missing, builds Atria, meshes half
# of the tunnel, runs OpenFOAM and writes a table. Everything goes to build/cross-ventilation.
#
#   run.sh           the meshes of 10 mm: some minutes
#   run.sh --study   all rows of docs/ventilation.md: half an hour. It goes on where it stopped; rows may be named
set -euo pipefail

what=case
# shellcheck source=Examples/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/../build.sh"

rows=(uniform10 adaptive10 layered10)
if [ "${1:-}" = --study ]; then
  shift
  rows=("$@")
elif [ $# -ne 0 ]; then
  echo "usage: $0 [--study [ROW ...]]" >&2
  exit 2
fi
export PYTHONPATH="$root/build/vtk/lib/python3/dist-packages"
/usr/bin/python3 Examples/CrossVentilation/study.py build/vtk/bin/atria build/cross-ventilation "${rows[@]}"
