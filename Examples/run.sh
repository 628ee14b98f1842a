#!/usr/bin/env bash
# Installs what is missing, builds the command line, meshes the example house and draws a picture of the mesh.
# Everything goes to build/example.
set -euo pipefail

# shellcheck source=Examples/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/build.sh"

out=build/example
mkdir -p "$out"
status=0
build/vtk/bin/atria mesh Examples/Data/house.wrl -o "$out/mesh.vtu" --patches "$out/patches.vtpc" \
  --openfoam "$out/openfoam" --report "$out/report.json" \
  --site Site --size-max 8 --size-mid 1 --size-min 1 || status=$?
# 4: the mesh is written, and the report counts the elements that are not valid.
[ "$status" -eq 0 ] || [ "$status" -eq 4 ] || exit "$status"
xvfb-run -a -s "-screen 0 1280x900x24 -noreset" \
  /usr/bin/python3 Examples/Python/picture.py "$out/mesh.vtu" "$out/patches.vtpc" "$out/house.png"
echo "In $root/$out:"
ls "$out"
