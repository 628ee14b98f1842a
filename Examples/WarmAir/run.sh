#!/usr/bin/env bash
# Air that warm rooms move: installs what is missing, builds Atria, meshes a room with two openings in air at rest, runs OpenFOAM
# with several sources of heat and compares with formulas. Everything goes to build/warm-air.
#
#   run.sh           the room with one heat: two minutes
#   run.sh --study   all rows of docs/ventilation.md: a quarter of an hour. It goes on where it stopped; rows may be named
#   run.sh --cavity  air between a warm and a cold wall against measurements (docs/records/validation.md): minutes
set -euo pipefail

study=Examples/WarmAir/study.py
out=build/warm-air
rows=(stack600)
if [ "${1:-}" = --cavity ]; then
  shift
  study=Examples/WarmAir/cavity.py out=build/warm-air/cavity rows=(sst8)
fi
# shellcheck source=Examples/Study/run_rows.sh
. "$(dirname "${BASH_SOURCE[0]}")/../Study/run_rows.sh"
