# SPDX-License-Identifier: GPL-3.0-or-later
"""How the wind's profile changes on its way to the buildings: what the run of the domain without buildings says.

See Blocken, Stathopoulos and Carmeliet (2007), "CFD simulation of the atmospheric boundary layer: wall function
problems", Atmospheric Environment 41, 238-252.
"""

from __future__ import annotations

import pathlib
from dataclasses import dataclass

import numpy

from . import results

# Largest changes that cause no warning, percent.
MOST_OF_SPEED = 5.0
MOST_OF_K = 20.0


@dataclass(frozen=True)
class Change:
    """The largest change of a quantity between inlet and buildings, percent, and its height above the ground, meters."""

    percent: float
    height: float

    def __str__(self):
        return f"{self.percent:+.1f} % at {self.height:.3g} m"


def _last(folder, name, count):
    """Rows of the last time, one per place; None where the run did not get so far."""
    table = results.read_table(folder, name)
    if not table.size or (table.shape[1] - 1) % count or not numpy.isfinite(table[-1]).all():
        return None
    return table[-1, 1:].reshape(count, -1)


class Profile:
    """Speeds and turbulence over the height at the inlet and before the buildings. `described` is the entry of case.json."""

    def __init__(self, case_folder, described):
        self.folder = pathlib.Path(case_folder) / described["folder"]
        self.fetch, self.length = float(described["fetch"]), float(described["length"])
        self.height_of_interest = float(described["height_of_interest"])
        self.roughness = float(described["roughness_length"])
        self.first_center = float(described["first_center"])
        self.heights = numpy.asarray(described["heights"], float)
        self.speed = [self._speed(part) for part in ("inletProfile", "incidentProfile")]
        self.k = [self._read(part, "k") for part in ("inletProfile", "incidentProfile")]

    def _read(self, part, name):
        return _last(self.folder / "postProcessing" / part, name, len(self.heights))

    def _speed(self, part):
        velocity = self._read(part, "U")
        return None if velocity is None else numpy.linalg.norm(velocity, axis=1)

    @property
    def ran(self):
        return all(values is not None for values in self.speed + self.k)

    def _change(self, inlet, incident):
        below = self.heights <= max(self.height_of_interest, self.heights[0])
        percent = 100.0 * (numpy.ravel(incident) / numpy.ravel(inlet) - 1.0)[below]
        most = int(numpy.argmax(abs(percent)))
        return Change(float(percent[most]), float(self.heights[below][most]))

    def change_of_speed(self) -> Change:
        return self._change(*self.speed)

    def change_of_k(self) -> Change:
        return self._change(*self.k)

    def doubts(self):
        """Why the wind at the buildings is not the one at the inlet, in words."""
        if not self.ran:
            return [f"the wind's profile was not checked: run {self.folder / 'Allrun'}"]
        speed, k = self.change_of_speed(), self.change_of_k()
        if abs(speed.percent) <= MOST_OF_SPEED and abs(k.percent) <= MOST_OF_K:
            return []
        return [f"without buildings the wind changes on the {self.fetch:.3g} m before them: its speed by {speed}, its turbulence k "
                f"by {k}, below {self.height_of_interest:.3g} m. {self._advice()}"]

    def _advice(self):
        low = self.first_center < self.roughness
        cells = (f"The first cell centers, at {self.first_center:.3g} m, must be above the roughness length, {self.roughness:g} m: "
                 "make these cells higher. " if low else "")
        return cells + ("The inlet needs the roughness length of the ground before the buildings, and the top a condition that "
                        "drives the wind as the inlet's profile does. Longer cells are no cure; a shorter way to the buildings "
                        "is a makeshift")
