# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of a case that has run and has the friction on its walls: lengths of reversed flow, speeds at the places
of the reference, the drag."""

import math

import make_building
import numpy
import reference
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkCellCenters, vtkCellDataToPointData

B, H = make_building.WIDTH, make_building.HEIGHT
DENSITY = 1.225  # of the forces that the case measures, kg/m3
BESIDE = 1e-4 * B  # places in the middle plane are this far within the mesh


def end_of_reversed_flow(places, along):
    """Where flow turns from backward to forward for the last time, linear between places; None where none is backward,
    infinity where the last is."""
    backward = numpy.flatnonzero(numpy.asarray(along) < 0)
    if not len(backward):
        return None
    i = backward[-1]
    if i + 1 == len(places):
        return math.inf
    return float(places[i] + (places[i + 1] - places[i]) * along[i] / (along[i] - along[i + 1]))


def friction_in_middle(patch):
    """Centers of a patch's faces that touch the middle plane, sorted along the wind, and its friction on them."""
    centers = vtkCellCenters()
    centers.SetInputData(patch)
    centers.Update()
    at = vtk_to_numpy(centers.GetOutput().GetPoints().GetData()).astype(float)
    touching = [i for i in range(patch.GetNumberOfCells()) if patch.GetCell(i).GetBounds()[2] < BESIDE]
    order = sorted(touching, key=lambda i: at[i, 0])
    # OpenFOAM's is what the wall does to the air.
    return at[order], -vtk_to_numpy(patch.GetCellData().GetArray("wallShearStress"))[order, 0]


def reversed_lengths(patches):
    """On the roof and behind the building, in widths."""
    at, along = friction_in_middle(patches["Building"])
    roof = at[:, 2] > H - BESIDE
    at_ground, along_ground = friction_in_middle(patches["Ground"])
    behind = at_ground[:, 0] > B / 2
    on_roof = end_of_reversed_flow(at[roof, 0] / B + 0.5, along[roof])
    return on_roof, end_of_reversed_flow(at_ground[behind, 0] / B - 0.5, along_ground[behind])


def speeds_at(mesh, places):
    """U/U_H at places in widths. Points have means of the elements about them: what the reader gives points is 0 on walls,
    which no wall function means."""
    from atria.report.fields import probe

    means = vtkCellDataToPointData()
    mesh.GetPointData().Initialize()
    means.SetInputData(mesh)
    means.Update()
    places = numpy.maximum(numpy.asarray(places) * B, [-math.inf, BESIDE, 0.0])
    return probe(means.GetOutput(), places, "U")[:, 0] / reference.SPEED


def profiles(mesh):
    """U/U_H by plane and x/b, at the places of the reference."""
    middle = {x: speeds_at(mesh, [(x, 0.0, z) for z in reference.HEIGHTS]).tolist() for x in reference.MIDDLE}
    near_ground = {x: speeds_at(mesh, [(x, y, 0.125) for y in reference.SIDES]).tolist() for x in reference.NEAR_GROUND}
    return {"middle": middle, "near_ground": near_ground}


def wind_at_building(mesh):
    """U/U_H over the middle of where the building would be, at the heights of the measured inflow within the domain."""
    return speeds_at(mesh, [(0.0, 0.0, height) for height, _, _ in reference.INFLOW[:-1]]).tolist()


def measure_building(flow, fields):
    roof, wake = reversed_lengths(fields.patches)
    drag = flow.forces[0].times_factor(1.0 / (0.5 * DENSITY * reference.SPEED**2 * 0.5 * B * H))
    return {"roof": roof, "wake": wake, "drag": float(drag.values[-1]), "drift": drag.drift() / drag.last(),
            "profiles": profiles(fields.mesh)}


def measure(case):
    from atria.report import Case
    from atria.report.fields import Fields

    described = Case(case)
    flow, fields = described.runs[0], Fields(case)
    with_building = "Building" in fields.patches
    found = measure_building(flow, fields) if with_building else {"wind": wind_at_building(fields.mesh)}
    return {
        "cells": described.mesh["cells"],
        "worst_non_orthogonality": described.mesh["worst_non_orthogonality"],
        "failed_checks": described.mesh["failed_checks"],
        "iterations": int(flow.log.residuals["p"].times[-1]),
        "residuals": {field: history.last() for field, history in flow.log.residuals.items()},
        "solve_seconds": flow.log.seconds,
        "y_plus": flow.y_plus,
        **found,
    }
