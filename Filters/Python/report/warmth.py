# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run with warm air says: temperatures, where heat comes in and leaves, and whether a steady run converged."""

from __future__ import annotations

import numpy

from . import results
from .results import History
from .writing import amount, number, percent

# A steady run has not converged if residuals of the velocity stay above the first while flows swing by more than the second, or
# if heat differs by more than the third.
HIGH_RESIDUAL = 1e-2
MOST_SWING = 0.05
MOST_IMBALANCE = 0.05
# Density is linear in the temperature, which holds up to this difference from outdoors, K: a tenth of the density.
MOST_DIFFERENCE = 30.0


def swing(history: History) -> float:
    """Half of the range over the last fifth, relative to the mean; 0 where nothing flows."""
    first, last = history.times[0], history.times[-1]
    part = history.values[history.times >= last - 0.2 * (last - first)]
    mean = abs(float(part.mean()))
    return 0.5 * float(part.max() - part.min()) / mean if mean > 0 else 0.0


class Warmth:
    """Temperatures are in degrees Celsius. Heat is in W, relative to the air outdoors.

    openings     heat through face zones along their normals, by name, as History
    out          heat out of the domain through patches that air passes
    surfaces     heat that surfaces with a given temperature give to the air
    sources      heat that cell zones and surfaces were given, by name
    rooms        mean temperatures of cell zones
    walls        mean temperatures of surfaces with given heat
    everywhere   mean temperature of all air
    """

    def __init__(self, folder, described, flows, openings, rooms):
        self._folder = folder / "postProcessing"
        self.outdoors = float(described["outdoor_temperature"])
        self.duration = float(described["duration"])
        self._capacity = float(described["heat_capacity"])
        self._diffusivities = [float(value) for value in described["diffusivities"]]
        self.sources = {name: float(watts) for key in ("zones", "surfaces") for name, watts in described[key].items()}
        self.given = {name: float(celsius) for name, celsius in described["temperatures"].items()}
        self.openings = self._known({name: self._through_opening(name) for name in openings})
        self.out = self._known({name: self._out_of_domain(name, flow) for name, flow in flows.items()})
        self.surfaces = self._known({name: self._of_surface(name) for name in self.given})
        self.rooms = self._known({name: self._column("meanT_" + name, "volFieldValue.dat") for name in rooms})
        self.walls = self._known({name: self._column("temperature_" + name) for name in described["surfaces"]})
        self.everywhere = self._column("meanT", "volFieldValue.dat")

    @staticmethod
    def _known(found):
        return {name: history for name, history in found.items() if history is not None}

    def _columns(self, function, count, name="surfaceFieldValue.dat"):
        return results.read_columns(self._folder / function, name, count)

    def _column(self, function, name="surfaceFieldValue.dat"):
        columns = self._columns(function, 1, name)
        return columns[0] if columns else None

    def _combined(self, columns, value):
        """A function of the values of several columns, which are measured together; None without them."""
        if not columns or any(column is None for column in columns):
            return None
        length = min(len(column.times) for column in columns)
        return History(columns[0].times[:length], value(*(column.values[:length] for column in columns)))

    def _through_opening(self, name):
        """Flows of interpolated velocities are a little smaller than those of the solver, and are scaled to these."""
        here, both = self._columns("heat_" + name, 2), self._columns("heatBothWays_" + name, 2)

        def heat(flow, carried, solved, interpolated):
            ratio = numpy.divide(solved, interpolated, out=numpy.ones_like(solved), where=interpolated > 0)
            return self._capacity * (carried - self.outdoors * flow) * ratio

        return self._combined([*here, *both], heat) if len(here) == len(both) == 2 else None

    def _out_of_domain(self, name, flow):
        return self._combined([self._column("heat_" + name), flow],
                              lambda carried, passing: self._capacity * (carried - self.outdoors * passing))

    def _of_surface(self, name):
        still, eddies = self._diffusivities
        return self._combined([self._column("heat_" + name), self._column("heatByEddies_" + name)],
                              lambda gradient, turbulent: self._capacity * (still * gradient + eddies * turbulent))

    def heat_in(self):
        """Of all sources and surfaces, W."""
        return sum(self.sources.values()) + sum(heat.last() for heat in self.surfaces.values())

    def heat_out(self):
        """Out of the domain, W; None where not measured."""
        return sum(heat.last() for heat in self.out.values()) if self.out else None

    def imbalance(self):
        """Heat out less heat in, relative to all heat that sources and surfaces give or take; None where not measured."""
        whole = sum(abs(watts) for watts in self.sources.values()) + sum(abs(heat.last()) for heat in self.surfaces.values())
        out = self.heat_out()
        # Where only incoming air is warm or cold, its heat is the measure.
        whole = whole or sum(max(-heat.last(), 0.0) for heat in self.out.values())
        return (out - self.heat_in()) / whole if out is not None and whole > 0 else None

    def _both_ways(self):
        out, into = self.heat_out(), self.heat_in()
        return f"{amount(out, into)} W leave, and {number(into, 4)} W come in"

    def unconverged(self, residuals, flows):
        """Why a steady run has not converged, in words; empty where it has, and for a transient run.

        `residuals` and `flows` are histories by name.
        """
        if self.duration > 0:
            return []
        reasons = []
        high = max((history.last() for field, history in residuals.items() if field.startswith("U")), default=0.0)
        swings = {name: swing(flow) for name, flow in flows.items()}
        widest = max(swings, key=swings.get, default=None)
        if high > HIGH_RESIDUAL and widest is not None and swings[widest] > MOST_SWING:
            reasons.append(f"residuals of the velocity stay at {high:.2g} and the flow through {widest} swings by "
                           f"±{percent(swings[widest])}")
        missing = self.imbalance()
        if missing is not None and abs(missing) > MOST_IMBALANCE:
            reasons.append(self._both_ways())
        return reasons

    def beyond_boussinesq(self):
        """Rooms and surfaces whose air is so warm or cold that density is no longer linear in the temperature, in words."""
        means = self.rooms | {f"the surface {name}": celsius for name, celsius in self.walls.items()}
        if not self.rooms and self.everywhere:
            means["all air"] = self.everywhere
        far = {name: mean.last() for name, mean in means.items() if abs(mean.last() - self.outdoors) > MOST_DIFFERENCE}
        if not far:
            return []
        listed = ", ".join(f"{name} with {celsius:.4g} °C" for name, celsius in far.items())
        return [f"temperatures are beyond what the equations hold for: {listed}, and {self.outdoors:g} °C outdoors. Density is taken as "
                f"linear in the temperature (Boussinesq), which holds for {MOST_DIFFERENCE:g} K, where it differs by a tenth. Flows "
                "are a rough guess: give less heat or let more air through"]

    def doubts(self, residuals, flows):
        """What not to believe, in words."""
        found = []
        if reasons := self.unconverged(residuals, flows):
            found.append(f"the steady run has not converged: {'; '.join(reasons)}. Run more iterations; if that does not help, the "
                         "flow is not steady: make a transient case, such as atria case --transient 600")
        missing = self.imbalance()
        if self.duration > 0 and missing is not None and abs(missing) > MOST_IMBALANCE:
            found.append(f"{self._both_ways()}: the air still warms up or cools down, "
                         f"or its flow varies. {results.longer(True)}")
        return found
