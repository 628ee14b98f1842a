# SPDX-License-Identifier: GPL-3.0-or-later
"""What the air carries, and its age: means over rooms, balances, and what not to believe of them."""

from __future__ import annotations

from . import results
from .results import History
from .writing import amount, percent

# A balance may miss this share of what sources give, as that of heat.
MOST_IMBALANCE = 0.05
# Where the incoming air carries a background, its solution has errors of this share of what passes, which are no imbalance.
_BACKGROUND_ERROR = 1e-6
# A mean may fall below what comes in by this share, by rounding.
_BELOW = 1e-3
# A residual still falls if the mean of its last fifth is below this share of the fifth before.
_STILL_FALLS = 0.8
# The age of air after a start at rest is within 5 % of its last value if the run lasts longer than the age over this.
_MOST_AGE = 0.3


def read_means(folder, field, rooms) -> dict[str, History]:
    """Histories of a field's mean in rooms, by name, and in all air by the name "": those that the case measures."""
    found = {room: results.read_columns(folder / "postProcessing" / f"mean{field}{'_' * bool(room)}{room}", "volFieldValue.dat", 1)
             for room in (*rooms, "")}
    return {room: columns[0] for room, columns in found.items() if columns}


def _drift_of(means, unit):
    """The mean that drifts most between the last two fifths, if by more than it may, in words; None where all have settled."""
    drifts = {room: mean.drift() / abs(mean.last()) for room, mean in means.items() if mean.last()}
    worst = max(drifts, key=drifts.get, default=None)
    if worst is None or not drifts[worst] > results.NEARLY:
        return None
    return f"the mean in {worst or 'all air'}, {means[worst].last():.4g}{unit}, changes by {percent(drifts[worst])}"


class Scalar:
    """A scalar of one run.

    sources    what cell zones and surfaces give, units/s, by name
    least      the least concentration of air that comes in, units/m3
    through    what goes out of the domain through patches, units/s, as History by name
    means      of rooms, units/m3, as History by name; empty where the case does not measure them
    """

    def __init__(self, folder, described, flows, roles, rooms):
        self.name = described["name"]
        self.sources = {name: float(amount) for name, amount in described.get("sources", {}).items()}
        self._flows = flows
        carried = {patch: results.read_flow(folder, f"flow_{self.name}_{patch}") for patch in flows}
        self.through = {patch: flow for patch, flow in carried.items() if flow is not None}
        self.means = read_means(folder, self.name, rooms)
        incoming = {name: float(amount) for name, amount in described.get("incoming", {}).items()}
        sides = [name for name, role in roles.items() if role in ("inlet", "inletOutlet")]
        self.least = min((self._incoming(name, incoming) for name in sides), default=0.0)

    def _incoming(self, patch, given):
        """Concentration of air that comes in: as measured where it only comes in, which knows of conditions that were edited."""
        carried = self.through.get(patch)
        if carried is not None and (self._flows[patch].values < 0.0).all() and (carried.values <= 0.0).all():
            return carried.last() / self._flows[patch].last()
        return given.get(patch, 0.0)

    def excess(self) -> History | None:
        """What leaves the domain beyond what its air had with the least incoming concentration, units/s; None where not measured."""
        return results.summed([part for patch, carried in self.through.items()
                               for part in (carried, self._flows[patch].times_factor(-self.least))])

    def scale(self):
        """What an imbalance is compared with, units/s: what sources give or take, or else what the incoming air brings."""
        passing = sum(max(-self._flows[patch].last(), 0.0) for patch in self.through)
        brought = sum(max(-carried.last() + self.least * self._flows[patch].last(), 0.0) for patch, carried in self.through.items())
        whole = sum(map(abs, self.sources.values())) or brought or self.least * passing
        return max(whole, self.least * passing * _BACKGROUND_ERROR / MOST_IMBALANCE)

    def reasons(self, values):
        """Why it has not settled, in words. `values` are its means in rooms, units/m3, by name."""
        found = []
        excess, scale, given = self.excess(), self.scale(), sum(self.sources.values())
        if excess is not None and scale > 0.0:
            if excess.drift() > results.NEARLY * scale:
                whole = "what sources give" if self.sources else "what comes in"
                found.append(f"what leaves changes by {percent(excess.drift() / scale)} of {whole}")
            if abs(excess.last() - given) > MOST_IMBALANCE * scale:
                found.append(f"{amount(excess.last(), scale)} units/s leave beyond what comes in, and sources give {given:.3g}")
        if drift := _drift_of(self.means, " units/m³"):
            found.append(drift)
        known = {room: value for room, value in values.items() if value is not None}
        lowest = min(known, key=known.get, default=None)
        if lowest is not None and min(self.sources.values(), default=0.0) >= 0.0 and known[lowest] < (1.0 - _BELOW) * self.least:
            found.append(f"the mean in {lowest}, {known[lowest]:.3g} units/m³, is below the {self.least:.3g} of the air that comes in")
        return found


class Age:
    """The age of the air of one run.

    means     of rooms, s, as History by name; empty where the case does not measure them
    residual  history of the solver's initial residual, or None
    """

    def __init__(self, folder, rooms, residual):
        self._start = folder / "0" / "age"
        self.means = read_means(folder, "age", rooms)
        self._residual = residual

    def _began_at_rest(self):
        return self._start.is_file() and "internalField   uniform 0;" in self._start.read_text(encoding="utf-8", errors="replace")

    def reasons(self, ages, leaving, duration):
        """Why it has not settled, in words.

        ages      means in rooms, s, by name
        leaving   what leaves of the age that the air must have on average when it leaves; None where not known
        duration  of a transient run, s; 0 for others
        """
        if self.means:
            drift = _drift_of(self.means, " s")
            return [drift] if drift else []
        if leaving is not None:
            return [f"the air that leaves has {percent(leaving)} of the age that it must have"] if (
                abs(leaving - 1.0) > MOST_IMBALANCE) else []
        known = {room: age for room, age in ages.items() if age is not None}
        oldest = max(known, key=known.get, default=None)
        if duration > 0.0:
            grows = oldest is not None and known[oldest] > _MOST_AGE * duration and self._began_at_rest()
            return [f"the mean in {oldest} is {known[oldest]:.3g} s, {duration:.3g} s after a start with no age"] if grows else []
        residual = self._residual
        if residual is None or residual.last() <= results.LOW_RESIDUAL or residual.last() > _STILL_FALLS * residual.before():
            return []
        return [f"its residual still falls, {residual.last():.2g} in the last fifth and {residual.before():.2g} in the one before"]


def doubt(name, reasons, is_transient):
    """That a scalar or the age has not settled, and what to do, in words."""
    swings = "" if is_transient else "; if it goes on to swing, the flow is not steady"
    return f"{name} has not settled: {'; '.join(reasons)}. {results.longer(is_transient)}, and do not use its values before{swings}"
