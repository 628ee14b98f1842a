# SPDX-License-Identifier: GPL-3.0-or-later
"""Screens and fans: how the pressure changes there, and how it should by their resistance or curve."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy

AIR_DENSITY = 1.225  # kg/m3, as cases have it


@dataclass(frozen=True)
class Screen:
    """A face zone where the pressure jumps."""

    zone: str
    words: str
    resistance: float = 0.0  # loss coefficient
    linear: float = 0.0  # Pa for each m/s
    curve: tuple = ()  # of a fan: flow rate, m3/s, and pressure, Pa
    blows_back: bool = False  # the fan blows against the zone's normal

    def rise(self, flow, area):
        """Rise of the pressure along the zone's normal for a flow along it, m3/s and square meters; Pa."""
        if self.curve:
            back = -1.0 if self.blows_back else 1.0
            return back * float(numpy.interp(back * flow, *zip(*self.curve)))
        speed = flow / area
        return -(0.5 * self.resistance * AIR_DENSITY * abs(speed) + self.linear) * speed

    def measured_rise(self, fields):
        """The same by the last pressures on its two sides; None without them."""
        sides = [fields.mean_over_patch(f"{self.zone}_side{number}", "p") for number in (1, 2)]
        if None in sides:
            return None
        return AIR_DENSITY * (sides[1] - sides[0]) * (-1.0 if self.blows_back else 1.0)


def _fan_words(curve):
    pressures = [pressure for _, pressure in curve]
    low, high = min(pressures), max(pressures)
    return f"fan, {high:.3g} Pa" if low == high else f"fan, {low:.3g} to {high:.3g} Pa"


def _screen_words(resistance, linear):
    return f"screen, K = {resistance:.3g}" + (f", {linear:.3g} Pa s/m" if linear else "")


def screens_of(described):
    """Those of case.json."""
    found = []
    for screen in described.get("screens", []):
        resistance, linear = float(screen["resistance"]), float(screen["linear"])
        found.append(Screen(screen["zone"], _screen_words(resistance, linear), resistance, linear))
    for fan in described.get("fans", []):
        curve = tuple(map(tuple, fan["curve"]))
        found.append(Screen(fan["zone"], _fan_words(curve), curve=curve, blows_back=bool(fan["blows_back"])))
    return found


def rows(screens, openings, fields):
    """For each: name, words, flow, m3/s, mean speed, m/s, and rise of the pressure along the flow, Pa, measured and by its rule."""
    through = {opening.name: opening for opening in openings}
    for screen in screens:
        opening = through.get(screen.zone)
        if opening is None or opening.area <= 0.0:
            continue
        flow = opening.net.last()
        along = math.copysign(1.0, flow)
        measured = screen.measured_rise(fields) if fields else None
        yield (screen.zone, screen.words, abs(flow), abs(flow) / opening.area, None if measured is None else along * measured,
               along * screen.rise(flow, opening.area))
