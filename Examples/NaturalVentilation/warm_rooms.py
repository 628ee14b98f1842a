# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of the study whose rooms are warm: conditions, what is measured, and formulas beside it."""

import math

import make_building
from kept_rows import lines_of

OUTDOORS = 22.0  # °C
GRAVITY, KELVIN = 9.81, 273.15
DISCHARGE = 0.6  # of an opening with sharp edges
HARDLY = 0.01  # W/m², which moves no air


def watts(row):
    return row.heat * make_building.LENGTH * make_building.WIDTH


def options(row, wind):
    """Of `atria case`."""
    speed = wind.index("--speed") + 1
    moved_by = [*wind[:speed], f"{row.speed:g}", *wind[speed + 1:]] if row.speed > 0.0 else ["--calm"]
    return [*moved_by, "--outdoor-temperature", f"{OUTDOORS:g}", "--heat", "room_*", f"{watts(row):g}W"]


def measure(case):
    from atria.report import Case

    described = Case(case)
    flow = described.runs[0]
    volumes = described.volumes
    warmer = sum(volumes[room] * (mean.last() - OUTDOORS) for room, mean in flow.warmth.rooms.items()) / sum(volumes.values())
    return {"warmer": warmer, "heat_balance": flow.warmth.imbalance(), "unconverged": flow.doubts_of_warmth()}


def flow_of(changes):
    """Air changes per hour as a flow, m³/s."""
    return changes * make_building.volume() / 3600.0


def stack_flow(warmer):
    """Through windows that each let cold air in below and warm air out above: Q = Cd A / 3 sqrt(g h dT / T), m³/s. That is the
    integral over the window's height h of what the difference of pressures drives."""
    windows = [hole for wall in ("WallSouth", "WallNorth") for hole in make_building.HOLES[wall]]
    return sum(DISCHARGE * (u1 - u0) * (w1 - w0) / 3.0 * math.sqrt(GRAVITY * (w1 - w0) * warmer / (OUTDOORS + KELVIN))
               for u0, w0, u1, w1 in windows)


def expected(row, result, calm, changes_by_wind):
    """Without wind the formula. With wind sqrt(Qw² + Qs²): Qw of wind alone, Qs of the calm row, which grows with the square root
    of how warm the rooms are. In m³/s; None where a row is missing."""
    if row.speed == 0.0:
        return stack_flow(result["warmer"])
    if not calm or not changes_by_wind:
        return None
    stack = flow_of(calm["air_changes"]) * math.sqrt(max(result["warmer"], 0.0) / calm["warmer"])
    return math.hypot(flow_of(changes_by_wind * row.speed), stack)


HEAD = ("row", "wind, m/s", "heat, W/m²", "solving, s", "air changes, 1/h", "by wind alone", "flow, m³/s", "expected, m³/s",
        "warmer, K", "heat balance")


def cells(row, result, calm, changes_by_wind):
    start = [row.name, f"{row.speed:g}", f"{row.heat:g}"]
    if result is None:
        return [*start, "not run", *[""] * (len(HEAD) - 4)]
    flow, wanted = flow_of(result["air_changes"]), expected(row, result, calm, changes_by_wind)
    return [*start, f"{result['solve_seconds']:.0f}", f"{result['air_changes']:.2f}",
            f"{changes_by_wind * row.speed:.2f}" if changes_by_wind else "", f"{flow:.2f}",
            f"{wanted:.2f} ({100 * (flow / wanted - 1):+.1f} %)" if wanted else "", f"{result['warmer']:.2f}",
            f"{100 * result['heat_balance']:+.2f} %" + (" (not converged)" if result["unconverged"] else "")]


def table(results):
    """`results` are pairs of rows and what was measured. A row without wind has the stack's flow, one with hardly any heat the
    wind's, which other winds have in proportion."""
    calm = next((result for row, result in results if row.speed == 0.0), None)
    changes_by_wind = next((result["air_changes"] / row.speed for row, result in results if result and 0.0 < row.heat < HARDLY), None)
    return f"## Warm rooms\n\n{lines_of(HEAD, [cells(row, result, calm, changes_by_wind) for row, result in results])}\n"
