# SPDX-License-Identifier: GPL-3.0-or-later
"""Atria's filters: conformal adaptive hexahedral-dominant meshes of architecture.

The classes connect to those of `vtk` and `vtkmodules` as any VTK filters do.
"""

# The modules of the base classes must be there before the classes derived from them.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel
import vtkmodules.vtkIOCore

from .AtriaFiltersMeshing import *
from .AtriaFiltersQuality import *
from .AtriaIOCFD import *
from .AtriaIOSurface import *
from .AtriaIOVRML import *  # derived from classes of the one before
from .AtriaIOModel import *

__all__ = [name for name in globals() if name.startswith("vtkAtria")]
