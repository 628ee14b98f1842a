# SPDX-License-Identifier: GPL-3.0-or-later
"""What is published of the flow about a square building twice as high as wide: case A of the Architectural Institute of
Japan (AIJ).

Measured by Meng and Hibi (1998), "Turbulent measurements of the flow field around a high-rise building", Journal of Wind
Engineering 76, 55-64, in a tunnel, with split-fiber probes. The data are the AIJ's under CC BY 4.0,
https://doi.org/10.5281/zenodo.15050147; here they are rounded, heights and places in widths b of the building, speeds
along the wind relative to U_H, k to its square. Computed lengths are those of the AIJ's working group: its Guidebook for
CFD predictions of urban wind environment (2016), table 2-1-3, and Mochida et al. (2002), "Comparison of various k-epsilon
models and DSM applied to flow around a high-rise building", Wind and Structures 5, 227-244.
"""

import math

WIDTH = 0.08  # b, meters
SPEED = 4.491  # U_H, at the height of the roof, m/s
ROUGHNESS = 1.8e-4  # of the tunnel's floor, meters
C_MU = 0.09

# z/b, U/U_H, k/U_H^2 of the wind without the building.
INFLOW = ((0.0625, 0.611, 0.0184), (0.125, 0.654, 0.0197), (0.25, 0.707, 0.0217), (0.5, 0.765, 0.0244), (0.75, 0.808, 0.0267),
          (1.0, 0.851, 0.0284), (1.25, 0.895, 0.0290), (1.5, 0.937, 0.0311), (1.75, 0.971, 0.0315), (2.0, 1.0, 0.0324),
          (2.375, 1.049, 0.0326), (2.875, 1.112, 0.0323), (3.75, 1.213, 0.0294), (5.0, 1.353, 0.0215))

# Lengths of the reversed flow in widths: on the roof from its front edge, behind the building from its back.
ROOF_LENGTH, WAKE_LENGTH = 0.52, 1.42
PUBLISHED = (("k-epsilon, five computations", "none", "1.98–2.70"),
             ("k-epsilon of Kato and Launder, three", "0.53–0.87", "2.98–3.19"),
             ("k-epsilon, MMK, two", "0.52–0.65", "2.72–3.09"),
             ("RNG k-epsilon", "0.58", "3.34"),
             ("k-epsilon with Durbin's limit", "0.63", "2.70"),
             ("Reynolds stresses (DSM)", "> 1", "4.22"),
             ("large eddies (LES)", "0.92", "2.05"))

# U/U_H in the middle plane at these z/b, by x/b.
HEIGHTS = (0.125, 0.5, 1.0, 1.5, 1.75, 2.0, 2.125, 2.375, 2.75, 3.5)
MIDDLE = {0.75: (-0.14, -0.13, -0.12, -0.08, -0.01, 0.51, 0.78, 1.04, 1.16, 1.22),
          1.25: (-0.16, -0.16, -0.13, -0.01, 0.17, 0.67, 0.84, 1.03, 1.14, 1.20),
          2.0: (0.05, 0.10, 0.17, 0.32, 0.50, 0.73, 0.85, 1.01, 1.10, 1.20),
          3.25: (0.31, 0.41, 0.53, 0.64, 0.74, 0.86, 0.91, 1.01, 1.09, 1.19)}
# U/U_H at z/b = 0.125 at these y/b, by x/b.
SIDES = (0.0, 0.25, 0.5, 0.625, 0.875, 1.125, 1.5, 2.0)
NEAR_GROUND = {0.75: (-0.15, -0.11, 0.13, 0.40, 0.65, 0.78, 0.82, 0.81),
               1.25: (-0.15, -0.05, 0.24, 0.39, 0.63, 0.73, 0.82, 0.81),
               2.0: (0.05, 0.12, 0.28, 0.35, 0.51, 0.62, 0.73, 0.79),
               3.25: (0.31, 0.33, 0.37, 0.40, 0.47, 0.55, 0.64, 0.72)}


def inflow(z):
    """U in m/s, k in m2/s2 and epsilon in m2/s3 at a height in meters: between measured heights as a power of the height,
    below them the logarithm over the floor's roughness. As much turbulence is made as decays: epsilon is
    sqrt(C_mu) k dU/dz, as the AIJ's computations had it."""
    points = [(height * WIDTH, u * SPEED, k * SPEED**2) for height, u, k in INFLOW]
    if z <= points[0][0]:
        height, u, k = points[0]
        slope = u / math.log((height + ROUGHNESS) / ROUGHNESS)
        speed, gradient = slope * math.log((z + ROUGHNESS) / ROUGHNESS), slope / (z + ROUGHNESS)
    else:
        low, high = next((pair for pair in zip(points, points[1:]) if z <= pair[1][0]), (points[-2], points[-1]))
        exponent = math.log(high[1] / low[1]) / math.log(high[0] / low[0])
        speed = low[1] * (z / low[0]) ** exponent
        gradient = exponent * speed / z
        k = low[2] + (high[2] - low[2]) * min(1.0, (z - low[0]) / (high[0] - low[0]))
    return speed, k, math.sqrt(C_MU) * k * gradient


def inflow_conditions(patch, omega=False):
    """Options of `atria case` that put this wind on a patch: tables over the height."""
    below = [INFLOW[0][0] * WIDTH * part for part in (0.0, 0.05, 0.1, 0.2, 0.35, 0.6)]
    heights = [*below, *(point[0] * WIDTH for point in INFLOW)]
    rows = [(z, *inflow(z)) for z in heights]
    tables = {"U": [f"({z:g} ({u:.5g} 0 0))" for z, u, _, _ in rows], "k": [f"({z:g} {k:.5g})" for z, _, k, _ in rows]}
    if omega:
        tables["omega"] = [f"({z:g} {epsilon / (C_MU * k):.5g})" for z, _, k, epsilon in rows]
    else:
        tables["epsilon"] = [f"({z:g} {epsilon:.5g})" for z, _, _, epsilon in rows]
    options = []
    for field, table in tables.items():
        value = "(0 0 0)" if field == "U" else "1"
        options += ["--condition", patch, field, f"type fixedProfile; profile table ({' '.join(table)}); direction (0 0 1); "
                    f"origin 0; value uniform {value};"]
    return options
