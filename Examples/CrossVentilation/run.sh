#!/usr/bin/env bash
# Wind through a building in a wind tunnel, by meshes of several kinds: installs what is missing, builds Atria, meshes half
# of the tunnel, runs OpenFOAM and writes a table. Everything goes to build/cross-ventilation.
#
#   run.sh           the meshes of 10 mm: some minutes
#   run.sh --study   all rows of docs/ventilation.md: half an hour. It goes on where it stopped; rows may be named
set -euo pipefail

study=Examples/CrossVentilation/study.py
out=build/cross-ventilation
rows=(uniform10 adaptive10 layered10)
# shellcheck source=Examples/Study/run_rows.sh
. "$(dirname "${BASH_SOURCE[0]}")/../Study/run_rows.sh"
