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
        lines += ["", f"snappyHexMesh's layer is on {100 * min(covered):.0f} % of the requested faces."]
    return lines


def rises(peaks):
    """Phases in which the peak rises by a tenth of its last value since the one listed before."""
    before, last = 0.0, peaks[-1][1]
    for phase, peak in peaks:
        if peak >= before + 0.1 * last:
            yield phase, peak
            before = peak


def stages(found):
    lines = [row("stage", "s, 1 thread", "s, 2 threads"), row("---", "---", "---")]
    one, two = (found["Atria"].get(n) for n in ("1", "2"))
    for stage in list((one or two)["stages"])[1:]:  # reading takes milliseconds
        lines.append(row(stage, *(f"{r['stages'][stage]:.3f}" if r else "" for r in (one, two))))
    lines += ["", row("while", "peak memory, bytes an element"), row("---", "---")]
    result = one or two
    return lines + [row(phase or "Starting", f"{peak / result['elements']:.0f}") for phase, peak in rises(result["peaks"])]


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


def without_repeats(found, case, bare):
    """Results but those of peers that another case has: gmsh grows no layer in any."""
    return {mesher: by_threads for mesher, by_threads in found.items()
            if mesher == "Atria" or not (case.like or mesher == "gmsh" and case.name in bare)}


def octrees(series):
    lines = [row("octree and 2:1 balance of", "leaves", "s of the processor", "leaves a s"), row(*["---"] * 4)]
    return lines + [row(r["name"].replace("/", ", depth "), f"{r['leaves']:,}", f"{r['seconds']:.4f}",
                        f"{r['leaves'] / r['seconds']:,.0f}") for r in series]


def report(results, cases):
    m = results["machine"]
    lines = [
        "# Benchmarks of smooth and aligned models", "",
        "Written by `Testing/Benchmarks/compare.py` in one run:",
        f"{m['processor']}, {m['cores']} cores, {m['memory'] / 2**30:.0f} GB, {m['date']}, load {m['load']:.1f} before.", "",
        "- Times are of whole processes, from the file to the mesh in memory.",
        "- gmsh makes tetrahedra without layers. snappyHexMesh has Atria's layer, on the building at the sheets only.",
        "- Bytes are the peak of resident memory of all processes, by stage where it rises by a tenth.",
        "- Atria aims at 20° and a skewness of 0.5 at the sphere. With 30° and 0.75 its layer is as good as snappyHexMesh's (27–40° and",
        "  0.69–0.80).", ""]
    if m["load"] > 0.5:
        lines += ["Other programs kept the machine busy. Seconds of the processor hold nevertheless; those of the clock, and with them what",
                  "several threads gain, do not.", ""]
    lines += verdicts(results, cases)
    bare = {case.bare for case in cases}
    for case in cases:
        if found := results["meshers"].get(case.name):
            lines += ["", f"## {case.title}", "", *comparison(without_repeats(found, case, bare))]
            staged = [r for r in found["Atria"].values() if r and "stages" in r]
            if staged and not (case.like or case.name in bare):
                lines += ["", *stages(found)]
            elif staged:  # of the same model and sizes as a case before
                lines += ["", f"Layers take {' and '.join(format(r['stages']['layers'], '.3f') for r in staged)} s, other stages as above."]
            if by_threads := results.get("after", {}).get(case.name):
                lines += ["", *after(by_threads, found["Atria"])]
    if series := results.get("octrees"):
        lines += ["", "## Octree and balance, one core", "", "Across faces, edges and corners.", "",
                  *octrees(series[-2:])]  # the deepest
    for name, series in results.get("elements", {}).items():
        lines += ["", f"## Growth with elements, {name} sphere, one thread", "", *growth(series, "elements")]
    if series := results.get("triangles"):
        lines += ["", "## Growth with the model's triangles, uniform sphere, one thread", "", *growth(series, "triangles")]
    return "\n".join(lines) + "\n"
