# shellcheck shell=bash
# To be sourced by the run.sh of a study, with its arguments: installs what is missing, builds Atria, and runs `study`, a
# program, into the folder `out`: the rows of `rows`, or with --study those that follow, or all.
if [ "${1:-}" = --study ]; then
  shift
  rows=("$@")
elif [ $# -ne 0 ]; then
  echo "usage: $0 [--study [ROW ...]]" >&2
  exit 2
fi
# shellcheck disable=SC2034,SC2154  # `what` is for build.sh, `study` and `out` are of who sources this
what=case
# shellcheck source=Examples/build.sh
. "$(dirname "${BASH_SOURCE[0]}")/../build.sh"
export PYTHONPATH="$root/build/vtk/lib/python3/dist-packages"
/usr/bin/python3 "$study" build/vtk/bin/atria "$out" "${rows[@]}"
