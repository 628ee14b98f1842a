# SPDX-License-Identifier: GPL-3.0-or-later
"""A build of Atria whose tuning constants are taken from the environment.

A copy of the sources takes each constant from a function that looks for it in a variable, so that one build serves all.
Constants are the `constexpr` numbers in Filters/Core; tables of numbers, each as a whole; defaults of options that are
no user's; and all numbers in the functions that set the stages of the improver. A number is multiplied, a whole number
changes by one at least. A cosine, by its name, stands for an angle, and it is the angle that changes; of what is within
5 % of 1 it is the rest.

Numbers that the compiler needs (sizes of arrays) stay as they are, and so do those that only divide work among threads
or guard against rounding, limits of what users may ask for, and rooms that judge or report: none of these steers a mesh.
"""

import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess

from fingerprints import ROOT

CORE = "Filters/Core"
VARIABLE = "ATRIA_TUNE"
TYPES = "double|float|int|std::size_t|std::int64_t"
DEFINITION = re.compile(r"^(?P<head>\s*(?:inline |static )*)(?:constexpr|const(?= double \w+ = cosOfDegrees\()) "
                        rf"(?P<type>{TYPES}) (?P<name>\w+) = "
                        r"(?P<value>[^;]*\d[^;]*);", re.MULTILINE)
TABLE = re.compile(r"^(?P<head>\s*(?:inline |static )*)constexpr (?P<type>QualityRange|CurvedWallTargets|std::array) (?P<name>\w+)"
                   r"(?P<value>\{[^;]*\d\.\d[^;]*\});", re.MULTILINE)
MEMBER = re.compile(r"^(?P<head>  )(?P<type>double|int) (?P<name>\w+) = (?P<value>[\d.e-]*[1-9][\d.e-]*);", re.MULTILINE)
RANGE = re.compile(r"^(?P<head>  )(?P<type>QualityRange) (?P<name>\w+)(?P<value>\{[^;]*\d\.\d[^;]*\});", re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.])(?P<value>\d+\.\d+)(?P<float>F?)(?![\w.])|(?<=sweeps = )(?P<whole>\d+)")
WITH_MEMBERS = ("Optimize/Kernel/Optimizer.h", "Optimize/Kernel/QualityTargets.h", "Layer/LayerWalls.h")
WITH_FUNCTIONS = ("Mesher/Improvement/ImproverStages.cxx",)
NO_MESH = ("Quality", "Support", "Surface/Inspection", "Domain/DomainCheck", "Mesher/Preflight", "Mesher/SuggestedSizes",
           "Octree/Sizing/Estimate", "Octree/Sizing/ElementBudget", "Octree/Sizing/OctantSample", "Optimize/AnyMesh",
           "Layer/LayerBudget", "Octree/Sizing/Sizing.h", "Domain/WindDomain")
NO_TUNING = re.compile(r"grain|tiny|rounding|noise|partLength|leastPiece|few|many|width|keyBits|latticeBits|perDegree|"
                       r"rounder|roundingUnits|leafSize|unset|maximumDepth|octreeShare|far|length|largest|slack|quarter|"
                       r"square|surely|mostNumbers|longList|enough|manyEach|mostWays|smallestGain|tie|noArea|anything|"
                       r"cellsAcross|fewestPrismSides|mostPrismSides|maximumGrowth|straight")
HEADER = """#pragma once
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <type_traits>
namespace atria {
enum class Vary { size, cosine, difference };
template <typename T> T tuned(const char* key, T value, Vary vary)
{
  const char* wanted = std::getenv("ATRIA_TUNE");
  const std::size_t length = std::strlen(key);
  if (!wanted || std::strncmp(wanted, key, length) != 0 || wanted[length] != '=')
    return value;
  const double factor = std::atof(wanted + length + 1);
  const double v = static_cast<double>(value);
  if (std::is_integral_v<T>)
  {
    const double changed = std::round(v * factor);
    return static_cast<T>(changed != v ? changed : v + (factor > 1.0 ? 1.0 : -1.0));
  }
  return static_cast<T>(vary == Vary::cosine       ? std::cos(std::fmin(std::acos(v) * factor, 3.14159265358979))
                        : vary == Vary::difference ? 1.0 + (v - 1.0) * factor
                                                   : v * factor);
}
}
"""


class Constant:
    def __init__(self, file, name, value, kind):
        self.file, self.name, self.value, self.kind = file, name, re.sub(r"\s+", " ", value.strip()), kind
        self.key = f"{file}:{name}"
        number = float(self.value) if re.fullmatch(r"-?[\d.]+(e-?\d+)?", self.value) else 0.0
        cosine = kind == "double" and "osine" in name and (number == 0.0 or abs(number) > 0.3)
        near_one = re.match(r"1\.0 [+-]", self.value) or 0.0 < abs(number - 1.0) <= 0.0501
        self.vary = "cosine" if cosine and not near_one else "difference" if near_one else "size"

    def steers(self):
        return not self.file.startswith(NO_MESH) and not NO_TUNING.fullmatch(self.name)

    def tuned(self, value=None, kind=None):
        return f'atria::tuned<{kind or self.kind}>("{self.key}", {value or self.value}, atria::Vary::{self.vary})'

    def tuned_table(self):
        return NUMBER.sub(lambda m: self.tuned(m[0], "float" if m["float"] else "double"), self.value)


class Rewriter:
    """Makes the constants of one file tunable, but for those kept, and collects them."""

    def __init__(self, file, kept):
        self.file, self.kept, self.found, self.keys = file, kept, [], set()

    def constant(self, name, value, kind):
        """None where it does not steer; names that come again in a file get primes."""
        out = Constant(self.file, name, value, kind)
        while out.key in self.keys:
            out.key += "'"
        self.keys.add(out.key)
        if out.key in self.kept or not out.steers():
            return None
        self.found.append(out)
        return out

    def definition(self, match):
        """A variable: in a function one that lives on, in a class one for all."""
        out = self.constant(match["name"], match["value"], match["type"])
        if not out:
            return match[0]
        head = match["head"]
        if head.startswith("  "):
            member = "static" in head and "constexpr" in match[0]
            head = head.replace("static", "inline static") if member else head if "static" in head else head + "static "
        is_table = "{" in out.value
        return f"{head}const {match['type']} {out.name}" + (out.tuned_table() if is_table else f" = {out.tuned()}") + ";"

    def member(self, match):
        out = self.constant(match["name"], match["value"], match["type"])
        if not out:
            return match[0]
        value = out.tuned_table() if "{" in out.value else f" = {out.tuned()}"
        return f"{match['head']}{match['type']} {out.name}{value};"

    def functions(self, text):
        """All numbers in functions, but for 0, 1 and 180, by the function's name and their order in it."""
        name, count, lines = "", itertools.count(1), []

        def number(match):
            if match[0].rstrip("F") in ("0.0", "1.0", "180.0"):
                return match[0]
            kind = "float" if match["float"] else "int" if match["whole"] else "double"
            out = self.constant(f"{name} {next(count)}", match[0], kind)
            return out.tuned() if out else match[0]

        for line in text.split("\n"):
            begin = re.match(r"\w.*?(\w+)\(", line)
            if begin:
                name, count = begin[1], itertools.count(1)
            code, *comment = line.split("//", 1)
            plain = name and "tuned<" not in code and not code.startswith("constexpr")
            lines.append("//".join([NUMBER.sub(number, code) if plain else code, *comment]))
        return "\n".join(lines)

    def __call__(self, source):
        text = TABLE.sub(self.definition, DEFINITION.sub(self.definition, source))
        if self.file in WITH_MEMBERS:
            text = RANGE.sub(self.member, MEMBER.sub(self.member, text))
        if self.file in WITH_FUNCTIONS:
            text = self.functions(text)
        if text == source:
            return source
        at = text.index("#include") if "#include" in text else text.index("#pragma once") + len("#pragma once\n")
        return text[:at] + '#include "Support/Tuned.h"\n' + text[at:]


def rewrite(copy, kept):
    """Makes the constants in a copy of the core tunable; returns them."""
    found = []
    for path in sorted((ROOT / CORE).rglob("*")):
        if path.suffix in (".h", ".cxx"):
            file = path.relative_to(ROOT / CORE).as_posix()
            rewriter = Rewriter(file, kept)
            text = rewriter(path.read_text())
            found += rewriter.found
            write(copy / CORE / file, text)
    write(copy / CORE / "Support" / "Tuned.h", HEADER)
    return found


def write(path, text):
    """Leaves a file that is the same, so that it is not compiled again."""
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def copy_others(copy):
    """All that is not the core."""
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in filter(None, tracked.stdout.split("\0")):
        source, target = ROOT / name, copy / name
        if name.startswith(CORE) and source.suffix in (".h", ".cxx") or not source.exists():
            continue
        if not target.exists() or target.read_bytes() != source.read_bytes():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)


def kept_in(work):
    """The constants that the compiler needs, as earlier builds told."""
    file = work / "kept.json"
    return set(json.loads(file.read_text())) if file.exists() else set()


def constants_of(work):
    return rewrite(work / "source", kept_in(work))


def build(work):
    """A program whose constants are tunable."""
    copy, kept = work / "source", kept_in(work)
    copy_others(copy)
    constants = constants_of(work)
    subprocess.run(["cmake", "--preset", "vtk", "-DATRIA_BUILD_TESTING=OFF"], cwd=copy, check=True,
                   stdout=subprocess.DEVNULL, env={**os.environ, "ATRIA_COMPILER_LAUNCHER": shutil.which("ccache") or ""})
    while True:
        run = subprocess.run(["ninja", "-j", str(os.cpu_count()), "-k0", "-C", "build/vtk", "atria"], cwd=copy, capture_output=True, text=True)
        if run.returncode == 0:
            return copy / "build" / "vtk" / "bin" / "atria"
        # Complaints that a constant expression is none name the constant.
        named = set(re.findall(r"error: .*?[‘'](?:[\w{}]+::| )*(\w+)[’']", run.stdout))
        more = {c.key for c in constants if c.name in named and pathlib.Path(c.file).name in run.stdout} - kept
        if not more:
            (work / "build.log").write_text(run.stdout)
            raise SystemExit(f"the copy does not build: see {work}/build.log")
        kept |= more
        (work / "kept.json").write_text(json.dumps(sorted(kept)))
        constants = rewrite(copy, kept)
