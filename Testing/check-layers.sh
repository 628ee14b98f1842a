#!/usr/bin/env bash
# Dependencies go one way: the core knows no VTK, filters and readers or writers do not know each other, and a room of
# the core includes only itself and those before it, so that there is no cycle. Weather files are read without VTK. No two
# types of a namespace have one name, and no message names an option.
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
forbid IO/Weather '(.*/)?vtk[A-Z]' 'IO/Weather must not include VTK:'
forbid IO/Weather "($(headers_in Filters/Bridge IO/CFD IO/Climate IO/Model IO/Surface IO/VRML)|CLI/)" 'IO/Weather must not include the bridge to VTK, other readers or the command line:'
forbid IO/Weather '(Grid|Surface|Domain|Octree|Dual|Layer|Audit|Quality|Optimize|Mesher|Ranks)/' 'IO/Weather must include no more of the core than Support:'
forbid Filters "($(headers_in IO))" 'Filters must not include IO:'
# CGAL is slow to compile: only the few sources that need it include it.
cgal=$(grep -rnE --include='*.h' '^[[:space:]]*#[[:space:]]*include[[:space:]]*<CGAL/' Filters IO || true)
if [ -n "$cgal" ]; then
  printf 'Headers must not include CGAL:\n%s\n' "$cgal" >&2
  status=1
fi

# In the order in which they are read.
rooms=(Support Grid
  Surface/Triangles Surface/Search Surface/Triangulation Surface/Repair Surface/Model Surface/Openings Surface/Inspection
  Domain
  Octree/Tree Octree/Sizing
  Dual/Mesh Dual/Grid Dual/Leaf Dual/Zones Dual/Displacement Dual/Vertices Dual/Hexahedra
  Layer Audit
  Quality/Faces Quality/Checks Quality/Unions
  Optimize/Kernel Optimize/Constraints Optimize/AnyMesh
  Mesher/Improvement Mesher/Blocks Mesher
  Ranks)
earlier=
for room in "${rooms[@]}"; do
  earlier+="${earlier:+|}$room"
  mapfile -t files < <(find "Filters/Core/$room" -maxdepth 1 -name '*.h' -o -maxdepth 1 -name '*.cxx')
  found=$(grep -nE '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' "${files[@]}" | grep -vE "\"($earlier)/[^/\"]*\"" || true)
  if [ -n "$found" ]; then
    printf 'Filters/Core/%s must not include rooms after it:\n%s\n' "$room" "$found" >&2
    status=1
  fi
done
unknown=$(find Filters/Core -name '*.h' -printf '%P\n' | sed 's|/[^/]*$||' | sort -u | grep -vxE "$earlier" || true)
if [ -n "$unknown" ]; then
  printf 'Folders of the core that have no place in the order of rooms:\n%s\n' "$unknown" >&2
  status=1
fi

# Two types of one name in a namespace are undefined behavior, which no compiler reports.
twice=$(find Filters IO -name '*.h' -exec awk '
  /^namespace [a-z]/ { namespace = $2 }
  /^(struct|class) [A-Za-z]+( final)?( :.*)?$/ { print namespace "::" $2 }' {} + | sort | uniq -d)
if [ -n "$twice" ]; then
  printf 'Types that two headers define:\n%s\n' "$twice" >&2
  status=1
fi

# Messages name properties; the command line puts its options in their place.
options=$(grep -rnE --include='*.h' --include='*.cxx' '"([^"]*[^-A-Za-z0-9"])?--[a-z]' Filters IO || true)
if [ -n "$options" ]; then
  printf 'Messages that name options of the command line:\n%s\n' "$options" >&2
  status=1
fi
exit "$status"
