# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes weather files for tests: a year of EnergyPlus's EPW, hour by hour."""

import datetime

HEADER = """LOCATION,Port & Town,-,AUS,Test,000000,{latitude},150.2,10.0,12.5
DESIGN CONDITIONS,0
TYPICAL/EXTREME PERIODS,0
GROUND TEMPERATURES,0
HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0
COMMENTS 1,
COMMENTS 2,
DATA PERIODS,1,1,Data,Sunday,1/1,12/31
"""


def epw(temperature, direction, speed, latitude=-33.9):
    """A year of 8,760 hours; arguments are functions of an hour's number."""
    lines = [HEADER.format(latitude=latitude)]
    day = datetime.date(2001, 1, 1)
    for number in range(8760):
        date = day + datetime.timedelta(days=number // 24)
        lines.append(f"2001,{date.month},{date.day},{number % 24 + 1},60,A7,{temperature(number)},1,80,100000,0,0,300,0,0,0,0,0,"
                     f"0,0,{direction(number)},{speed(number)},5,5,20,77777,9,999999999,0,0.05,0,88\n")
    return "".join(lines)
