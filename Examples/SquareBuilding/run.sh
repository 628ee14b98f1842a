#!/usr/bin/env bash
# Wind about a square building, from its model to a comparison with measurement: installs what is missing, builds Atria,
# meshes half of the wind tunnel, runs OpenFOAM and writes tables. Everything goes to build/validation.
#
#   run.sh           one mesh of 86,000 elements: some minutes
#   run.sh --study   all rows of docs/records/validation.md: an hour or two. It goes on where it stopped; rows may be named
set -euo pipefail

study=Examples/SquareBuilding/study.py
out=build/validation
rows=(layered16)
# shellcheck source=Examples/Study/run_rows.sh
. "$(dirname "${BASH_SOURCE[0]}")/../Study/run_rows.sh"
