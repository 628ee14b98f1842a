# SPDX-License-Identifier: GPL-3.0-or-later
"""What warmth alone moves through the openings of a room, by the formula of openings between two bodies of air."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .case import OUTSIDE

DISCHARGE = 0.6
_GRAVITY = 9.81
_KELVIN = 273.15
# Halvings of the range in which the neutral level lies.
_STEPS = 60


@dataclass(frozen=True)
class Portal:
    """An opening to the outside: area, m2, heights of its lower and upper end, m, and the loss coefficient of its screen."""

    area: float
    low: float
    high: float
    resistance: float = 0.0

    def reach(self, level):
        """Integrals over the area of the root of the height above a level and below it, discharge included."""
        discharge = 1.0 / math.sqrt(DISCHARGE**-2 + self.resistance)
        height = self.high - self.low
        if height <= 1e-6 * abs(self.high - level):
            sides = [math.sqrt(max(side, 0.0)) for side in (self.high - level, level - self.low)]
        else:
            sides = [2.0 / 3.0 * (max(top, 0.0) ** 1.5 - max(bottom, 0.0) ** 1.5) / height
                     for top, bottom in ((self.high - level, self.low - level), (level - self.low, level - self.high))]
        return [discharge * self.area * side for side in sides]


def flow(portals, warmer, outdoors) -> float:
    """Air that comes in through openings, m3/s, into air that is warmer by `warmer` K than the `outdoors` °C.

    As much leaves: the neutral level is where both agree. Density is linear in the temperature, as in cases.
    """
    low, high = min(portal.low for portal in portals), max(portal.high for portal in portals)
    for _ in range(_STEPS):
        level = 0.5 * (low + high)
        above, below = (sum(sides) for sides in zip(*(portal.reach(level) for portal in portals)))
        low, high = (level, high) if above > below else (low, level)
    return math.sqrt(2.0 * _GRAVITY * abs(warmer) / (outdoors + _KELVIN)) * 0.5 * (above + below)


def rest(whole, warm):
    """What is left of a flow without warmth: flows of several causes add up as squares."""
    return math.sqrt(max(whole * whole - warm * warm, 0.0))


def portals_of(case, run, fields):
    """Openings to the outside of each room whose temperature is known, by the bounds of face zones."""
    losses = {screen.zone: screen.resistance for screen in case.screens}
    found = {}
    for opening in run.openings:
        zone = fields.face_zones.get(opening.name)
        room = next((room for room in opening.rooms if room != OUTSIDE), None)
        if OUTSIDE in opening.rooms and room in run.warmth.rooms and zone is not None and zone.GetNumberOfPoints():
            low, high = zone.GetBounds()[4:]
            found.setdefault(room, []).append(Portal(opening.area, low, high, losses.get(opening.name, 0.0)))
    return found
