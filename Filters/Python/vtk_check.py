# SPDX-License-Identifier: GPL-3.0-or-later
"""Refuses to be imported with another VTK than the package is built for: the first object made would crash."""

import vtkmodules
from vtkmodules.vtkCommonCore import vtkVersion

from ._version import vtk_version

_found = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion())
if _found != vtk_version:
    raise ImportError("this atria is built for VTK {}.{}, but Python found VTK {}.{} in {}; use the Python and the VTK that "
                      "it is built for".format(*vtk_version, *_found, vtkmodules.__path__[0]))
