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
from .scalars import Age, Scalar, doubt
from .screens import screens_of
from .warmth import Warmth
from .writing import percent

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
# A room has nothing of a scalar below this share of what the exhaust has.
_HARDLY_ANY = 1e-3
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
        self.scalars = {entry["name"]: Scalar(self.folder, entry, self.flows, self.roles, case.volumes)
                        for entry in case.described.get("scalars", [])}
        residual = self.log.residuals.get("age") if self.log else None
        self.age = Age(self.folder, case.volumes, residual) if case.described.get("age_of_air") else None
        self.openings = results.read_openings(self.folder, case.openings)
        warm = case.described.get("warm_air")
        self.warmth = Warmth(self.folder, warm, self.flows, [o.name for o in self.openings], case.volumes) if warm else None
        self.forces = results.read_columns(self.folder / "postProcessing" / "forces", "force.dat", 3)
        self.y_plus = results.read_y_plus(self.folder / "postProcessing" / "yPlus")

    @property
    def is_transient(self):
        return bool(self.warmth) and self.warmth.duration > 0

    def mean_of(self, room, array):
        """A scalar's or the age's mean in a room, or in all air for "": over the last fifth where the case measures it, else of the
        last time; None where not known."""
        measured = self._measured(array).get(room)
        if measured or not self.ran:
            return measured.last() if measured else None
        name = self.fields.averaged(array)
        return self.fields.mean(room, name) if room else self.fields.mean_everywhere(name)

    def _measured(self, array):
        return self.scalars[array].means if array in self.scalars else self.age.means if self.age else {}

    def of_last_time(self):
        """Scalars, and the age, whose means are of the last time only."""
        arrays = [*self.scalars, *(["age"] if self.age else [])] if self.ran else []
        return [array for array in arrays if not self._measured(array) and self.fields.averaged(array) == array]

    def concentration_at(self, scalar, patch):
        """Of the air that passes a patch, by what it carries; None where not measured, or where no air passes."""
        carried, flow = self.scalars[scalar].through.get(patch), self.flows[patch].last()
        return carried.last() / flow + 0.0 if carried and flow else None  # no -0

    def mixed_concentration(self, scalar, outwards):
        """Of all air that leaves the domain, or of all that comes in."""
        through = self.scalars[scalar].through
        patches = [patch for patch in through if (self.flows[patch].last() > 0.0) == outwards]
        whole = sum(self.flows[patch].last() for patch in patches)
        return sum(through[patch].last() for patch in patches) / whole if whole else None

    def effectiveness(self, scalar, concentration):
        """Of a room's ventilation, where the air has a concentration: (exhaust - supply) / (room - supply). 1 is mixed air.

        None where it means nothing: hardly any of the scalar is in the room.
        """
        if not self.case.is_room:
            return None
        exhaust, supply = (self.mixed_concentration(scalar, outwards) for outwards in (True, False))
        if None in (exhaust, supply, concentration):
            return None
        if (concentration - supply) * (exhaust - supply) <= _HARDLY_ANY * (exhaust - supply) ** 2:
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

    @functools.cached_property
    def passages(self):
        """Of each room that openings join, what inlets and outlets let out of it, m3/s, as History by patch. A patch of several
        rooms is divided by its area. Domains of wind have none in rooms."""
        if not (self.case.is_room and self.ran):
            return {}
        shares = {room: {patch: self.fields.share_in(room, patch) for patch in self.flows} for room in self.case.ventilated}
        return {room: {patch: self.flows[patch].times_factor(share) for patch, share in of_room.items() if share > 0.0}
                for room, of_room in shares.items()}

    def _supplied_to(self, room):
        return [results.inwards(flow) for flow in self.passages.get(room, {}).values()]

    def _with_passages(self, room, through_openings):
        parts = [through_openings] if through_openings else []
        return results.summed(parts + self._supplied_to(room))

    def into(self, room):
        """Air that comes into a room, m3/s, as a History; None where nothing is measured."""
        return self._with_passages(room, results.inflow(room, self.openings))

    def inflow(self, room):
        """Air that comes into a room, m3/s; None where nothing is measured."""
        into = self.into(room)
        return into.last() if into else None

    def fresh(self, room):
        """What of it comes straight from outside, m3/s; None where no such way is measured."""
        into = self._with_passages(room, results.inflow(room, [o for o in self.openings if OUTSIDE in o.rooms]))
        return into.last() if into else None

    def air_changes(self, room):
        """Of one room, per hour, as a History."""
        into = self.into(room)
        return into.times_factor(3600.0 / self.case.volumes[room]) if into else None

    def all_air_changes(self):
        """Of all rooms that openings join, taken as one: with the air from outside alone."""
        supplied = [part for room in self.case.ventilated for part in self._supplied_to(room)]
        into = results.summed(part for part in (results.inflow_from(OUTSIDE, self.openings), *supplied) if part)
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
        """Rooms that do not lose as much air as they get: (room, share that is missing)."""
        for room in self.case.ventilated:
            leaving = [flow.times_factor(-1.0) for flow in self.passages.get(room, {}).values()]
            into, net = self.into(room), results.summed(part for part in (results.net_inflow(room, self.openings), *leaving) if part)
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
        rows += self._judged_scalars()
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

    def _judged_scalars(self):
        for name, scalar in self.scalars.items():
            if (excess := scalar.excess()) is not None:
                yield Judged(f"{name} out of the domain", excess, scalar.scale(), "units/s")
            yield from (Judged(f"{name} in {room or 'all air'}", mean, abs(mean.last()), "units/m³")
                        for room, mean in scalar.means.items())
        if self.age:
            yield from (Judged(f"age of air in {room or 'all air'}", mean, mean.last(), "s") for room, mean in self.age.means.items())

    def warnings(self):
        """What to warn of besides failures, in words."""
        if not self.ran:
            return []
        return self.doubts_of_warmth() + (self.warmth.beyond_boussinesq() if self.warmth else []) + list(self._doubts_of_scalars())

    def _doubts_of_scalars(self):
        for name, scalar in self.scalars.items():
            if reasons := scalar.reasons({room: self.mean_of(room, name) for room in self.case.volumes}):
                yield doubt(name, reasons, self.is_transient)
        if self.age:
            ages = {room: self.mean_of(room, "age") for room in self.case.volumes}
            if reasons := self.age.reasons(ages, self._age_that_leaves(), self.warmth.duration if self.warmth else 0.0):
                yield doubt("the age of air", reasons, self.is_transient)

    def _age_that_leaves(self):
        """As a share of what it must be: all air of the domain gains a second each second. None where outdoors it is held at 0, or
        air passes a patch both ways."""
        volume = self.case.mesh.get("volume", 0.0)
        if OUTSIDE in self.fields.cell_zones or not volume > 0.0 or not self.flows:
            return None
        means = {patch: self.fields.mean_through(patch, "age") for patch in self.flows}
        if None in means.values():
            return None
        # Flows are the solver's, from which those of velocities at a patch differ by some percent.
        return sum(flow.last() * means[patch] for patch, flow in self.flows.items()) / volume

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
        found += self.warnings()
        unsettled = [judged.name for judged in self.judged() if judged.verdict == results.UNSETTLED]
        if unsettled:
            unsteady = "" if self.is_transient else "the flow is not steady, and "
            found.append(f"not settled: {', '.join(unsettled)}. {results.longer(self.is_transient)}; if they go on to swing, {unsteady}"
                         "the means of the last fifth are what there is")
        missing = self.imbalance()
        if missing is not None and missing > results.SETTLED:
            found.append(f"flows into the domain and out of it differ by {percent(missing)}")
        found += [f"{room}: the air that enters and leaves through its openings differs by {percent(share)}. The run has not "
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
