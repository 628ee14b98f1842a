#!/usr/bin/env bash
# Dependencies go one way: the core knows no VTK, and filters and readers or writers do not know each other.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
status=0

# forbid <folder> <pattern of an included file> <rule>
forbid() {
  local found
  found=$(grep -rnE --include='*.h' --include='*.cxx' "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]$2" "$1" || true)
  if [ -n "$found" ]; then
    printf '%s\n%s\n' "$3" "$found" >&2
    status=1
  fi
}

# Names of the headers in folders, as alternatives of a pattern.
headers_in() {
  find "$@" -name '*.h' -printf '%f\n' | sed 's/\./\\./' | sort -u | paste -sd '|'
}

# The core's own headers are included with their folder (Quality/Geometry.h), all others without.
forbid Filters/Core '(.*/)?vtk[A-Z]' 'Filters/Core must not include VTK:'
forbid Filters/Core "($(headers_in Filters/Bridge))" 'Filters/Core must not include the bridge to VTK:'
forbid IO "($(headers_in Filters/Meshing Filters/Quality))" 'IO must not include filters:'
forbid Filters "($(headers_in IO))" 'Filters must not include IO:'
# CGAL is slow to compile: only the few sources that need it include it.
cgal=$(grep -rnE --include='*.h' '^[[:space:]]*#[[:space:]]*include[[:space:]]*<CGAL/' Filters IO || true)
if [ -n "$cgal" ]; then
  printf 'Headers must not include CGAL:\n%s\n' "$cgal" >&2
  status=1
fi
exit "$status"
