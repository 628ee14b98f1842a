# SPDX-License-Identifier: GPL-3.0-or-later
"""A case that `atria case` wrote, with what its runs measured."""

from __future__ import annotations

import functools
import json
import math
import pathlib
from dataclasses import dataclass

import numpy

from ..errors import Error
from . import results, speeds
from .fields import Fields
from .profile import Profile
from .results import History
from .screens import screens_of
from .warmth import Warmth

OUTSIDE = "outside"
# As OpenFOAM's atmospheric conditions have it.
KAPPA = 0.41
# Wall functions of smooth walls hold up to here, roughly.
MOST_Y_PLUS = 300.0
# Speeds are nothing below this share of the reference speed, and flows below the same share of what it drives through the
# patches that let air in and out.
_NOTHING = 1e-6
# Plumes are this much faster close to their sources than the speed that a case says for the heat in all its height: a plume's
# speed goes with the cube root of the height, and its middle has some five times the scale.
PLUME = 10.0
# Where no place of a probe is, OpenFOAM writes a number larger than this.
_NOWHERE = 1e100


@dataclass(frozen=True)
class Judged:
    """A quantity that must have settled; its drift is compared with `scale`."""

    name: str
    history: History
    scale: float
    unit: str

    @property
    def verdict(self) -> str:
        return results.verdict(self.history, self.scale)


@dataclass(frozen=True)
class Direction:
    """Where the wind comes from (degrees clockwise from north) and blows to (counterclockwise from x), and what patches are.

    A room has one, without wind. `areas` are those of patches, square meters.
    """

    folder: str
    origin: float | None
    towards: float | None
    roles: dict[str, str]
    areas: dict[str, float]
    empty_domain: dict | None = None

    @classmethod
    def read(cls, entry):
        numbers = [None if entry.get(key) is None else float(entry[key]) for key in ("from", "towards")]
        return cls(entry["folder"], *numbers, dict(entry["patches"]), dict(entry.get("areas", {})),
                   entry.get("empty_domain"))


class Run:
    """One direction of the wind, or a room."""

    def __init__(self, case, direction):
        self.case = case
        self.folder = case.folder / direction.folder
        self.origin, self.towards, self.roles = direction.origin, direction.towards, direction.roles
        self.areas = direction.areas
        self.profile = Profile(self.folder, direction.empty_domain) if direction.empty_domain else None
        log = next((self.folder / name for name in ("log.simpleFoam", "log.pimpleFoam", "log.foamRun") if (self.folder / name).exists()), None)
        self.log = results.read_log(log) if log else None
        sides = [patch for patch, role in self.roles.items() if role in ("inlet", "outlet", "inletOutlet")]
        flows = {patch: results.read_flow(self.folder, "flow_" + patch) for patch in sides}
        self.flows = {patch: flow for patch, flow in flows.items() if flow is not None}
        self.carried = {scalar: self._read_carried(scalar) for scalar in case.scalars}
        self.openings = results.read_openings(self.folder, case.openings)
        warm = case.described.get("warm_air")
        self.warmth = Warmth(self.folder, warm, self.flows, [o.name for o in self.openings], case.volumes) if warm else None
        self.forces = results.read_columns(self.folder / "postProcessing" / "forces", "force.dat", 3)
        self.y_plus = results.read_y_plus(self.folder / "postProcessing" / "yPlus")

    def _read_carried(self, scalar):
        carried = {patch: results.read_flow(self.folder, f"flow_{scalar}_{patch}") for patch in self.flows}
        return {patch: flow for patch, flow in carried.items() if flow is not None}

    def concentration_at(self, scalar, patch):
        """Of the air that passes a patch, by what it carries; None where not measured, or where no air passes."""
        carried, flow = self.carried[scalar].get(patch), self.flows[patch].last()
        return carried.last() / flow + 0.0 if carried and flow else None  # no -0

    def mixed_concentration(self, scalar, outwards):
        """Of all air that leaves the domain, or of all that comes in."""
        patches = [patch for patch in self.carried[scalar] if (self.flows[patch].last() > 0.0) == outwards]
        whole = sum(self.flows[patch].last() for patch in patches)
        return sum(self.carried[scalar][patch].last() for patch in patches) / whole if whole else None

    def effectiveness(self, scalar, concentration):
        """Of a room's ventilation, where the air has a concentration: (exhaust - supply) / (room - supply). 1 is mixed air."""
        if not self.case.is_room:
            return None
        exhaust, supply = (self.mixed_concentration(scalar, outwards) for outwards in (True, False))
        if None in (exhaust, supply, concentration) or concentration == supply:
            return None
        return (exhaust - supply) / (concentration - supply)

    @property
    def title(self):
        return "room" if self.case.is_room else f"wind from {self.origin:g}°" if self.case.has_wind else "calm air"

    @property
    def ran(self):
        return self.log is not None and bool(self.log.residuals)

    @functools.cached_property
    def fields(self):
        """Of the last time; Error where there are none."""
        return Fields(self.folder)

    @functools.cached_property
    def way(self):
        """Where the wind blows to, or most of the air of a room's inlets; level, of length 1."""
        if self.case.has_wind:
            return numpy.array([math.cos(math.radians(self.towards)), math.sin(math.radians(self.towards)), 0.0])
        way = sum((speeds.driven(self.fields.patches[name]) for name in self.inlets()), numpy.zeros(3))
        way[2] = 0.0
        size = numpy.linalg.norm(way)
        return way / size if size > _NOTHING * self.case.speed else numpy.array([1.0, 0.0, 0.0])

    def inlets(self):
        """Inlets whose faces the fields have."""
        return [name for name in self.patches_of("inlet") if name in self.fields.patches]

    def patches_of(self, *roles):
        return [name for name, role in self.roles.items() if role in roles]

    def inflow(self, room):
        """Air that comes into a room, m3/s; None where nothing is measured."""
        into = results.inflow(room, self.openings)
        return into.last() if into else None

    def air_changes(self, room):
        """Of one room, per hour, as a History."""
        into = results.inflow(room, self.openings)
        return into.times_factor(3600.0 / self.case.volumes[room]) if into else None

    def all_air_changes(self):
        """Of all rooms that openings join, taken as one: with the air from outside alone."""
        into = results.inflow_from(OUTSIDE, self.openings)
        volume = sum(self.case.volumes[room] for room in self.case.ventilated)
        return into.times_factor(3600.0 / volume) if into and volume > 0 else None

    def supplied(self):
        """Air that comes into a room through its inlets and outlets, m3/s, as a History; None where nothing is measured."""
        flows = list(self.flows.values())
        return results.summed([results.inwards(flow) for flow in flows]) if self.case.is_room and flows else None

    def supplied_changes(self):
        """Of a room as a whole, per hour, as a History."""
        supplied, volume = self.supplied(), self.case.mesh.get("volume", 0.0)
        return supplied.times_factor(3600.0 / volume) if supplied and volume > 0 else None

    def unbalanced(self):
        """Rooms that do not lose as much air through their openings as they get: (room, share that is missing)."""
        for room in () if self.case.is_room else self.case.ventilated:  # inlets are no openings
            into, net = results.inflow(room, self.openings), results.net_inflow(room, self.openings)
            passing = max(into.last(), into.last() - net.last()) if into else 0.0
            if passing > 0 and abs(net.last()) / passing > results.NEARLY:
                yield room, abs(net.last()) / passing

    def speed(self):
        """Mean speed over the places at pedestrian height."""
        table = results.read_table(self.folder / "postProcessing" / "pedestrians", "U")
        if not table.size:
            return None
        velocities = table[:, 1:].reshape(len(table), -1, 3)
        there = (abs(velocities) < _NOWHERE).all(axis=(0, 2))
        speeds = numpy.linalg.norm(velocities[:, there], axis=2)
        return History(table[:, 0], speeds.mean(axis=1)) if there.any() else None

    def judged(self):
        """What must have settled, the answers first."""
        rows = []
        if (changes := self.supplied_changes()) is not None:
            rows.append(Judged("air changes", changes, changes.last(), "1/h"))
        if (whole := self.all_air_changes()) is not None:
            rows.append(Judged("air changes of the building", whole, whole.last(), "1/h"))
        for room in self.case.ventilated:
            if (changes := self.air_changes(room)) is not None:
                rows.append(Judged(f"air changes of {room}", changes, changes.last(), "1/h"))
        # An opening is judged by all that passes openings on average: where little passes, little depends on it.
        passing = [o.both.last() for o in self.openings]
        rows += [Judged(f"flow through {o.name}", o.net, sum(passing) / len(passing), "m³/s") for o in self.openings]
        incoming = sum(-flow.last() for flow in self.flows.values() if flow.last() < 0)
        rows += [Judged(f"flow through {name}", flow, incoming, "m³/s") for name, flow in self.flows.items()]
        size = max((abs(force.last()) for force in self.forces), default=0.0)
        rows += [Judged(f"force along {axis}", force, size, "N") for axis, force in zip("xyz", self.forces)]
        if self.warmth:
            rows += self._judged_warmth()
        if (speed := self.speed()) is not None:
            rows.append(Judged("speed at pedestrian height", speed, speed.last(), "m/s"))
        return rows

    def _judged_warmth(self):
        """Rooms and the heat that leaves, both against what sources make."""
        warmth = self.warmth
        rise = max((abs(mean.last() - warmth.outdoors) for mean in warmth.rooms.values()), default=0.0)
        yield from (Judged(f"temperature of {room}", mean, rise, "°C") for room, mean in warmth.rooms.items())
        if (out := results.summed(warmth.out.values())) is not None:
            yield Judged("heat out of the domain", out, max(abs(out.last()), abs(warmth.heat_in())), "W")

    def doubts_of_warmth(self):
        """What not to believe of a run with warm air, in words."""
        flows = {o.name: o.both for o in self.openings} or self.flows
        return self.warmth.doubts(self.log.residuals, flows) if self.warmth and self.ran else []

    def imbalance(self):
        """What is missing between the flows into the domain and out of it, relative; None where not measured."""
        return results.imbalance(flow.last() for flow in self.flows.values()) if self.flows else None

    def high_y_plus(self):
        """Averages on walls where wall functions no longer hold."""
        return [value for patch, value in self.y_plus.items() if value > MOST_Y_PLUS and self.roles.get(patch) == "wall"]

    def stillness(self):
        """That no air flows, in words; None where it does."""
        velocity = speeds.greatest(self.fields, "U")
        through = sum(self.areas.get(name, 0.0) for name in self.flows)
        most = max((abs(flow.last()) for flow in self.flows.values()), default=None)
        if velocity <= _NOTHING * self.case.speed:
            found = "nothing flows: the air is at rest everywhere"
        elif most is not None and most <= _NOTHING * self.case.speed * through:
            found = f"nothing flows through {', '.join(self.flows)}"
        else:
            return None
        inlets = self.patches_of("inlet")
        if self.case.is_room or not inlets:
            return f"{found}. Look at the conditions in {self.folder}/0/U, and at {self.log.file}"
        return (f"{found}. The wind enters at none of the inlets ({', '.join(inlets)}): turn it, or let an inlet blow by itself, "
                f"such as atria case --patch {inlets[0]} inlet:1m/s")

    def failures(self):
        """Why nothing of the run is to be believed, in words."""
        if not self.ran:
            return [f"no results: there is no log of a solver in {self.folder}; run its Allrun"]
        if any(not numpy.isfinite(h.values).all() for h in self.log.residuals.values()):
            return ["the run blew up: residuals are no numbers"]
        if still := self.stillness():
            return [still]
        found = speeds.impossible(self.fields, self.roles, self.case.top_speed, self.case.warm_speed)
        return [found] if found else []

    def doubts(self):
        """What has not settled or is missing, in words."""
        if not self.ran:
            return []
        found = [] if self.log.ended else [f"the run did not end: see {self.log.file}"]
        found += self.doubts_of_warmth()
        unsettled = [judged.name for judged in self.judged() if judged.verdict == results.UNSETTLED]
        if unsettled:
            found.append(f"not settled: {', '.join(unsettled)}. Run more iterations; if they go on to swing, the flow is not "
                         "steady, and the means of the last fifth are what there is")
        missing = self.imbalance()
        if missing is not None and missing > results.SETTLED:
            found.append(f"flows into the domain and out of it differ by {100 * missing:.2g} %")
        found += [f"{room}: the air that enters and leaves through its openings differs by {100 * share:.2g} %. The run has not "
                  "settled, or air passes where no opening is known" for room, share in self.unbalanced()]
        return found


class Case:
    """What case.json says, and its runs."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        file = self.folder / "case.json"
        try:
            self.described = json.loads(file.read_text(encoding="utf-8"))
        except OSError as error:
            raise Error(f"{file}: {error.strerror}; name a folder that `atria case` wrote") from None
        except ValueError as error:
            raise Error(f"{file}: {error}; make the case anew with `atria case`") from None
        try:
            self.openings = self.described["openings"]
            self.volumes = {room["name"]: float(room["volume"]) for room in self.described["rooms"]}
            self.mesh = self.described["mesh"]
            self.speed = float(self.described["reference_speed"])
            self.pedestrian_height = float(self.described["pedestrian_height"])
            directions = [Direction.read(entry) for entry in self.described["directions"]]
            self.scalars = [scalar["name"] for scalar in self.described.get("scalars", [])]
            self.screens = screens_of(self.described)
            self.is_room = self.described.get("kind", "wind") == "room"
            self.has_wind = self.described.get("kind", "wind") == "wind"
            if self.has_wind and any(direction.origin is None or direction.towards is None for direction in directions):
                raise KeyError("from, towards")
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise Error(f"{file}: {error!r} is missing or wrong; make the case anew with `atria case`") from None
        self.runs = [Run(self, direction) for direction in directions]

    @property
    def warm_speed(self):
        """Of air that rises close to sources of heat; 0 without any."""
        return PLUME * float(self.described["warm_air"]["speed"]) if "warm_air" in self.described else 0.0

    @property
    def top_speed(self):
        """Of the wind at the domain's top, of the air from a room's inlets, or of what heat moves."""
        if not self.has_wind:
            return self.speed
        roughness = self.described["roughness_length"]
        height = self.mesh["bounds"][5] - self.mesh["bounds"][4]
        return self.described["friction_velocity"] / KAPPA * math.log((height + roughness) / roughness)

    @property
    def follows_the_wind(self):
        """Whether flows are in proportion to the wind."""
        return self.has_wind and "warm_air" not in self.described and not any(s.curve or s.linear for s in self.screens)

    @property
    def ventilated(self):
        """Rooms that openings join."""
        joined = {room for opening in self.openings if len(set(opening["rooms"])) > 1 for room in opening["rooms"]}
        return [room for room in self.volumes if room in joined]
