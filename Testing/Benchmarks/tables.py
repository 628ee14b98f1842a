# SPDX-License-Identifier: GPL-3.0-or-later
"""What compare.py measured, as Markdown."""

import math


def short(result):
    if not result:
        return "failed"
    per_second = result["elements"] / result["processor"]
    return (f"{result['elements']} elements, {result['wall']:.2f} s, {result['processor']:.2f} s of the processor, "
            f"{per_second / 1e3:.1f} k/s, {result['bytes'] / result['elements']:.0f} B each")


def exponent(xs, ys):
    """Of the power law that fits best."""
    pairs = [(math.log(x), math.log(y)) for x, y in zip(xs, ys)]
    mx, my = (sum(p[i] for p in pairs) / len(pairs) for i in (0, 1))
    return sum((x - mx) * (y - my) for x, y in pairs) / sum((x - mx) ** 2 for x, _ in pairs)


def row(*cells):
    return "| " + " | ".join(str(c) for c in cells) + " |"


def heading(*cells):
    return [row(*cells), "|" + "---|" * len(cells)]


def joined(values, form):
    """Values of all numbers of threads, separated by slashes; one if all are the same."""
    texts = [format(value, form) for value in values]
    return texts[0] if len(set(texts)) == 1 else "/".join(texts)


def comparison(found):
    lines = heading("mesher", "elements", "s on 1/2 threads", "s of the processor", "bytes an element", "times Atria's time")
    for mesher, by_threads in found.items():
        made = {threads: result for threads, result in by_threads.items() if result}
        if not made:
            lines.append(row(mesher, "failed", *[""] * 4))
            continue
        ours = {threads: found["Atria"].get(threads) for threads in made}
        ratios = [result["wall"] / ours[threads]["wall"] for threads, result in made.items() if ours[threads]]
        lines.append(row(mesher + "".join(f", failed on {threads}" for threads in by_threads if threads not in made),
                         joined([r["elements"] for r in made.values()], ",d"), joined([r["wall"] for r in made.values()], ".2f"),
                         joined([r["processor"] for r in made.values()], ".2f"),
                         joined([r["bytes"] / r["elements"] for r in made.values()], ".0f"), joined(ratios, ".1f") if ratios else ""))
    covered = [r["covered"] for r in found.get("snappyHexMesh", {}).values() if r and "covered" in r]
    if covered:
        lines += ["", f"snappyHexMesh's layer is on {100 * min(covered):.0f} % of the requested faces."]
    return lines


AFTER = {"quality": "the quality filter", "write_vtu": "writing .vtu", "write_openfoam": "writing OpenFOAM's files"}


def after(works):
    """What follows a mesh, by case and threads."""
    lines = heading("s on 1/2 threads", *works)
    for key, name in AFTER.items():
        if any(key in seconds for by_threads in works.values() for seconds in by_threads.values()):
            lines.append(row(name, *(joined([seconds[key] for seconds in by_threads.values() if key in seconds], ".3f")
                                     for by_threads in works.values())))
    return lines


def verdicts(results, cases):
    """What was aimed for, and what was got."""
    lines = heading("aim", "got")
    for case in cases:
        found = results["meshers"].get(case.name, {})
        ours, theirs = (found.get(m, {}).get("2") for m in ("Atria", "snappyHexMesh"))
        bare = results["meshers"].get(case.bare, {}).get("snappyHexMesh", {}).get("2")
        if ours and theirs and case.target:
            lines.append(row(f"{case.title}: {case.target:g} times faster than snappyHexMesh, 2 threads",
                             f"{theirs['wall'] / ours['wall']:.1f} times"))
        if ours and bare:
            lines.append(row(f"{case.title}: the same, but snappyHexMesh grows none",
                             f"{bare['wall'] / ours['wall']:.1f} times"))
        one = found.get("Atria", {}).get("1")
        if case.name == "uniform" and one and ours:
            lines.append(row("1.7 times over one thread, uniform", f"{one['wall'] / ours['wall']:.2f} times"))
        limit = {"uniform": 350, "adaptive": 600}.get(case.name)
        if limit and one:
            lines.append(row(f"At most {limit} B an element, {case.name}", f"{one['bytes'] / one['elements']:.0f} B"))
    for name, series in results.get("elements", {}).items():
        if len(series) > 1:
            xs = [r["elements"] for r in series]
            for what in ("processor", "bytes"):
                lines.append(row(f"Exponent of {'time' if what == 'processor' else 'memory'} in elements 0.95 to 1.05, {name}",
                                 f"{exponent(xs, [r[what] for r in series]):.2f}"))
    return lines


def growth(sets):
    """The least and the most of each series; `sets` has series by name."""
    lines = heading("growth, one thread", "triangles", "elements", "s of the processor", "bytes an element")
    for name, series in sets.items():
        for r in (series[0], series[-1]):
            triangles = f"{r['triangles']:,}" if "triangles" in r else ""
            lines.append(row(name, triangles, f"{r['elements']:,}", f"{r['processor']:.2f}", f"{r['bytes'] / r['elements']:.0f}"))
    return lines


def without_repeats(found, case, bare):
    """Results but those of peers that another case has: gmsh grows no layer in any."""
    return {mesher: by_threads for mesher, by_threads in found.items()
            if mesher == "Atria" or not (case.like or mesher == "gmsh" and case.name in bare)}


def octrees(series):
    return heading("octree and 2:1 balance of", "leaves", "s of the processor") + [row(r["name"].replace("/", ", depth "), f"{r['leaves']:,}", f"{r['seconds']:.4f}") for r in series]


def report(results, cases):
    m = results["machine"]
    lines = [
        "# Benchmarks of smooth and aligned models", "",
        "Written by `Testing/Benchmarks/compare.py` in one run:",
        f"{m['processor']}, {m['cores']} cores, {m['memory'] / 2**30:.0f} GB, {m['date']}, load {m['load']:.1f} before.", "",
        "- Times are of whole processes, from the file to the mesh in memory.",
        "- gmsh makes tetrahedra without layers. snappyHexMesh has Atria's layer, on the building at the sheets only.",
        "- Bytes are the peak of resident memory of all processes.",
        "- Atria aims at 20° and a skewness of 0.5 at the sphere. With 30° and 0.75 its layer is as good as snappyHexMesh's (27–40° and",
        "  0.69–0.80).", ""]
    if m["load"] > 0.5:
        lines += ["Other programs kept the machine busy. Seconds of the processor hold nevertheless; those of the clock, and with them what",
                  "several threads gain, do not.", ""]
    lines += verdicts(results, cases)
    bare = {case.bare for case in cases}
    for case in cases:
        if found := results["meshers"].get(case.name) if case.name not in bare else None:
            lines += ["", f"## {case.title}", "", *comparison(without_repeats(found, case, bare))]
            staged = [r for r in found["Atria"].values() if r and "stages" in r]
            if staged and case.like:  # of the same model and sizes as a case before
                lines += ["", f"Layers take {' and '.join(format(r['stages']['layers'], '.3f') for r in staged)} s, other stages hardly differ."]
    names = [case.name for case in cases if not (case.like or case.name in bare)]
    if works := {name: results["after"][name] for name in names if name in results.get("after", {})}:
        lines += ["", "## After meshing", "", *after(works)]
    if series := results.get("octrees"):
        lines += ["", "## Octree and balance, one core", "", "Across faces, edges and corners.", "",
                  *octrees(series[-2:])]  # the deepest
    sets = {f"{name} sphere": series for name, series in results.get("elements", {}).items()}
    if results.get("triangles"):
        sets["uniform sphere of more triangles"] = results["triangles"]
    if sets:
        lines += ["", "## Growth", "", *growth(sets)]
    return "\n".join(lines) + "\n"
