# SPDX-License-Identifier: GPL-3.0-or-later
"""What the runs of a case say, as a page of HTML: `python3 -m atria.report CASE`, or `atria report CASE`.

    from atria.report import Case, page_of
    case = Case("case")                       # what atria case wrote, and its Allrun ran
    case.runs[0].all_air_changes().last()     # per hour
    page = page_of(case)
"""

from .case import Case
from .comfort import read_climate
from .page import page_of

__all__ = ["Case", "page_of", "read_climate"]
