# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run of OpenFOAM left: its log, values of its function objects, and whether they have settled."""

from __future__ import annotations

import pathlib
import re
from dataclasses import dataclass

import numpy

from ..errors import Error

_TIME = re.compile(r"^Time = ([0-9.eE+-]+)s?\s*$")
_RESIDUAL = re.compile(r"Solving for (\w+), Initial residual = ([0-9.eE+-]+|-?nan|inf)")
_SECONDS = re.compile(r"^ExecutionTime = ([0-9.]+) s")
# Parts of a run that are compared, and by how much their means may differ, relative to the quantity's scale.
_PART = 0.2
SETTLED = 0.005
NEARLY = 0.02
# Initial residuals; those of bluff bodies, whose flow is not steady, level off at some 1e-3.
LOW_RESIDUAL = 1e-4
HIGH_RESIDUAL = 5e-3


@dataclass(frozen=True)
class History:
    """A quantity over the iterations."""

    times: numpy.ndarray
    values: numpy.ndarray

    def last(self) -> float:
        """Mean over the last fifth of the run."""
        return float(self.values[self._from(1.0 - _PART)].mean())

    def spread(self) -> float:
        """Standard deviation over the last fifth."""
        return float(self.values[self._from(1.0 - _PART)].std())

    def times_factor(self, factor: float) -> History:
        return History(self.times, self.values * factor)

    def before(self) -> float:
        """Mean over the fifth before the last; infinite where nothing is known of it."""
        part = self._from(1.0 - 2.0 * _PART) & ~self._from(1.0 - _PART)
        return float(self.values[part].mean()) if part.any() else float("inf")

    def drift(self) -> float:
        """By how much the mean of the last fifth differs from that of the fifth before."""
        return abs(self.last() - self.before())

    def _from(self, part):
        first, last = self.times[0], self.times[-1]
        return self.times >= first + part * (last - first)


def longer(is_transient) -> str:
    """What to do where a run was too short, in words."""
    return "Compute a longer time, with a longer --transient" if is_transient else "Run more iterations"


UNSETTLED = "unsettled"


def verdict(history: History, scale: float) -> str:
    """settled, nearly settled or unsettled: the drift of a quantity against its scale, such as the sum of flows."""
    if not len(history.times) or not numpy.isfinite(history.values).all():
        return UNSETTLED
    drift = history.drift() / scale if scale > 0 else 0.0
    return "settled" if drift <= SETTLED else "nearly settled" if drift <= NEARLY else UNSETTLED


def residual_verdict(history: History) -> str:
    """low, levelled off or high, by the mean of the last fifth."""
    last = history.last()
    return "low" if last <= LOW_RESIDUAL else "levelled off" if last <= HIGH_RESIDUAL else "high"


@dataclass(frozen=True)
class Log:
    """A solver's log: initial residuals by field, the first solution of each iteration, and whether it came to its end."""

    file: str
    residuals: dict[str, History]
    ended: bool
    seconds: float  # of processor time, 0 where the log does not say


def read_log(file) -> Log:
    found: dict[str, dict[float, float]] = {}
    time, ended, seconds = None, False, 0.0
    try:
        with open(file, encoding="utf-8", errors="replace") as lines:
            for line in lines:
                if match := _TIME.match(line):
                    time = float(match[1])
                elif time is not None and (match := _RESIDUAL.search(line)):
                    found.setdefault(match[1], {}).setdefault(time, float(match[2]))
                elif match := _SECONDS.match(line):
                    seconds = float(match[1])
                elif line.startswith("End"):
                    ended = True
    except OSError as error:
        raise Error(f"{file}: {error.strerror}") from None
    residuals = {field: History(numpy.array(list(rows)), numpy.array(list(rows.values()))) for field, rows in found.items()}
    return Log(str(file), residuals, ended, seconds)


def _rows(file):
    """Numbers of each line, brackets of vectors taken away."""
    for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.strip() and not line.lstrip().startswith("#"):
            try:
                yield [float(word) for word in line.replace("(", " ").replace(")", " ").split()]
            except ValueError:
                return  # a line that the run had not finished


def read_table(folder, name) -> numpy.ndarray:
    """All of postProcessing/<function>/<start>/<name>, of later starts where these overlap; empty without any."""
    starts = []
    for start in pathlib.Path(folder).glob("*"):
        try:
            starts.append((float(start.name), start))
        except ValueError:
            continue
    rows: dict[float, list[float]] = {}
    for _, start in sorted(starts):
        if (start / name).is_file():
            new = list(_rows(start / name))
            if new:
                rows = {time: row for time, row in rows.items() if time < new[0][0]}
            rows.update({row[0]: row for row in new})
    if not rows:
        return numpy.empty((0, 0))
    width = max(map(len, rows.values()))
    return numpy.array([row for row in rows.values() if len(row) == width]).reshape(-1, width)


def read_flow(case, function) -> History | None:
    """A sum of `surfaceFieldValue`, m3/s."""
    table = read_table(pathlib.Path(case) / "postProcessing" / function, "surfaceFieldValue.dat")
    return History(table[:, 0], table[:, 1]) if table.size else None


def read_columns(folder, name, count) -> list[History]:
    """The first columns of a table after the time; none without a table."""
    table = read_table(folder, name)
    return [History(table[:, 0], table[:, i + 1]) for i in range(min(count, table.shape[1] - 1))] if table.size else []


def read_y_plus(folder) -> dict[str, float]:
    """The average over each wall at the last time."""
    latest = {}
    for file in sorted(pathlib.Path(folder).glob("*/yPlus.dat"), key=lambda f: float(f.parent.name)):
        for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
            words = line.split()
            if len(words) == 5 and not line.startswith("#"):
                latest[words[1]] = float(words[4])
    return latest


@dataclass(frozen=True)
class Opening:
    name: str
    rooms: tuple[str, str]
    area: float
    net: History  # m3/s from the first room to the second
    both: History  # m3/s, without regard to the direction

    def forward(self) -> float:
        """Flow from the first room to the second, m3/s."""
        return 0.5 * (self.both.last() + self.net.last())

    def backward(self) -> float:
        return 0.5 * (self.both.last() - self.net.last())


def read_openings(case, described) -> list[Opening]:
    """`described` are the openings of case.json. Those of which nothing was measured are left out."""
    openings = []
    for opening in described:
        net = read_flow(case, "flow_" + opening["name"])
        both = read_flow(case, "flowBothWays_" + opening["name"])
        if net is not None and both is not None:
            openings.append(Opening(opening["name"], tuple(opening["rooms"]), opening["area"], net, both))
    return openings


def summed(parts) -> History | None:
    """The sum of histories of one run, which are measured together; None of none."""
    parts = list(parts)
    if not parts:
        return None
    length = min(len(part.times) for part in parts)  # the last line of some may be missing
    return History(parts[0].times[:length], numpy.sum([part.values[:length] for part in parts], axis=0))


def inwards(flow: History) -> History:
    """What comes in of a flow out of the domain, m3/s."""
    return History(flow.times, numpy.maximum(-flow.values, 0.0))


def _parted(opening, inwards):
    """The flow one way through an opening: half of the sum of both ways and the net flow."""
    return summed([opening.both.times_factor(0.5), opening.net.times_factor(0.5 if inwards else -0.5)])


def _joining(room, openings):
    """Openings between a room and another, and whether it is the second, into which the net flow is positive."""
    return [(o, o.rooms[1] == room) for o in openings if o.rooms[0] != o.rooms[1] and room in o.rooms]


def inflow(room: str, openings) -> History | None:
    """Air that comes into a room, m3/s. None where no opening of it was measured."""
    return summed(_parted(opening, second) for opening, second in _joining(room, openings))


def inflow_from(room: str, openings) -> History | None:
    """Air that leaves a room, m3/s."""
    return summed(_parted(opening, not second) for opening, second in _joining(room, openings))


def net_inflow(room: str, openings) -> History | None:
    """What comes into a room less what leaves it, m3/s: 0 but for what has not settled, or is not measured."""
    return summed(opening.net.times_factor(1.0 if second else -1.0) for opening, second in _joining(room, openings))


def imbalance(flows) -> float:
    """Of flows out of the domain, m3/s: what is missing, relative to what comes in; 0 where nothing flows."""
    values = numpy.array(list(flows), dtype=float)
    incoming = -values[values < 0].sum()
    if not values.any():
        return 0.0
    return float(abs(values.sum()) / incoming) if incoming > 0 else float("inf")
