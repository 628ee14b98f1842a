# SPDX-License-Identifier: GPL-3.0-or-later
"""Wind comfort: how often the wind at a place is stronger than people like.

A climate is a list of sectors: where the wind comes from (degrees clockwise from north), the share of hours, and the
scale (m/s) and shape of the Weibull distribution of its hourly mean speeds at the reference height of a flow case. A
place is known by its amplification, the speed there over the reference speed, for each direction.
"""

from __future__ import annotations

import csv
import json
import math
import pathlib
from dataclasses import dataclass

import numpy

from ..errors import Error

# NEN 8100 (2006), table 2: percent of hours in which the hourly mean is above 5 m/s.
NEN_8100_SPEED = 5.0
NEN_8100_LIMITS = (2.5, 5.0, 10.0, 20.0)
NEN_8100_CLASSES = ("A", "B", "C", "D", "E")
# NEN 8100, danger: percent of hours above 15 m/s.
DANGER_SPEED = 15.0
DANGER_LIMITS = (0.05, 0.3)
DANGER_CLASSES = ("none", "limited risk", "dangerous")
# Lawson (2001), as for the London Docklands: speeds that are passed in 5 % of hours at most.
LAWSON_PERCENT = 5.0
LAWSON_SPEEDS = (4.0, 6.0, 8.0, 10.0)
LAWSON_CLASSES = ("sitting", "standing", "strolling", "walking", "uncomfortable")


@dataclass(frozen=True)
class Sector:
    origin: float  # degrees clockwise from north, where the wind comes from
    frequency: float  # share of hours, 0 to 1
    scale: float  # m/s
    shape: float


def _sector(row, where):
    values = []
    for key in ("from", "frequency", "scale", "shape"):
        try:
            values.append(float(row[key]))
        except (KeyError, TypeError, ValueError):
            raise Error(f"{where}: '{key}' is missing or no number; columns are from, frequency, scale, shape") from None
    if not (numpy.isfinite(values).all() and values[1] >= 0 and values[2] > 0 and values[3] > 0):
        raise Error(f"{where}: frequencies must not be negative, scale and shape must be more than 0")
    return Sector(*values)


def _check_not_weather(data, path):
    """EPW and TMY3 are known by their first lines, as `atria climate` knows them."""
    lines = [line for line in data[:2000].decode("latin-1").lower().removeprefix("ï»¿").splitlines() if line.strip()]
    if lines and lines[0].strip().startswith("location,") or len(lines) > 1 and "date (mm/dd/yyyy)" in lines[1]:
        raise Error(f"{path} is a weather file and no table of the wind: make the table of it first, by `atria climate`")


def _check_directions(sectors, path):
    """To a tenth of a degree, as `atria case` names its runs."""
    found = {}
    for number, sector in enumerate(sectors, 1):
        tenths = math.floor(10.0 * (sector.origin % 360.0) + 0.5) % 3600
        if tenths in found:
            raise Error(f"{path}, sector {number}: sector {found[tenths]} has the direction {tenths / 10:g}, too; "
                        "give each direction once")
        found[tenths] = number


def read_climate(file) -> list[Sector]:
    """Of a .csv table with the columns from, frequency, scale, shape, or a .json list of objects with these keys.

    Frequencies may be shares or percent: they must sum up to about 1 or 100. A direction stands once.
    """
    path = pathlib.Path(file)
    try:
        data = path.read_bytes()
        _check_not_weather(data, path)
        text = data.decode("utf-8-sig")
        rows = json.loads(text) if path.suffix == ".json" else list(csv.DictReader(text.splitlines(), skipinitialspace=True))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise Error(f"{path}: {error}") from None
    if not isinstance(rows, list) or not rows:
        raise Error(f"{path}: holds no sectors of wind")
    sectors = [_sector(row, f"{path}, sector {number}") for number, row in enumerate(rows, 1)]
    _check_directions(sectors, path)
    total = sum(sector.frequency for sector in sectors)
    whole = 100.0 if total > 10.0 else 1.0
    if abs(total / whole - 1.0) > 0.02:
        raise Error(f"{path}: frequencies sum up to {total:g} instead of 1 or 100")
    return [Sector(s.origin % 360.0, s.frequency / total, s.scale, s.shape) for s in sectors]


# Meters above the ground where the wind no longer feels what the ground there is like (NEN 8100).
BLENDING_HEIGHT = 60.0


def at_reference(climate, height, roughness, described) -> list[Sector]:
    """A climate measured at a station, at the reference height of a case (`described` as in case.json).

    Speeds follow logarithmic profiles over both roughness lengths, which agree at the blending height.
    """
    if not (height > roughness > 0):
        raise Error(f"the station's height, {height:g} m, must be above its roughness length, {roughness:g} m, and both above 0")
    there, z0 = described["reference_height"], described["roughness_length"]
    log = numpy.log
    up = log(BLENDING_HEIGHT / roughness) / log(height / roughness)
    factor = up * log((there + z0) / z0) / log((BLENDING_HEIGHT + z0) / z0)
    return [Sector(s.origin, s.frequency, float(s.scale * factor), s.shape) for s in climate]


def angle_between(a: float, b: float) -> float:
    """Degrees, 0 to 180."""
    return abs((a - b + 180.0) % 360.0 - 180.0)


# Degrees between a sector of the climate and the direction that stands for it: what is told, and what is refused.
FAR_APART = 15.0
MOST_APART = 45.0


def widest_gap(climate, directions) -> float:
    """The greatest angle between a sector that wind comes from and the direction next to it, degrees."""
    return max(min(angle_between(sector.origin, direction) for direction in directions)
               for sector in climate if sector.frequency > 0.0)


def exceedance(climate, directions, amplification, speed):
    """Percent of hours in which the hourly mean is above `speed`, m/s, for each place.

    amplification  an array with a row for each of `directions` (degrees, where the wind comes from) and a column for
                   each place; what is no number there is none in the result

    A sector of the climate takes the direction next to it.
    """
    amplification = numpy.asarray(amplification, dtype=float)
    total = numpy.zeros(amplification.shape[1])
    for sector in climate:
        nearest = min(range(len(directions)), key=lambda i: angle_between(directions[i], sector.origin))
        local = sector.scale * amplification[nearest]
        with numpy.errstate(divide="ignore", over="ignore"):
            total += sector.frequency * numpy.where(local == 0.0, 0.0, numpy.exp(-((speed / local) ** sector.shape)))
    return 100.0 * total


def _classes(values, limits):
    """The number of limits that are reached; -1 for what is no number."""
    values = numpy.asarray(values, dtype=float)
    return numpy.where(numpy.isnan(values), -1, numpy.searchsorted(limits, numpy.nan_to_num(values), side="right"))


def nen_8100(climate, directions, amplification):
    """For each place the index of its class in NEN_8100_CLASSES; -1 where nothing is known."""
    return _classes(exceedance(climate, directions, amplification, NEN_8100_SPEED), NEN_8100_LIMITS)


def danger(climate, directions, amplification):
    """For each place the index of its class in DANGER_CLASSES; -1 where nothing is known."""
    return _classes(exceedance(climate, directions, amplification, DANGER_SPEED), DANGER_LIMITS)


def lawson(climate, directions, amplification):
    """For each place the index of its class in LAWSON_CLASSES; -1 where nothing is known."""
    amplification = numpy.asarray(amplification, dtype=float)
    worst = numpy.zeros(amplification.shape[1], dtype=int)
    for speed in LAWSON_SPEEDS:
        worst += exceedance(climate, directions, amplification, speed) > LAWSON_PERCENT
    return numpy.where(numpy.isnan(amplification).any(axis=0), -1, worst)


def shares(classes, count, weights=None):
    """The share of places in each class, of those of which something is known."""
    classes = numpy.asarray(classes)
    weights = numpy.ones(len(classes)) if weights is None else numpy.asarray(weights)
    known = classes >= 0
    total = weights[known].sum()
    return [float(weights[classes == i].sum() / total) if total else 0.0 for i in range(count)]
