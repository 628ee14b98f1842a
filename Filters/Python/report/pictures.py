# SPDX-License-Identifier: GPL-3.0-or-later
"""Which pictures of a run a page shows: sections at the height of openings and along the wind, and one in space."""

from __future__ import annotations

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from . import charts, scene, speeds
from .fields import LevelView, PlanView, Section, appended

MOST_LEVELS = 3
# How far pictures show what is about the walls, in heights of the walls.
MARGIN = 1.5
# An opening is upright where it is higher than this, meters; hatches in floors are flat.
_UPRIGHT = 0.1


def box_of(surfaces):
    """x0, x1, y0, y1, z0, z1 about all."""
    boxes = numpy.array([surface.GetBounds() for surface in surfaces])
    return tuple(float(boxes[:, i].min() if i % 2 == 0 else boxes[:, i].max()) for i in range(6))


def walls_of(run, fields):
    return [fields.patches[name] for name in run.patches_of("wall", "rough", "roughWall") if name in fields.patches]


def surroundings(run, fields, domain):
    """x0, x1, y0, y1 about the walls, within the domain; all of it where there are no walls."""
    walls = walls_of(run, fields)
    if not walls:
        return domain[:4]
    box = box_of(walls)
    margin = MARGIN * (box[5] - box[4])
    return (max(domain[0], box[0] - margin), min(domain[1], box[1] + margin),
            max(domain[2], box[2] - margin), min(domain[3], box[3] + margin))


def plan(run, fields, case):
    """The places above the ground whose speeds tell comfort; without a ground those above the lowest place, as in rooms."""
    ground = [fields.patches[name] for name in run.patches_of("ground") if name in fields.patches]
    if not ground:
        low, high = case.mesh["bounds"][4:]
        height = low + min(case.pedestrian_height, 0.5 * (high - low))
        return LevelView(surroundings(run, fields, case.mesh["bounds"]), height)
    return PlanView(ground, surroundings(run, fields, case.mesh["bounds"]), case.pedestrian_height)


def levels(heights):
    """The fewest heights that cut all openings, from the lowest: each of `heights` is where one begins and ends."""
    left = sorted(heights, key=lambda ends: ends[1])
    found = []
    while left:
        top = left[0][1]
        cut = [ends for ends in left if ends[0] < top]  # what a height just below the lowest of tops cuts
        found.append(0.5 * (max(low for low, _ in cut) + top))
        left = [ends for ends in left if ends[0] >= top]
    return found


def _openings(run, fields):
    return [fields.face_zones[o.name] for o in run.openings if o.name in fields.face_zones and o.rooms[0] != o.rooms[1]]


def fastest_near(run, fields, case):
    """The speed at the end of the scale: what is exceeded in a hundredth of the space about the walls, up to their top, or in calm
    air of the rooms."""
    walls = walls_of(run, fields)
    rooms = case.volumes if case.described.get("calm") and walls else ()
    x0, x1, y0, y1 = box_of(walls)[:4] if rooms else surroundings(run, fields, case.mesh["bounds"])
    z0, z1 = box_of(walls)[4:] if walls else case.mesh["bounds"][4:]
    heights = z0 + (numpy.arange(4) + 0.5) / 4 * (z1 - z0)
    sections = [Section((x0, y0, z), (1, 0, 0), (0, 1, 0), (x1 - x0, y1 - y0), columns=60) for z in heights]
    found = [numpy.linalg.norm(section.sample(fields.mesh, fields.velocity), axis=1) for section in sections]
    found = numpy.concatenate(found)
    inside = numpy.concatenate([fields.inside(rooms, section.places) for section in sections]) & ~numpy.isnan(found)
    return float(numpy.nanpercentile(found[inside] if inside.any() else found, 99.0))


def speed_plot(section, fields, walls, high, arrows=True):
    """A section with its speeds, walls and directions."""
    speed = numpy.linalg.norm(section.sample(fields.mesh, fields.velocity), axis=1)
    colors = charts.colored(section.image(speed), 0.0, high)
    return charts.plot(colors, section.lines(walls) if walls else (),
                       section.arrows(fields.mesh, fields.velocity) if arrows else ())


def temperature_plot(section, fields, walls, low, high):
    """A section with its temperatures, walls and directions."""
    colors = charts.colored(section.image(section.sample(fields.mesh, "T")), low, high)
    return charts.plot(colors, section.lines(walls) if walls else (), section.arrows(fields.mesh, fields.velocity))


def level_sections(run, fields):
    """Level sections through rooms that cut all upright openings, from the lowest."""
    openings = _openings(run, fields)
    if not openings or not walls_of(run, fields):
        return
    rooms = box_of(openings)
    margin = 0.35 * max(rooms[1] - rooms[0], rooms[3] - rooms[2])
    size = (rooms[1] - rooms[0] + 2 * margin, rooms[3] - rooms[2] + 2 * margin)
    heights = [ends for ends in (zone.GetBounds()[4:] for zone in openings) if ends[1] - ends[0] > _UPRIGHT]
    for height in levels(heights)[:MOST_LEVELS]:
        yield Section((rooms[0] - margin, rooms[2] - margin, height), (1, 0, 0), (0, 1, 0), size)


def level_plots(run, fields, high):
    return [charts.figure(speed_plot(section, fields, walls_of(run, fields), high),
                          f"speed at {section.corner[2]:.3g} m, through the openings") for section in level_sections(run, fields)]


def _largest(run, fields):
    """What an upright section goes through: the largest opening to the outside, in a room the inlet with most air; its name
    and surface, or None."""
    if run.case.is_room:
        name = max(run.inlets(), key=lambda inlet: numpy.linalg.norm(speeds.driven(fields.patches[inlet])), default=None)
        return (name, fields.patches[name]) if name else None
    to_outside = [o for o in run.openings if "outside" in o.rooms and o.name in fields.face_zones]
    largest = max(to_outside, key=lambda o: o.area, default=None)
    return (largest.name, fields.face_zones[largest.name]) if largest else None


def ends_within(bounds, place, way):
    """Where a level line through a place begins and ends in a box: distances along its way, from the origin."""
    ends = []
    for axis in (0, 1):
        if abs(way[axis]) > 1e-9:
            ends.append(sorted((bounds[2 * axis + i] - place[axis]) / way[axis] for i in (0, 1)))
    at = float(place @ way)
    return at + max(end[0] for end in ends), at + min(end[1] for end in ends)


def _across(bounds):
    """The way through an upright opening with these bounds, along x or y."""
    return numpy.array([1.0, 0.0, 0.0] if bounds[1] - bounds[0] <= bounds[3] - bounds[2] else [0.0, 1.0, 0.0])


def _upright_section(run, fields, case, walls):
    """The section along the wind, along the air from a room's inlets, or in calm air across an opening, and what it goes through."""
    largest = _largest(run, fields)
    rooms = _openings(run, fields) if case.described.get("calm") and largest else ()  # in calm air nothing else is of interest
    way = _across(largest[1].GetBounds()) if rooms else run.way
    place = box_of([largest[1]] if largest else walls)
    middle = numpy.array([(place[0] + place[1]) / 2, (place[2] + place[3]) / 2, 0.0])
    box, margin = box_of(walls), 0.0 if case.is_room else MARGIN
    level = box_of(rooms)[:4] if rooms else box[:4]
    corners = numpy.array([(x, y, 0.0) for x in level[:2] for y in level[2:]]) @ way
    height = box[5] - box[4]
    begin, end = ends_within(case.mesh["bounds"], middle, way)
    first = max(corners.min() - margin * height, begin)
    last = min(corners.max() + (1.0 if rooms else 2.0) * margin * height, end)
    corner = middle + (first - middle @ way) * way
    corner[2] = case.mesh["bounds"][4]
    top = min(box[5] + margin * height, case.mesh["bounds"][5])
    section = Section(corner, way, (0, 0, 1), (last - first, top - corner[2]))
    along = "along the wind" if case.has_wind else "along the air from the inlets" if run.inlets() else "upright"
    return section, f"{along}, through " + (largest[0] if largest else "the middle of the walls")


def wind_plot(run, fields, case, high):
    """The upright section along the wind, or along the air from a room's inlets."""
    walls = walls_of(run, fields)
    if not walls:
        return []
    section, where = _upright_section(run, fields, case, walls)
    return [charts.figure(speed_plot(section, fields, walls, high), f"speed {where}")]


def temperature_section(run, fields, case):
    """The upright section with its temperatures as SVG, the ends of its scale, °C, and what it goes through; None without warm air."""
    walls = walls_of(run, fields)
    if not walls or not run.warmth or not fields.mesh.GetCellData().HasArray("T"):
        return None
    section, where = _upright_section(run, fields, case, walls)
    found = section.sample(fields.mesh, "T")
    low, high = (float(numpy.nanpercentile(found, share)) for share in (0.5, 99.5))
    return temperature_plot(section, fields, walls, low, high), low, high, where


def temperatures(run, fields, case):
    """The upright section with its temperatures, and their scale."""
    drawn = temperature_section(run, fields, case)
    if drawn is None:
        return []
    picture, low, high, where = drawn
    return ['<div class="row">', charts.figure(picture, f"temperature {where}"), "</div>",
            charts.color_bar(low, high, "°C; arrows are the flow in the section")]


def _named(surfaces, array):
    """One surface of many, with one array of its cells."""
    whole = appended(surfaces)
    kept = vtkPolyData()
    kept.CopyStructure(whole)
    if whole.GetCellData().HasArray(array):
        kept.GetCellData().AddArray(whole.GetCellData().GetArray(array))
    return kept


def _ground_about(run, fields, box):
    """The part of the ground that the picture shows, as a rectangle at its height where it is flat, else all of it."""
    from vtkmodules.vtkFiltersSources import vtkPlaneSource

    ground = [fields.patches[name] for name in run.patches_of("ground") if name in fields.patches]
    if not ground or box_of(ground)[5] - box_of(ground)[4] > 1e-3:
        return _named(ground, "p")
    z, reach = box_of(ground)[4], max(box[1] - box[0], box[3] - box[2])
    plane = vtkPlaneSource()
    plane.SetOrigin(box[0] - reach, box[2] - reach, z)
    plane.SetPoint1(box[1] + reach, box[2] - reach, z)
    plane.SetPoint2(box[0] - reach, box[3] + reach, z)
    plane.Update()
    return plane.GetOutput()


def in_space(run, fields, high):
    """Walls by pressure with the paths of air through openings, or past the walls; None where it cannot be drawn. For rooms
    it shows nothing: their walls are seen from outside."""
    walls, openings = walls_of(run, fields), _openings(run, fields)
    if not walls:
        return None
    way = run.way
    box = box_of(openings or walls)
    reach = max(box[1] - box[0], box[3] - box[2], 1.5 * (box[5] - box[4]))
    seeds = scene.seeds_in(openings) if openings else scene.seeds_before(box, way)
    lines = scene.paths(fields.mesh, seeds, fields.velocity, 3.0 * reach)
    surface = _named(walls, "p")
    pressure = vtk_to_numpy(surface.GetCellData().GetArray("p"))
    most = float(numpy.percentile(numpy.abs(pressure), 98.0)) or 1.0
    middle = numpy.array([(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2])
    side = numpy.array([-way[1], way[0], 0.0])
    eye = middle + reach * (-2.4 * way - 1.3 * side + numpy.array([0.0, 0.0, 1.5]))
    camera = {"from": eye.tolist(), "to": middle.tolist(), "reach": reach}
    return scene.draw(surface, _ground_about(run, fields, box), lines, camera, {"pressure": (-most, most), "speed": high})
