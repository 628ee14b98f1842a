# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a case: what its runs say, and what to doubt."""

from __future__ import annotations

import html

import numpy

from ..errors import Error
from . import charts, comfort, pictures, results
from .case import MOST_Y_PLUS
from .rooms import rooms
from .writing import amount, folded, judgement, number, percent, table

_STYLE = """body { font-family: Arial, Helvetica, sans-serif; color: #282828; }
body { margin: 24px auto; max-width: 1180px; padding: 0 16px; }
h2 { border-bottom: 1px solid #ccc; padding-bottom: 4px; margin-top: 36px; break-after: avoid; }
.wide { overflow-x: auto; margin: 12px 0; }
table { border-collapse: collapse; } th, td { padding: 3px 14px; text-align: right; vertical-align: top; }
th { border-bottom: 1px solid; vertical-align: bottom; } td { white-space: nowrap; } tr, figure, .bar { break-inside: avoid; }
th:first-child, td:first-child, .words th:last-child, .words td:last-child { text-align: left; }
.words td:last-child { white-space: normal; min-width: 220px; }
.row { display: flex; flex-wrap: wrap; gap: 16px; }
figure { margin: 12px 0; } figcaption { color: #555; }
img { max-width: 100%; } svg { max-width: 100%; height: auto; } summary { cursor: pointer; font-weight: bold; margin: 5px 0; }
.bar { display: flex; align-items: center; gap: 8px; } .bar i { width: 240px; height: 12px; }
.good { color: #2f855a; } .fair { color: #b7791f; } .bad { color: #c53030; }
.key { max-width: 540px; } .key span { white-space: nowrap; margin-right: 10px; }
.key i { display: inline-block; width: 12px; height: 12px; margin-right: 4px; }
.chart { min-width: 560px; }
@media (max-width: 600px) { th, td { padding: 3px 7px; } .bar i { width: 120px; } }
@media print { body { font-size: 10pt; margin: 0; } th, td { padding: 2px 6px; } .row { display: block; }
.row figure { display: inline-block; vertical-align: top; width: 48%; } }"""
# In the chart of what must settle: the answers come first.
MOST_LINES = 8
_CLASS_COLORS = ("#2f855a", "#9ac66b", "#f6e05e", "#ed8936", "#c53030")


def _doubts_of_mesh(case):
    mesh = case.mesh
    if mesh["worst_non_orthogonality"] > 70:
        yield (f"{mesh['worst_non_orthogonality']:.1f}° of non-orthogonality at worst; above 70° fluxes are corrected in part "
               "only")
    if mesh["failed_checks"]:
        yield f"it fails {mesh['failed_checks']} of checkMesh's checks; see atria quality --checks"
    high = max((run.high_y_plus() for run in case.runs), key=len, default=[])
    if high:
        yield (f"y⁺ is above {MOST_Y_PLUS:g} on average on {len(high)} walls, up to {max(high):.0f}: friction there is a guess. It "
               "matters little where the flow separates at edges, more on long or curved walls; layers make it smaller")
    yield "one mesh does not tell its own error; halve the sizes and compare"


def _doubts_of_comfort(case, climate):
    widest = comfort.widest_gap(climate, [run.origin for run in case.runs])
    if widest > comfort.FAR_APART:
        yield (f"a sector of the climate is {widest:.3g}° from the next direction that was run; make the case with --rose 12 "
               "or more")
    yield "hourly means alone; gusts count by the limits' own margins"


def doubts(case, climate):
    found = []
    for run in case.runs:
        prefix = f"{run.title}: " if len(case.runs) > 1 else ""
        found += [prefix + doubt for doubt in [*run.failures(), *run.doubts()]]
        found += [prefix + doubt for doubt in run.profile.doubts()] if run.profile else []
    found += ["mesh: " + doubt for doubt in _doubts_of_mesh(case)]
    found += ["comfort: " + doubt for doubt in _doubts_of_comfort(case, climate)] if climate else []
    if case.described.get("warm_air"):
        found += _doubts_of_warm_air(case)
    elif case.is_room:
        found.append("model: the air has one temperature. Warm and cold air, which often moves more in a room than inlets do, is "
                     "left out; and steady Reynolds-averaged flow smooths jets that swing")
        return _doubts_as_list(found)
    if not case.has_wind:
        return _doubts_as_list(found)
    found.append("model: steady Reynolds-averaged flow has the speeds of wakes and of lee sides too low, whatever the mesh, and "
                 "knows no exchange through an opening by turbulence alone: single-sided ventilation comes out too small")
    return _doubts_as_list(found)


def _doubts_of_warm_air(case):
    yield ("model: k and epsilon know nothing of buoyancy, so layers of warm and cold air mix more than they do, and walls take no "
           "heat by radiation")
    if any(run.warmth.given for run in case.runs):
        yield ("model: surfaces with a temperature give the air about a third of the heat that free convection takes from them; give "
               "their heat in W where it is known")


def _doubts_as_list(found):
    return "<h2>What to doubt</h2><ul>" + "".join(f"<li>{html.escape(text)}</li>" for text in found) + "</ul>"


def _heat_rows(run):
    warmth, whole = run.warmth, run.warmth.heat_in()
    yield from ((html.escape(name), "given", number(given, 4)) for name, given in warmth.sources.items())
    yield from ((html.escape(name), f"surface of {warmth.given[name]:g} °C", amount(heat.last(), whole))
                for name, heat in warmth.surfaces.items())
    carried = {name: amount(-heat.last(), whole) for name, heat in warmth.out.items()}
    yield from ((html.escape(name), "carried by the air", heat) for name, heat in carried.items() if heat != "0")


def _heat_of(run):
    warmth, missing = run.warmth, run.warmth.imbalance()
    text = table(("from", "", "heat into the air, W"), _heat_rows(run))
    facts = [f"outdoors {warmth.outdoors:g} °C"]
    if warmth.everywhere:
        facts.append(f"all air of the mesh {warmth.everywhere.last():.4g} °C on average")
    facts += [f"surface of {html.escape(name)} {celsius.last():.4g} °C" for name, celsius in warmth.walls.items()]
    if missing is not None:
        facts.append(f"<b>{number(warmth.heat_in(), 4)}</b> W come in and "
                     f"<b>{amount(warmth.heat_out(), warmth.heat_in())}</b> W leave, a difference of {percent(missing)}")
    return text + f"<p>{'; '.join(facts)}.</p>"


def heat(case):
    """Where heat comes from and where it goes, relative to the air outdoors."""
    ran = [run for run in case.runs if run.warmth and run.ran]
    if not ran:
        return ""
    return "<h2>Heat</h2>" + "".join(folded(run.title, _heat_of(run), len(case.runs) > 1) for run in ran)


def pictures_of(case, view, ratios, fields_of):
    """Speeds over the ground in all directions, and sections of each."""
    if view is None:
        return ""
    known = ratios[numpy.isfinite(ratios)]
    high = float(numpy.percentile(known, 99.5)) if known.size else 1.0
    above = f"{view.corner[2] - case.mesh['bounds'][4]:.3g} m above the floor" if case.is_room else (
        f"{case.pedestrian_height:g} m above the ground")
    text = [f'<h2>Speed {above}</h2><div class="row">']
    for (run, fields), ratio in zip(fields_of.items(), ratios):
        walls = pictures.walls_of(run, fields)
        lines = view.lines(walls) if view.flat and walls else ()
        arrows = view.arrows(fields.mesh, fields.velocity) if view.flat and len(case.runs) == 1 else ()
        text.append(charts.figure(charts.plot(charts.colored(view.image(ratio), 0.0, high), lines, arrows), run.title))
    if not case.is_room and not case.has_wind:  # the speed of warm air is an estimate
        bar = charts.color_bar(0.0, high * case.speed, "m/s")
    else:
        bar = charts.color_bar(0.0, high, f"of the mean speed at the inlets, {case.speed:.3g} m/s" if case.is_room else
                               f"of the reference speed, {case.speed:g} m/s at {case.described['reference_height']:g} m")
    text += ["</div>", bar, *_scalar_pictures(case, view, fields_of, above), "<h2>The flow</h2>"]
    several = len(case.runs) > 1
    return "\n".join(text + [folded(run.title, _flow(case, run, fields), several) for run, fields in fields_of.items()])


def _scalar_pictures(case, view, fields_of, above):
    """Concentrations at the height of the view."""
    for scalar in case.scalars:
        values = [view.sample(fields.mesh, scalar) for fields in fields_of.values()]
        known = numpy.concatenate([v[numpy.isfinite(v)] for v in values])
        high = float(numpy.percentile(known, 99.5)) if known.size else 1.0
        yield f'<h2>{scalar} {above}</h2><div class="row">'
        for run, found in zip(fields_of, values):
            yield charts.figure(charts.plot(charts.colored(view.image(found), 0.0, high)), run.title)
        yield "</div>" + charts.color_bar(0.0, high, f"{scalar}, units per m³")


def _flow(case, run, fields):
    high = pictures.fastest_near(run, fields, case)
    text = ['<div class="row">', *pictures.level_plots(run, fields, high), *pictures.wind_plot(run, fields, case, high), "</div>",
            charts.color_bar(0.0, high, "m/s; arrows are the flow in the section"), *pictures.temperatures(run, fields, case)]
    if case.is_room:  # walls hide what is in it
        return "\n".join(text)
    picture = pictures.in_space(run, fields, high)
    if picture is None:
        text.append("<p>A picture in space is missing: it needs walls and, without a display, the command xvfb-run.</p>")
    else:
        image = f'<img alt="pressure and paths" src="{charts.embedded(picture)}">'
        text.append(charts.figure(image, "pressure on the walls (kinematic), and paths of the air through the openings, or past "
                                         "the walls where there are none"))
    return "\n".join(text)


def _class_figure(title, words, found, view, lines):
    colors = [_CLASS_COLORS[round(i * 4 / (len(words) - 1))] for i in range(len(words))]
    palette = numpy.array([[int(c[i:i + 2], 16) for i in (1, 3, 5)] for c in colors] + [charts.UNKNOWN], numpy.uint8)
    key = " ".join(f'<span><i style="background: {color}"></i>{word} {100 * share:.1f} %</span>'
                  for color, word, share in zip(colors, words, comfort.shares(found, len(words))))
    return charts.figure(charts.plot(palette[view.image(found)], lines) + f'<p class="key">{key}</p>', title)


def comfort_of(case, view, ratios, fields_of, climate):
    if not case.has_wind:
        return ""
    text = "<h2>Wind comfort</h2>"
    if climate is None:
        return text + ("<p>Classes of comfort need the wind's statistics: give a table of the climate with "
                       "<code>--climate</code>.</p>")
    if view is None:
        return text + "<p>The case has not run.</p>"
    origins = [run.origin for run in fields_of]
    if (widest := comfort.widest_gap(climate, origins)) > comfort.MOST_APART:
        return text + (f"<p>A sector of the climate is {widest:.3g}° from the next direction that was run, which is too far: make "
                       "the case for a rose, <code>atria case --rose 12</code>.</p>")
    run, fields = next(iter(fields_of.items()))
    outdoors = numpy.where(fields.inside(case.volumes, view.places), numpy.nan, ratios)
    walls = pictures.walls_of(run, fields)
    lines = view.lines(walls) if view.flat and walls else ()
    figures = [_class_figure(title, words, classes(climate, origins, outdoors), view, lines) for title, words, classes in (
        ("NEN 8100: hours with more than 5 m/s; A below 2.5 %, then 5, 10, 20 %", comfort.NEN_8100_CLASSES, comfort.nen_8100),
        ("Lawson: 4, 6, 8, 10 m/s are exceeded in 5 % of hours at most", comfort.LAWSON_CLASSES, comfort.lawson),
        ("NEN 8100, danger: hours with more than 15 m/s; 0.05 and 0.3 %", comfort.DANGER_CLASSES, comfort.danger))]
    return text + '<div class="row">' + "\n".join(figures) + "</div><p>Shares are of the area shown, without rooms.</p>"


def mesh_and_wind(case):
    mesh, described = case.mesh, case.described
    rows = [("cells", f"{mesh['cells']:,}"), ("worst non-orthogonality", f"{mesh['worst_non_orthogonality']:.1f}°"),
            ("mean non-orthogonality", f"{mesh['mean_non_orthogonality']:.1f}°"), ("worst skewness", f"{mesh['worst_skewness']:.2f}"),
            ("failed checks of checkMesh", mesh["failed_checks"]), ("turbulence", html.escape(described["turbulence"]))]
    if not case.has_wind:
        return "<h2>Mesh</h2>" + table((), rows)
    rows += [("wind", f"{case.speed:g} m/s at {described['reference_height']:g} m"),
            ("roughness length", f"{described['roughness_length']:g} m"),
            ("friction velocity", f"{described['friction_velocity']:.3g} m/s")]
    return "<h2>Mesh and wind</h2>" + table((), rows)


def _profile_rows(profile):
    below = profile.heights <= max(profile.height_of_interest, profile.heights[0])
    for height, *values in zip(profile.heights[below], *map(numpy.ravel, profile.speed + profile.k)):
        yield [f"{value:.3g}" for value in (height, *values)]


def _profile_of(run):
    profile = run.profile
    if not profile.ran:
        return f"<p>The domain without buildings has not run: {html.escape(str(profile.folder / 'Allrun'))}.</p>"
    facts = (f"<p>Largest changes below {profile.height_of_interest:.3g} m: of the speed {profile.change_of_speed()}, of the "
             f"turbulence k {profile.change_of_k()}. The buildings begin {profile.fetch:.3g} m behind the inlet.</p>")
    head = ("height, m", "speed at the inlet, m/s", "before the buildings", "k at the inlet, m²/s²", "before the buildings")
    return facts + table(head, _profile_rows(profile))


def profiles(case):
    """How the wind changes before the buildings, where the case has a domain without them."""
    checked = [run for run in case.runs if run.profile]
    if not checked:
        return ""
    text = ("<h2>The wind before the buildings</h2><p>In the domain without buildings the wind should stay as it is at the inlet "
            "(Blocken, Stathopoulos and Carmeliet 2007).</p>")
    return text + "".join(folded(run.title, _profile_of(run), len(checked) > 1) for run in checked)


def _converged(run):
    rows = [(html.escape(judged.name), f"{judged.history.last():.4g} {judged.unit}", f"{judged.history.spread():.2g}",
             percent(judged.history.drift() / judged.scale) if judged.scale > 0 else "–", judgement(judged.verdict))
            for judged in run.judged()]
    text = table(("quantity", "mean of the last fifth", "deviation", "drift", ""), rows)
    residuals = [(html.escape(field), f"{history.last():.2g}", judgement(results.residual_verdict(history)))
                 for field, history in run.log.residuals.items()]
    text += table(("initial residual of", "mean of the last fifth", ""), residuals)
    lines = [(name, history.times, history.values) for name, history in run.log.residuals.items()]
    drawn = [(j.name, j.history.times, j.history.values / j.scale) for j in run.judged()[:MOST_LINES] if j.scale > 0]
    last = max((h.times[-1] for h in run.log.residuals.values()), default=0.0)
    unit, length = ("seconds", f"{last:g} s") if run.is_transient else ("iteration", f"{int(last)} iterations")
    facts = f"<p>{length}" + (f", {run.log.seconds:,.0f} s of processor time" if run.log.seconds else "")
    if (missing := run.imbalance()) is not None:
        facts += f"; flows into the domain and out of it differ by {percent(missing)}"
    drawings = (charts.line_chart("Initial residuals", lines, logarithmic=True, along=unit),
                charts.line_chart("Quantities, relative to their scale", drawn, along=unit))
    return facts + ".</p>" + '<div class="row">' + "".join(f'<div class="wide">{chart}</div>' for chart in drawings) + "</div>" + text


def convergence(case):
    text = ("<h2>Convergence</h2><p>A quantity has settled where the means of the last two fifths of the run differ (its drift) by "
            f"at most {100 * results.SETTLED:g} % of its scale, nearly where by at most {100 * results.NEARLY:g} %. Residuals are low "
            f"up to {results.LOW_RESIDUAL:g} and high above {results.HIGH_RESIDUAL:g}; those of flows that are not steady level off, "
            "and the quantities count.</p>")
    several = len(case.runs) > 1
    return text + "".join(folded(run.title, _converged(run), several) for run in case.runs if run.ran)


def _sampled(case):
    """The fields of each run, the view from above, and by run the speeds at its places over the reference speed."""
    fields_of = {run: run.fields for run in case.runs if run.ran}
    view, ratios = None, []
    for run, fields in fields_of.items():
        view = view or pictures.plan(run, fields, case)
        ratios.append(numpy.linalg.norm(view.sample(fields.mesh, fields.velocity), axis=1) / case.speed)
    return fields_of, view, numpy.array(ratios)


def page_of(case, climate=None) -> str:
    """HTML that needs no other file. `climate` are sectors at the case's reference height, as `comfort` reads them."""
    if climate and not case.has_wind:
        raise Error(f"{case.folder} is {'a room' if case.is_room else 'calm air'}, which has no wind: leave the climate out")
    fields_of, view, ratios = _sampled(case)
    title = html.escape(f"{'Room' if case.is_room else 'Wind' if case.has_wind else 'Calm air'}: {case.folder.resolve().name}")
    return "\n".join([
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta name="viewport" content="width=device-width, initial-scale=1"><title>{title}</title><style>{_STYLE}</style></head>',
        f"<body><h1>{title}</h1>",
        rooms(case, fields_of, climate),
        heat(case),
        doubts(case, climate),
        pictures_of(case, view, ratios, fields_of),
        comfort_of(case, view, ratios, fields_of, climate),
        mesh_and_wind(case),
        profiles(case),
        convergence(case),
        "</body></html>\n",
    ])
