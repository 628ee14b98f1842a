#!/usr/bin/env bash
# Air that warm rooms move: installs what is missing, builds Atria, meshes a room with two openings in air at rest, runs OpenFOAM
# with several sources of heat and compares with formulas. Everything goes to build/warm-air.
#
#   run.sh           the room with one heat: two minutes
#   run.sh --study   all rows of docs/ventilation.md: a quarter of an hour. It goes on where it stopped; rows may be named
set -euo pipefail

study=Examples/WarmAir/study.py
out=build/warm-air
rows=(stack600)
# shellcheck source=Examples/Study/run_rows.sh
. "$(dirname "${BASH_SOURCE[0]}")/../Study/run_rows.sh"
