# SPDX-License-Identifier: GPL-3.0-or-later
"""The grid convergence index of Roache (1994), as Celik et al. (2008), "Procedure for estimation and reporting of
uncertainty due to discretization in CFD applications", J. Fluids Eng. 130, 078001, have it. An apparent order above that of
the schemes says that the finest two are close by chance; limit and index then take the schemes' order, which is the safe side.
"""

import math
from dataclasses import dataclass

SAFETY = 1.25  # for three sizes
FORMAL_ORDER = 2.0


TENDENCY = ("coarse", "medium", "fine", "convergence", "order", "limit", "index")  # columns of tendency()


@dataclass(frozen=True)
class Convergence:
    kind: str  # monotonic, oscillating, or diverging: then order, limit and index say nothing
    order: float  # apparent
    limit: float  # what the values tend to
    index: float  # of the finest value, relative to it


def convergence(sizes, values):
    """Of three sizes, the finest first, and a value for each.

    Raises ValueError where sizes do not grow.
    """
    if not 0 < sizes[0] < sizes[1] < sizes[2]:
        raise ValueError("sizes must grow")
    fine, coarse = values[1] - values[0], values[2] - values[1]
    if fine == 0:
        return Convergence("monotonic", math.inf, values[0], 0.0)
    kind = "monotonic" if coarse / fine > 0 else "oscillating"
    order = apparent_order(sizes[1] / sizes[0], sizes[2] / sizes[1], coarse / fine)
    if order <= 0:
        return Convergence("diverging", order, math.nan, math.nan)
    growth = (sizes[1] / sizes[0]) ** min(order, FORMAL_ORDER) - 1.0
    return Convergence(kind, order, values[0] - fine / growth, SAFETY * abs(fine / values[0]) / growth)


def apparent_order(fine_ratio, coarse_ratio, change):
    """Of ratios of sizes and of the coarse difference to the fine one; 0 or less where the finer mesh differs by more."""
    sign = math.copysign(1.0, change)

    def change_of(order):
        return (coarse_ratio**order - sign) / (fine_ratio**order - sign) * fine_ratio**order

    # It grows with the order, from this where there is none.
    least = math.log(coarse_ratio) / math.log(fine_ratio) if sign > 0 else 1.0
    if abs(change) <= least:
        return 0.0
    low, high = 0.0, 1.0
    while change_of(high) < abs(change):
        low, high = high, 2.0 * high
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if change_of(middle) < abs(change) else (low, middle)
    return high


def tendency(sizes, values):
    """Of a table's line: the values, the finest last, and what they tend to."""
    found = convergence(sizes, values)
    numbers = [f"{value:.3f}" for value in values[::-1]]
    if found.kind == "diverging":
        return [*numbers, found.kind, "", "", ""]
    return [*numbers, found.kind, f"{found.order:.1f}", f"{found.limit:.3f}", f"{100 * found.index:.1f} %"]
