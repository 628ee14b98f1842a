# SPDX-License-Identifier: GPL-3.0-or-later
"""Atria's filters: conformal adaptive hexahedral-dominant meshes of architecture.

    import atria
    result = atria.mesh("house.wrl", size=1.0, layers=5)
    result.save("case")  # for OpenFOAM

The classes connect to those of `vtk` and `vtkmodules` as any VTK filters do. An error that they, or algorithms that
feed them, report while a method of theirs runs is raised as `atria.Error` when the method returns, and not printed.
Where a class of VTK runs them, as a writer does, use `atria.raising`.
"""

from . import vtk_check

# The modules of the base classes must be there before the classes derived from them.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel
import vtkmodules.vtkIOCore

from .AtriaFiltersMeshing import *
from .AtriaFiltersQuality import *
from .AtriaIOCFD import *
from .AtriaIOClimate import *
from .AtriaIOSurface import *
from .AtriaIOVRML import *  # derived from classes of the one before
from .AtriaIOModel import *

from ._version import __version__
from .errors import Error, raising, raising_class as _raising_class
from .meshing import ModelWarning, Result, mesh


def _can_be_made(cls):
    try:
        return cls() is not None
    except (NotImplementedError, TypeError):
        return False


def _replace_classes():
    """Classes that raise Error take the place of those that can be made; abstract bases stay."""
    classes = {name: cls for name, cls in globals().items() if name.startswith("vtkAtria")}
    for name, cls in classes.items():
        if _can_be_made(cls):
            globals()[name] = _raising_class(cls)


_replace_classes()

__all__ = ["Error", "ModelWarning", "Result", "mesh", "raising", *(name for name in globals() if name.startswith("vtkAtria"))]
