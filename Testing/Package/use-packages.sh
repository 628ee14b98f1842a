#!/usr/bin/env bash
# Uses what the Debian packages install, as a user would.
#
#   use-packages.sh vtk|paraview [PREFIX]   PREFIX: where they are unpacked, else they are installed
set -euo pipefail

prefix=${2:-}
examples=$prefix/usr/share/doc/atria-doc/examples
if [ -n "$prefix" ]; then
  libraries=$(echo "$prefix"/usr/lib/*-linux-gnu)
  export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} PYTHONPATH=$prefix/usr/lib/python3/dist-packages
  export CMAKE_PREFIX_PATH=$prefix/usr PATH=$prefix/usr/bin:$PATH
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

use_command_line() {
  cd "$work"
  local status=0
  atria mesh "$examples/Data/house.wrl" --size-max 16 --size-mid 4 --size-min 2 -o mesh.vtu --openfoam case || status=$?
  [ "$status" -eq 0 ] || [ "$status" -eq 4 ] # 4: some elements are not valid
  [ -s mesh.vtu ] && [ -s case/constant/polyMesh/faces ]
  # shellcheck disable=SC1091
  (. "$prefix/usr/share/bash-completion/completions/atria" && complete -p atria)
  gzip -dc "$prefix/usr/share/man/man1/atria.1.gz" | grep -q 'atria'
}

use_python() {
  /usr/bin/python3 - "$examples/Data/house.wrl" <<'PYTHON'
import importlib.metadata
import sys

import atria

result = atria.mesh(sys.argv[1], size=4.0)
assert result.mesh.GetNumberOfCells() > 1000 and result.patches, result
assert importlib.metadata.version("atria") == atria.__version__
PYTHON
}

use_development_files() {
  cmake -S "$examples/Cxx/ComposePipeline" -B "$work/cxx" -DCMAKE_BUILD_TYPE=Release
  cmake --build "$work/cxx"
  cd "$work"
  cxx/ComposePipeline "$examples/Data/house.wrl" cxx
}

use_plugin() {
  cat >"$work/use.py" <<'PYTHON'
import glob
import os
import sys

from paraview.simple import *

model = sys.argv[1]
prefix = os.environ["ATRIA_PREFIX"]
if prefix:
    LoadPlugin(glob.glob(prefix + "/usr/lib/*/paraview-*/plugins/Atria/Atria.so")[0], ns=globals())
# Else ParaView has found the plugin itself.
reader = AtriaVRMLReader(FileName=model)
mesher = AtriaDualMesher(Input=reader)
mesher.SizeMax, mesher.SizeMid, mesher.SizeMin = 16, 4, 2
mesher.UpdatePipeline()
assert mesher.GetDataInformation().GetNumberOfCells() > 1000

import atria

assert atria.mesh(model, size=4.0).mesh.GetNumberOfCells() > 1000
PYTHON
  # Else Open MPI starts a daemon, which may outlive pvpython and keep a bare system from being removed.
  export OMPI_MCA_ess_singleton_isolated=1
  ATRIA_PREFIX=$prefix "${ATRIA_PVPYTHON:-pvpython}" "$work/use.py" "$examples/Data/house.wrl"
}

case ${1:-} in
  vtk)
    use_command_line
    use_python
    use_development_files
    ;;
  paraview) use_plugin ;;
  *)
    echo "usage: $0 vtk|paraview [PREFIX]" >&2
    exit 2
    ;;
esac
echo "used: $1"
