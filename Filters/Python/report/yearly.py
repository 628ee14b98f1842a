# SPDX-License-Identifier: GPL-3.0-or-later
"""Air changes over the hours of a climate: each hour has those of its direction, in proportion to its wind.

Without warm air flows are proportional to the wind. A sector of the climate takes the direction next to it.
"""

from __future__ import annotations

import math

from .comfort import angle_between

# Shares of hours that the page lists.
SHARES = (0.5, 0.9)


def _sectors(climate, changes, speed):
    """Frequency, scale and shape of the air changes of each sector, whose distribution is that of its wind.

    changes  by direction (degrees, where the wind comes from), per hour at `speed`, m/s
    """
    for sector in climate:
        nearest = min(changes, key=lambda origin: angle_between(origin, sector.origin))
        yield sector.frequency, sector.scale * changes[nearest] / speed, sector.shape


def mean(climate, changes, speed):
    """Mean air changes per hour."""
    return sum(frequency * scale * math.gamma(1.0 + 1.0 / shape) for frequency, scale, shape in _sectors(climate, changes, speed))


def exceeded(climate, changes, speed, share):
    """Air changes per hour that are exceeded in a share of the hours."""
    sectors = list(_sectors(climate, changes, speed))

    def hours_above(value):
        return sum(frequency * math.exp(-((value / scale) ** shape)) for frequency, scale, shape in sectors if scale > 0.0)

    low, high = 0.0, 1.0
    while hours_above(high) > share:
        high *= 2.0
    for _ in range(60):
        middle = (low + high) / 2.0
        low, high = (middle, high) if hours_above(middle) > share else (low, middle)
    return low
