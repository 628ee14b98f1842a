#!/usr/bin/env bash
# Air changes of a building with open windows, from its model to a page: installs what is missing, builds Atria, meshes
# the model, runs the wind by OpenFOAM and makes the page. Everything goes to build/ventilation.
#
#   run.sh           the mesh of elements from 2 to 8 m: some minutes
#   run.sh --study   all rows of docs/ventilation.md: hours. It goes on where it stopped; rows may be named
set -euo pipefail

what=case
# shellcheck source=Examples/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/../build.sh"

here=Examples/NaturalVentilation
out=build/ventilation
atria=build/vtk/bin/atria
mkdir -p "$out"
export PYTHONPATH="$root/build/vtk/lib/python3/dist-packages"
if [ "${1:-}" = --study ]; then
  shift
  exec /usr/bin/python3 $here/study.py "$atria" "$out/study" "$@"
fi
[ $# -eq 0 ] || { echo "usage: $0 [--study [ROW ...]]" >&2; exit 2; }

/usr/bin/python3 $here/make_building.py "$out/school.wrl"
"$atria" mesh "$out/school.wrl" -o "$out/school.vtu" --site Site --openings --size-min 2 --size-mid 2 --size-max 8
if [ -e "$out/case" ]; then "$out/case/Allclean"; fi
# Air changes have settled after 100 iterations.
"$atria" case "$out/school.vtu" -o "$out/case" --from 180 --speed 4 --roughness 0.1 --age-of-air --iterations 300 --processors "$(nproc)"
# In a container one is root, as whom Open MPI runs nothing unless it is told to.
if [ "$(id -u)" -eq 0 ]; then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi
"$out/case/Allrun"
"$atria" report "$out/case"
echo "Open $root/$out/case/report.html"
