# SPDX-License-Identifier: GPL-3.0-or-later
"""Speeds that no wind has: a solution that converged to nonsense, or is about to blow up."""

from __future__ import annotations

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from .fields import through

# Times the greatest speed at which air comes in. What speeds air up is pressure: where its coefficient is c, Bernoulli
# gives sqrt(1 - c) times the speed ahead. At corners of roofs, where suction is the largest, standards for wind loads
# have c = -2.5 to -3 on areas of a square meter, twice the speed; three times would take c = -8, which no building has.
# The speed that comes in is that at the domain's top, more than at the height of buildings. What the blockage adds (3 %
# in domains that follow the rules) is within the margin.
MOST = 3.0
FIELDS = ("U", "UMean")


def driven(patch):
    """The flow through a patch as a vector along its velocity, m/s times square meters."""
    if not patch.GetNumberOfCells() or not patch.GetCellData().HasArray("U"):
        return numpy.zeros(3)
    velocity, _, areas = through(patch)
    return velocity.T.astype(float) @ areas


def greatest(fields, name) -> float:
    """The greatest speed in cells, m/s; no number where one of them is none."""
    array = fields.mesh.GetCellData().GetArray(name)
    return float(numpy.linalg.norm(vtk_to_numpy(array), axis=1).max(initial=0.0))


def driving(fields, roles) -> float:
    """The greatest speed that conditions at the boundary give: of what comes in, or is drawn out, m/s."""
    greatest = 0.0
    for name, patch in fields.patches.items():
        role = roles.get(name)
        if role in ("slip", "constraint", None) or not patch.GetNumberOfCells() or not patch.GetCellData().HasArray("U"):
            continue
        velocity, outwards, areas = through(patch)
        if role == "outlet":  # its speeds are of the solution, but not their mean: what comes in goes out
            greatest = max(greatest, float(outwards @ areas / areas.sum()))
        else:
            greatest = max(greatest, float(numpy.linalg.norm(velocity[outwards < 0.0], axis=1).max(initial=0.0)))
    return greatest


def _place(mesh, cell):
    points = vtk_to_numpy(mesh.GetCell(cell).GetPoints().GetData())
    return "({})".format(", ".join(f"{x:.4g}" for x in points.mean(axis=0)))


def impossible(fields, roles, wind, warm=0.0) -> str | None:
    """What no wind has, in words; None where all is well. `roles` are those of patches, `wind` is the case's at the top, `warm`
    the speed of what rises by itself."""
    # The air may leave through all inlets, too, where it should come in.
    limit = MOST * max(driving(fields, roles) or wind, warm)
    found = None
    for name in FIELDS:
        array = fields.mesh.GetCellData().GetArray(name)
        if array is None:
            continue
        speeds = numpy.linalg.norm(vtk_to_numpy(array), axis=1)
        unknown = numpy.flatnonzero(~numpy.isfinite(speeds))
        if unknown.size:
            return f"{name} is no number in {unknown.size} cells, such as at {_place(fields.mesh, int(unknown[0]))}"
        fastest = int(speeds.argmax())
        if speeds[fastest] > limit and (found is None or speeds[fastest] > found[0]):
            found = float(speeds[fastest]), int((speeds > limit).sum()), fastest
    if found is None:
        return None
    speed, count, cell = found
    return (f"no wind has this speed: {speed:.3g} m/s at {_place(fields.mesh, cell)}, {MOST * speed / limit:.3g} times the "
            f"{limit / MOST:.3g} m/s at which air comes in (cells with more than {MOST:g} times as much: {count}). Nothing here is "
            "to be believed unless something much narrower than inlets and outlets lies there: look at the mesh at that place, "
            "and let it run longer if the speed still falls")
