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


def comparison(found):
    lines = [row("mesher", "threads", "elements", "s", "s of the processor", "elements a s of the processor",
                 "bytes an element", "times Atria's time"), row(*["---"] * 8)]
    for mesher, by_threads in found.items():
        for threads, result in by_threads.items():
            if not result:
                lines.append(row(mesher, threads, "failed", *[""] * 5))
                continue
            ours = found["Atria"].get(threads)
            lines.append(row(mesher, threads, f"{result['elements']:,}", f"{result['wall']:.2f}",
                             f"{result['processor']:.2f}", f"{result['elements'] / result['processor']:,.0f}",
                             f"{result['bytes'] / result['elements']:.0f}",
                             f"{result['wall'] / ours['wall']:.1f}" if ours else ""))
    covered = [r["covered"] for r in found.get("snappyHexMesh", {}).values() if r and "covered" in r]
    if covered:
        lines += ["", f"snappyHexMesh's layer is on {100 * min(covered):.0f} % of the faces asked for."]
    return lines


def stages(found):
    lines = [row("stage", "s, 1 thread", "s, 2 threads"), row("---", "---", "---")]
    one, two = (found["Atria"].get(n) for n in ("1", "2"))
    for stage in (one or two)["stages"]:
        lines.append(row(stage, *(f"{r['stages'][stage]:.3f}" if r else "" for r in (one, two))))
    lines += ["", row("while", "peak memory, bytes an element"), row("---", "---")]
    result = one or two
    return lines + [row(phase or "Starting", f"{peak / result['elements']:.0f}") for phase, peak in result["peaks"]]


AFTER = {"quality": "the quality filter", "write_vtu": "writing .vtu", "write_openfoam": "writing OpenFOAM's files"}


def after(by_threads, ours):
    """What follows a mesh, beside the time it took itself."""
    lines = [row("after it", *(f"s, {threads} threads" for threads in by_threads), "times meshing"),
             row(*["---"] * (len(by_threads) + 2))]
    most = list(by_threads)[-1]
    for key, name in AFTER.items():
        if key in by_threads[most]:
            ratio = f"{by_threads[most][key] / ours[most]['wall']:.2f}" if ours.get(most) else ""
            lines.append(row(name, *(f"{stages[key]:.3f}" for stages in by_threads.values()), ratio))
    return lines


def verdicts(results, cases):
    """What was aimed for, and what was got."""
    lines = [row("aim", "got"), row("---", "---")]
    for case in cases:
        found = results["meshers"].get(case.name, {})
        ours, theirs = (found.get(m, {}).get("2") for m in ("Atria", "snappyHexMesh"))
        bare = results["meshers"].get(case.bare, {}).get("snappyHexMesh", {}).get("2")
        if ours and theirs:
            aim = f"{case.target:g} times" if case.target else "how many times"
            lines.append(row(f"{case.title}: {aim} faster than snappyHexMesh, 2 threads",
                             f"{theirs['wall'] / ours['wall']:.1f} times"))
        if ours and bare:
            lines.append(row(f"{case.title}: the same, but snappyHexMesh grows none",
                             f"{bare['wall'] / ours['wall']:.1f} times"))
        one, single = (found.get(m, {}).get("1") for m in ("Atria", "snappyHexMesh"))
        if one and single:
            ratio = one["elements"] / one["processor"] / (single["elements"] / single["processor"])
            lines.append(row(f"{case.title}: elements a second of the processor, one thread, over snappyHexMesh's",
                             f"{ratio:.1f} times"))
        if case.name == "uniform" and one and ours:
            lines.append(row("1.7 times over one thread, uniform", f"{one['wall'] / ours['wall']:.2f} times"))
        after_it = results.get("after", {}).get(case.name, {}).get("2", {})
        for key in ("write_vtu", "write_openfoam"):
            if ours and key in after_it:
                lines.append(row(f"{case.title}: {AFTER[key]} at most once its meshing, 2 threads",
                                 f"{after_it[key] / ours['wall']:.2f} times"))
        limit = {"uniform": 350, "adaptive": 600}.get(case.name)
        if limit and one:
            lines.append(row(f"At most {limit} B an element, {case.name}", f"{one['bytes'] / one['elements']:.0f} B"))
    for name, series in results.get("elements", {}).items():
        if len(series) > 1:
            xs = [r["elements"] for r in series]
            for what in ("processor", "bytes"):
                lines.append(row(f"Exponent of {'time' if what == 'processor' else 'memory'} in elements between 0.95 "
                                 f"and 1.05, {name}, {xs[0]:,} to {xs[-1]:,}",
                                 f"{exponent(xs, [r[what] for r in series]):.2f}"))
    return lines


def growth(series, key):
    keys = list(dict.fromkeys([key, "elements"]))
    lines = [row(*keys, "s of the processor", "bytes an element"), row(*["---"] * (len(keys) + 2))]
    for r in series:
        lines.append(row(*(f"{r[k]:,}" for k in keys), f"{r['processor']:.2f}", f"{r['bytes'] / r['elements']:.0f}"))
    return lines


def octrees(series):
    lines = [row("octree and 2:1 balance of", "leaves", "s of the processor", "leaves a s"), row(*["---"] * 4)]
    return lines + [row(r["name"].replace("/", ", depth "), f"{r['leaves']:,}", f"{r['seconds']:.4f}",
                        f"{r['leaves'] / r['seconds']:,.0f}") for r in series]


def report(results, cases):
    m = results["machine"]
    lines = [
        "# Benchmarks of smooth and aligned models", "",
        "Written by `Testing/Benchmarks/compare.py`. All figures are of one run of it, so ratios hold between them; seconds hold for",
        f"this machine: {m['processor']}, {m['cores']} cores, {m['memory'] / 2**30:.0f} GB, {m['system']}, {m['date']}, load "
        f"{m['load']:.1f} before.", "",
        "Atria's time is that of the whole process, from the file to the mesh as VTK data, nothing written; of snappyHexMesh it ends",
        "before the mesh is written, and gmsh writes none. gmsh's elements are tetrahedra and have no layer. snappyHexMesh is asked for",
        "the same layer as Atria, of the building on the sheets only. Bytes are the peak of resident memory, of all processes together.",
        "With 30° and 0.75 the layer of the sphere is as good as snappyHexMesh's faces there (27-40° and 0.69-0.80); unasked, 20° and",
        "0.5 are aimed at, which takes longer.", ""]
    if m["load"] > 0.5:
        lines += ["Other programs kept the machine busy. Seconds of the processor hold nevertheless; those of the clock, and with them what",
                  "several threads gain, do not.", ""]
    lines += verdicts(results, cases)
    for case in cases:
        if found := results["meshers"].get(case.name):
            lines += ["", f"## {case.title}", "", *comparison(found)]
            if any(r and "stages" in r for r in found["Atria"].values()):
                lines += ["", *stages(found)]
            if by_threads := results.get("after", {}).get(case.name):
                lines += ["", *after(by_threads, found["Atria"])]
    if series := results.get("octrees"):
        lines += ["", "## Octree and balance, one core", "", "Across faces, edges and corners, of the same refinement.", "",
                  *octrees(series)]
    for name, series in results.get("elements", {}).items():
        lines += ["", f"## Growth with elements, {name} sphere, one thread", "", *growth(series, "elements")]
    if series := results.get("triangles"):
        lines += ["", "## Growth with the model's triangles, uniform sphere, one thread", "", *growth(series, "triangles")]
    return "\n".join(lines) + "\n"
