# SPDX-License-Identifier: GPL-3.0-or-later
"""The page's sections on rooms, openings, inlets and outlets."""

from __future__ import annotations

import html

from . import comfort, screens, stack, yearly
from .writing import amount, duration, folded, number, table


def _climate_rows(case, climate):
    """Air changes over the hours of the climate: their mean, and what shares of hours exceed."""
    if not climate or comfort.widest_gap(climate, [run.origin for run in case.runs]) > comfort.MOST_APART:
        return
    of_all = {run.origin: run.all_air_changes() for run in case.runs}
    wholes = [of_all, *({run.origin: run.air_changes(room) for run in case.runs} for room in case.ventilated)]
    if any(changes is None for whole in wholes for changes in whole.values()):
        return
    known = [{origin: changes.last() for origin, changes in whole.items()} for whole in wholes]
    whole, *of_rooms = (number(yearly.mean(climate, changes, case.speed)) for changes in known)
    yield ["mean over the climate's hours", f"<b>{whole}</b>", *of_rooms]
    for share in yearly.SHARES:
        exceeded = [number(yearly.exceeded(climate, changes, case.speed, share)) for changes in known]
        yield [f"exceeded in {100 * share:g} % of them", *exceeded]


def _summary(case, climate):
    """The answers of all directions in one table."""
    rows = []
    for run in case.runs:
        whole = run.all_air_changes()
        rooms = [number(changes.last() if (changes := run.air_changes(room)) else None) for room in case.ventilated]
        rows.append([run.title, f"<b>{number(whole.last() if whole else None)}</b>", *rooms])
    head = ("air changes per hour", "building", *map(html.escape, case.ventilated))
    of_hours = list(_climate_rows(case, climate)) if case.follows_the_wind else []
    text = table(head, rows + of_hours)
    text += ("<p>Of the building: the air that comes in from outside over the volume of all rooms that openings join. Of a room: all the "
             "air that comes in, also from other rooms.</p>")
    if of_hours:
        text += ("<p>Over the climate's hours air changes are taken in proportion to the wind: calm hours, in which warmth alone moves "
                 "the air, count as almost none.</p>")
    elif climate and not case.follows_the_wind:
        text += ("<p>With warm air, fans or screens with a linear part, air changes are not in proportion to the wind, so there is no "
                 "mean over the climate's hours.</p>")
    return text


def _room_rows(case, run):
    for room in case.volumes:
        joining = [o.name for o in run.openings if room in o.rooms and o.rooms[0] != o.rooms[1]] + list(run.passages.get(room, {}))
        changes, fresh = run.air_changes(room), run.fresh(room)
        from_outside = 0.0 if fresh is None and joining else fresh
        row = [html.escape(room), f"{case.volumes[room]:.4g}", number(run.inflow(room)), number(from_outside),
               number(changes.last() if changes else None)]
        if run.age:
            age = run.mean_of(room, "age")
            row.append(number(None if age is None else age / 60.0))
        if run.warmth:
            mean = run.warmth.rooms.get(room)
            row += [number(mean.last() if mean else None, 4)]
        for scalar in case.scalars:
            row += _concentration(run, scalar, run.mean_of(room, scalar))[:2 if case.is_room else 1]
        yield [*row, ", ".join(map(html.escape, joining))]


def _concentration(run, scalar, mean):
    """A mean concentration, and how effective the ventilation is for it."""
    return [number(mean, 4), number(run.effectiveness(scalar, mean))]


def _rooms_of(case, run, fields):
    head = ["room", "volume, m³", "air in, m³/s", "of it from outside", "air changes per hour"]
    head += ["mean age of air, min"] if case.described.get("age_of_air") else []
    head += ["mean temperature, °C"] if run.warmth else []
    head += [title for scalar in case.scalars for title in (f"mean {scalar}", f"effectiveness for {scalar}")[:2 if case.is_room else 1]]
    text = table([*head, "openings"], _room_rows(case, run), "words")
    head = ["opening", "area, m²", "most air goes", "this way, m³/s", "back, m³/s", "mean speed through it, m/s"]
    head += ["heat carried this way, W"] if run.warmth else []
    text += table(head, [_opening_row(opening, run.warmth) for opening in run.openings])
    return text + _of_last_time(run) + _apart(case, run, fields) + _screens_of(case, run, fields)


def _apart_rows(case, run, fields, has_rest):
    """Of each room with openings to the outside: what it gets, what warmth alone would let in, and the rest."""
    for room, portals in stack.portals_of(case, run, fields).items():
        whole = run.fresh(room)
        warmer = run.warmth.rooms[room].last() - run.warmth.outdoors
        warm = stack.flow(portals, warmer, run.warmth.outdoors)
        parts = (whole, warm, stack.rest(whole, warm))[:3 if has_rest else 2]
        yield [html.escape(room), f"{warmer:+.3g}", *map(number, parts), *(number(3600.0 * part / case.volumes[room]) for part in parts)]


def _apart(case, run, fields):
    """How much warmth and wind move, apart; in calm air warmth alone."""
    has_fans = any(screen.curve for screen in case.screens)
    other = [] if not (case.has_wind or has_fans) else ["by all else"] if has_fans else ["by wind"]
    rows = list(_apart_rows(case, run, fields, bool(other))) if run.warmth and fields else []
    if not rows:
        return ""
    parts = [f"{part}, estimated" for part in ("by warmth alone", *other)]
    head = ("room", "warmer than outdoors by, K", "air from outside, m³/s", *parts, "air changes per hour from outside", *parts)
    text = table(head, rows)
    text += ("<p>Warmth alone is an estimate by the formula of openings between air at the room's mean temperature and air outdoors, with "
             f"a discharge coefficient of {stack.DISCHARGE:g}, screens, and openings to other rooms closed.")
    if other:
        text += (" Flows of several causes add up as squares: the rest is the root of the difference of the squares, and has the "
                 "errors of the formula.")
    return text + "</p>"


def _screens_of(case, run, fields):
    """How the pressure changes at screens and fans, and how it should."""
    rows = [[html.escape(name), html.escape(words), *(number(value) for value in values)]
            for name, words, *values in screens.rows(case.screens, run.openings, fields)]
    if not rows:
        return ""
    head = ("screen or fan", "", "air through it, m³/s", "mean speed, m/s", "pressure rises by, Pa", "by its rule, Pa")
    return table(head, rows) + (
        "<p>The pressure rises along the flow at fans, and falls at screens. <i>By its rule</i> takes the mean speed; what "
        "passes unevenly loses more.</p>")


def _opening_row(opening, warmth):
    ways = [(opening.forward(), opening.rooms), (opening.backward(), opening.rooms[::-1])]
    (most, rooms_), (least, _) = sorted(ways, key=lambda way: -way[0])
    speed = opening.both.last() / opening.area if opening.area > 0 else None
    way = html.escape(f"{rooms_[0]} → {rooms_[1]}")
    row = [html.escape(opening.name), f"{opening.area:.3g}", way, number(most), number(least), number(speed)]
    if warmth:
        heat = warmth.openings.get(opening.name)
        row.append(amount(heat.last() * (1.0 if rooms_ == opening.rooms else -1.0) if heat else None, warmth.heat_in()))
    return row


def _passage_rows(run):
    for name, flow in run.flows.items():
        area = run.areas.get(name, 0.0)
        net = flow.last()
        yield [html.escape(name), run.roles[name], f"{area:.3g}", number(max(-net, 0.0)), number(max(net, 0.0)),
               number(abs(net) / area if area > 0 else None),
               *(number(run.concentration_at(scalar, name), 4) for scalar in run.case.scalars)]


def ventilation(case):
    """What comes into a room and leaves it, and how often the air changes."""
    run = case.runs[0]
    text = "<h2>Inlets and outlets</h2>"
    changes = run.supplied_changes()
    if changes is None or changes.last() <= 0.0:
        return text + "<p>No flow through inlets and outlets is measured.</p>"
    text += table(("patch", "role", "area, m²", "air in, m³/s", "air out, m³/s", "mean speed through it, m/s", *case.scalars),
                   _passage_rows(run))
    facts = [f"{case.mesh['volume']:.4g} m³ of air",
             f"<b>{changes.last():.3g}</b> air changes per hour, one in {duration(60.0 / changes.last())}"]
    if run.age and (age := run.mean_of("", "age")) is not None:
        facts.append(f"its mean age is {duration(age / 60.0)}")
    facts += _facts_of_scalars(run)
    return text + f"<p>{'; '.join(facts)}.</p>" + (_of_last_time(run) if not case.openings else "")


def _of_last_time(run):
    """That means of scalars and the age are of the last time, where no others are known."""
    names = ["the age of air" if name == "age" else html.escape(name) for name in run.of_last_time()]
    if not names:
        return ""
    last = f"time, {run.fields.time:g} s" if run.is_transient else f"iteration, {run.fields.time:.0f}"
    return f"<p>Means of {' and '.join(names)} are those of the last {last}; the case does not measure them before.</p>"


def _facts_of_scalars(run):
    for scalar in run.scalars:
        mean = run.mean_of("", scalar)
        effectiveness = run.effectiveness(scalar, mean)
        yield f"its mean {html.escape(scalar)} is {number(mean, 4)}" + (
            f", and the ventilation is {number(effectiveness)} times as effective as with mixed air" if effectiveness is not None else "")


def rooms(case, fields_of, climate):
    text = ventilation(case) if case.is_room else ""
    if case.is_room and not case.openings:
        return text
    return text + _rooms_and_openings(case, fields_of, climate)


def _rooms_and_openings(case, fields_of, climate):
    if not case.openings and not case.volumes:
        return ("<h2>Rooms and openings</h2><p>The mesh has no openings (face zones) and no rooms (cell zones). "
                "<code>atria mesh --openings</code> finds them.</p>")
    text = "<h2>Rooms and openings</h2>"
    if not any(run.openings for run in case.runs):
        return text + "<p>No flow through openings is measured: the case has not run.</p>"
    if case.ventilated:
        text += _summary(case, climate)
    several = len(case.runs) > 1
    return text + "".join(folded(run.title, _rooms_of(case, run, fields_of.get(run)), several) for run in case.runs)
