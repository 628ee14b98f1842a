#!/usr/bin/env bash
# The wind behind a row of trees: installs what is missing, builds Atria, meshes a windbreak, runs OpenFOAM and compares with
# measurements (docs/records/validation.md). Everything goes to build/trees.
#
#   run.sh           one windbreak, and the open wind: a dozen minutes
#   run.sh --study   all rows. It goes on where it stopped; rows may be named
set -euo pipefail

# shellcheck disable=SC2034  # for run_rows.sh
study=Examples/Trees/windbreak.py out=build/trees rows=(open porosity10)
# shellcheck source=Examples/Study/run_rows.sh
. "$(dirname "${BASH_SOURCE[0]}")/../Study/run_rows.sh"
