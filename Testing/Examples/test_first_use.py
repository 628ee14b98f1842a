# SPDX-License-Identifier: GPL-3.0-or-later
"""What who begins with the command line meets: defaults, summary, options in files, messages, completion.

Usage: test_first_use.py ATRIA FOLDER_OF_MODELS
"""

import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[1]).resolve()
HOUSE = (pathlib.Path(sys.argv[2]) / "house.wrl").resolve()
COARSE = ["--size-max", "16", "--size-mid", "4", "--size-min", "2", "--site", "Site"]
COMMANDS = ["mesh", "inspect", "quality", "improve", "convert"]


class FirstUse(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def atria(self, *arguments, **options):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=self.folder,
                              **options)

    def refuses(self, status, text, *arguments):
        run = self.atria(*arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertIn(text, run.stderr)
        return run

    def options(self, command):
        """Long options of the help, without --help."""
        # Later versions of CLI11 put more blanks before options, and most before lines of their texts.
        names = re.findall(r"^ {2,10}(?:-\w, *)?(--[a-z0-9-]+)", self.atria(command, "--help").stdout, re.MULTILINE)
        return [name for name in dict.fromkeys(names) if name != "--help"]

    def test_a_model_alone_is_meshed(self):
        run = self.atria("mesh", HOUSE)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertEqual([file.name for file in self.folder.iterdir()], ["house.vtu"])
        sizes = re.search(r"--size-max (\S+) --size-mid (\S+) --size-min (\S+)", run.stderr)
        high, mid, low = map(float, sizes.groups())
        self.assertEqual(mid, 2 * low)
        self.assertGreaterEqual(high, 4 * mid)
        elements = int(re.search(r"^elements +(\d+)", run.stdout, re.MULTILINE).group(1))
        self.assertTrue(10_000 < elements < 1_000_000, elements)
        self.assertRegex(run.stderr, r"--seed( -?\d+(\.\d{1,3})?){3} means it")

    def test_the_examples_pass_all_checks_by_themselves(self):
        for name in ("house.wrl", "house_turned17.wrl", "building.wrl"):
            for layers in ("0", "1"):
                run = self.atria("mesh", HOUSE.parent / name, "--layers", layers, "--openfoam", "case")
                self.assertIn(run.returncode, (0, 4), (name, layers, run.stderr))
                self.assertRegex(run.stdout, r"(?m)^checks +all of checkMesh's pass", (name, layers))

    def test_sketchups_model_is_told_from_one_in_meters(self):
        run = self.atria("inspect", HOUSE.parent / "sketchup_house.wrl")
        for option in ("--unit", "--up", "--surfaces-by group"):
            self.assertRegex(run.stderr, rf"warning: sketchup_house.wrl: .*{option}\b")
        run = self.atria("inspect", HOUSE.parent / "sketchup_house.wrl", "--unit", "in", "--up", "y", "--surfaces-by", "group")
        self.assertNotIn("warning", run.stderr)
        self.assertIn("WallSouth", run.stdout)

    def test_sizes_follow_the_model(self):
        mids = []
        for scale in (0.01, 1, 100):
            run = self.atria("mesh", HOUSE, "--scale", scale, "--unit", "m", "--estimate")
            self.assertEqual(run.returncode, 0, run.stderr)
            mids.append(float(re.search(r"--size-mid (\S+)", run.stderr).group(1)))
        self.assertAlmostEqual(mids[1] / mids[0], 100)
        self.assertAlmostEqual(mids[2] / mids[1], 100)

    def test_sizes_that_are_not_given_follow_those_that_are(self):
        house = {"--size-max": 8, "--size-mid": 2, "--size-min": 1}
        estimates = set()
        for given in ([], ["--size-max"], ["--size-mid"], ["--size-min"], ["--size-mid", "--size-min"], list(house)):
            run = self.atria("mesh", HOUSE, *(word for name in given for word in (name, house[name])), "--estimate")
            self.assertEqual(run.returncode, 0, run.stderr)
            if given:
                told = " ".join(f"{name} {size}" for name, size in house.items() if name not in given)
                self.assertRegex(run.stderr, rf"^[^\n]*house.wrl: sizes that are not given: {told}\n$" if told else "^$")
                estimates.add(run.stdout)
        self.assertEqual(len(estimates), 1)

    def test_the_largest_size_follows_the_domain(self):
        highs = []
        for half in (30, 300, 3000):
            run = self.atria("mesh", HOUSE, "--size-min", "1", "--size-mid", "2", "--estimate", "--domain", -half, half,
                             -half, half, 0, half)
            self.assertEqual(run.returncode, 0, run.stderr)
            highs.append(float(re.search(r"--size-max (\S+)", run.stderr).group(1)))
        self.assertEqual(highs[0], 8)
        self.assertTrue(highs[0] < highs[1] < highs[2] < 1000, highs)

    def test_the_summary_is_that_of_the_report(self):
        run = self.atria("mesh", HOUSE, *COARSE, "-o", "mesh.vtu", "--patches", "patches.vtpc", "--openfoam", "case",
                         "--report", "report.json")
        self.assertIn(run.returncode, (0, 4, 5), run.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        lines = dict(re.findall(r"^(elements|not valid|checks|worst|patches|repaired|left out|time|memory|files) +(.*)$", run.stdout,
                                re.MULTILINE))
        self.assertEqual(len(lines), 10, run.stdout)
        counts = report["counts"]
        self.assertTrue(lines["elements"].startswith(f"{counts['elements']}: {counts['hexahedra']} hexahedra"), lines)
        self.assertIn(f"{counts['vertices']} vertices", lines["elements"])
        self.assertEqual(lines["not valid"], str(report["invalid_elements"] or "none"))
        failed = [f"{name} at {check['failing']} {check['of']}" for name, check in report["openfoam"]["checks"].items()
                  if check["is_error"] and check["failing"]]
        self.assertEqual(lines["checks"], "fail: " + ", ".join(failed) if failed else "all of checkMesh's pass")
        self.assertIn("non-orthogonality %.3g degrees" % report["quality"]["NonOrthogonality"]["max"], lines["worst"])
        self.assertTrue(lines["patches"].startswith(f"{len(report['patches'])}: {report['patches'][0]['name']}, "))
        self.assertIn(f"{report['repair']['SplitTriangles']} triangles cut", lines["repaired"])
        self.assertIn("insides of solids 1", lines["left out"])
        for name in ("mesh.vtu", "patches.vtpc", "case", "report.json"):
            self.assertRegex(run.stdout, re.escape(name) + r" \([\d.e+]+ [kMG]B\)")

    def test_help_has_groups_and_examples_that_work(self):
        text = self.atria("mesh", "--help").stdout
        for group in ("Model", "Sizes, in meters", "Domain", "Fluid", "Layers on walls", "Repair", "Output", "Run"):
            self.assertIn(f"\n{group}:\n", text)
        self.assertFalse(re.search(r"\d{20}|e\+?308|e-3\d\d", "".join(self.atria(c, "--help").stdout for c in COMMANDS)))
        shutil.copy(HOUSE, self.folder / "house.wrl")
        examples = re.findall(r"^  (atria mesh .*)$", text, re.MULTILINE)
        self.assertEqual(len(examples), 4)
        environment = {**os.environ, "PATH": f"{ATRIA.parent}:{os.environ['PATH']}"}
        for example in examples:
            example = example.replace("Chimney*", "Roof*").replace("Tree*", "Neighbor*") # what this house has
            run = subprocess.run(["sh", "-c", example + " --size-max 8" * ("0.5" not in example)], cwd=self.folder,
                                 env=environment, capture_output=True, text=True, check=False)
            self.assertIn(run.returncode, (0, 4, 5), example + run.stderr)

    def test_options_come_back_from_a_file(self):
        options = [*COARSE, "--size", "Wall*", "2:1", "--size", "Floor", "2", "--refine-box", *"-1 1 -1 1 0 2 1".split(),
                   "--refine-near", "Neighbor", 3, 2, "--layers", "1", "--layers", "Wall*=2", "--seed", -20, -20, 10, "--seed",
                   12, 7, 2, "--without", "Partition?", "--keep-duplicates"]
        run = self.atria("mesh", HOUSE, *options, "-o", "case.vtu", "--write-config", "case.toml")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertEqual([file.name for file in self.folder.iterdir()], ["case.toml"])
        text = (self.folder / "case.toml").read_text()
        for name in self.options("mesh"):
            if name != "--write-config":
                self.assertRegex(text, rf"(?m)^(# )?{name[2:]} = ")
        self.assertIn(self.atria("mesh", "--config", "case.toml", "--report", "a.json").returncode, (0, 4))
        self.assertIn(self.atria("mesh", HOUSE, *options, "-o", "b.vtu", "--report", "b.json").returncode, (0, 4))
        a, b = (json.loads((self.folder / name).read_text()) for name in ("a.json", "b.json"))
        self.assertEqual((a["counts"], a["quality"]), (b["counts"], b["quality"]))
        run = self.atria("mesh", "--config", "case.toml", "-o", "other.vtu", "--layers", "0", "--report", "a.json")
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertTrue((self.folder / "other.vtu").exists())
        asked = [wall["layers"] for wall in json.loads((self.folder / "a.json").read_text())["layers"]]
        self.assertFalse(any(asked))

    def test_slips_in_files_of_options_are_told(self):
        config = self.folder / "bad.toml"
        config.write_text("[mesh]\nsize-mni = 3\n")
        self.refuses(2, "no option for mesh.size-mni; did you mean --size-min?", "mesh", HOUSE, "--config", config)
        config.write_text("size-min = 3\n")
        self.refuses(2, "section such as [mesh]", "mesh", HOUSE, "--config", config)
        config.write_text("[mesh]\nsize-min = nan\n")
        self.refuses(2, "--size-min", "mesh", HOUSE, "--config", config)
        self.refuses(2, "absent.toml", "mesh", HOUSE, "--config", "absent.toml")

    def test_slips_are_told_with_what_may_be_meant(self):
        self.refuses(2, "no option --size-mni; did you mean --size-min?", "mesh", HOUSE, "--size-mni", "3")
        self.refuses(2, "no option --size-mni; did you mean --size-min?", "mesh", "--size-mni=3", HOUSE)
        self.refuses(2, "no option --plto; did you mean --plot?", "quality", "x.vtu", "--plto", "3")
        self.refuses(2, "no subcommand msh; did you mean mesh?", "msh", HOUSE)
        self.refuses(2, "did you mean 'walls'?", "mesh", HOUSE, "--align", "wals")
        self.refuses(2, "did you mean 'Site'?", "mesh", HOUSE, "--site", "Sitr")
        for option in (["--size", "WallSuoth", "1"], ["--layers", "wallsouth=1"], ["--refine-near", "Wallsouth", "1", "1"]):
            self.refuses(3, "did you mean 'WallSouth'?", "mesh", HOUSE, *COARSE, *option)

    def test_numbers_that_are_none_are_usage_errors(self):
        for option in ("--size-min", "--size-mid", "--size-max", "--gap", "--wind", "--domain-angle", "--first-layer",
                       "--layer-growth", "--memory-limit", "--scale"):
            for value in ("nan", "inf", "-inf", "x"):
                self.refuses(2, option, "mesh", HOUSE, option + "=" + value)
        self.refuses(2, "--seed", "mesh", HOUSE, "--seed", "0", "nan", "0")
        self.refuses(2, "--domain", "mesh", HOUSE, "--domain", *"0 1 0 inf 0 1".split())

    def test_messages_speak_of_options(self):
        """Not of properties, which other interfaces have."""
        inches = self.folder / "inches.wrl"
        inches.write_text('#VRML V2.0 utf8\nTransform { scale 39.37 39.37 39.37 children Inline { url "%s" } }\n' % HOUSE)
        runs = [self.refuses(3, "--size-min", "mesh", HOUSE, "--size-max", "1e-6"),
                self.refuses(3, "--domain", "mesh", HOUSE, *COARSE[:6], "--domain", *"500 600 500 600 0 50".split()),
                self.atria("mesh", HOUSE, *COARSE[:6], "--domain", *"5 20 0 14 0 30".split(), "--layers", 0),
                self.refuses(3, "--terrain", "mesh", HOUSE, *COARSE[:6], "--terrain", "*"),
                self.atria("inspect", inches)]
        properties = (r"\b(Size(Min|Mid|Max)|DomainMode|DomainBounds|SiteName|TerrainName|MaxElements|MemoryLimit|LayerRules|"
                      r"NumberOfLayers|LengthUnit|StartLevel)\b")
        for run in runs:
            self.assertIn("atria: ", run.stderr)
            self.assertNotRegex(run.stderr, properties)
            self.assertNotRegex(run.stderr, r"(--[a-z0-9-]+)[,;]? \(?\1\b(?!-)")
            for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", run.stderr):
                self.assertIn(option, self.options("mesh"))

    def test_models_without_extent_are_bad_input(self):
        model = self.folder / "flat.wrl"
        model.write_text("#VRML V2.0 utf8\nTransform { scale 0 0 0 children Shape { geometry Box {} } }\n")
        self.refuses(3, "no extent", "inspect", model)
        self.refuses(3, "no extent", "mesh", model)

    def test_areas_that_are_not_finite_are_said_to_be_so(self):
        model = self.folder / "huge.wrl"
        model.write_text("#VRML V2.0 utf8\nTransform { scale 1e200 1e200 1e200 children Shape { geometry Box {} } }\n")
        run = self.atria("inspect", model)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("areas are not finite", run.stderr)
        self.assertIn("not finite", run.stdout)
        self.assertNotIn("nan", run.stdout)
        self.assertIsNone(json.loads(self.atria("inspect", model, "--json").stdout)["total"]["area"])
        self.refuses(3, "not finite", "mesh", model)

    def test_surfaces_are_left_out_by_name(self):
        run = self.atria("inspect", HOUSE, "--json", "--without", "Partition?", "--without", "Neighbor")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("3 surfaces are left out as requested: PartitionA, PartitionB, Neighbor", run.stderr)
        names = {surface["name"] for surface in json.loads(run.stdout)["surfaces"]}
        whole = {surface["name"] for surface in json.loads(self.atria("inspect", HOUSE, "--json").stdout)["surfaces"]}
        self.assertEqual(whole - names, {"PartitionA", "PartitionB", "Neighbor"})

    def test_patterns_that_match_no_surface_are_warned_of(self):
        run = self.atria("inspect", HOUSE, "--json", "--without", "WallSouth2")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("no surface matches 'WallSouth2', which is to be left out", run.stderr)
        self.assertIn("did you mean 'WallSouth'?", run.stderr)

    def test_estimates_count_layers(self):
        def estimated(layers):
            text = self.atria("mesh", HOUSE, *COARSE, "--layers", layers, "--estimate").stdout
            return [int(re.search(pattern, text).group(1)) for pattern in (r"elements: (\d+)", r"with layers: about (\d+)")]
        plain, none = estimated(0)
        self.assertEqual(plain, none)
        same, one = estimated(1)
        self.assertEqual(same, plain)
        _, five = estimated(5)
        self.assertEqual(five - plain, 5 * (one - plain))
        self.atria("mesh", HOUSE, *COARSE, "--zone", "all", "-o", "mesh.vtu", "--report", "report.json")
        made = json.loads((self.folder / "report.json").read_text())["counts"]["elements"]
        self.assertTrue(one <= made < 1.5 * one, (one, made))

    def test_folders_that_are_missing_are_refused_alike(self):
        for option, name in (("-o", "x.vtu"), ("--patches", "x.vtpc"), ("--report", "x.json"), ("--openfoam", "case"),
                             ("--write-config", "x.toml")):
            self.refuses(2, "absent", "mesh", HOUSE, *COARSE, option, f"absent/{name}")
            self.assertFalse((self.folder / "absent").exists())
        (self.folder / "file").write_text("")
        self.refuses(2, "is a file", "mesh", HOUSE, *COARSE, "--openfoam", "file")

    def test_a_mesh_without_the_model_is_warned_of(self):
        """Sizes beyond the house leave nothing but the ground."""
        run = self.atria("mesh", HOUSE, "--size-min", "20", "--report", "report.json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("no surface of the model has a face in the mesh, but for ground", run.stderr)
        self.assertIn("lower --size-min, which is 20", run.stderr)
        self.assertRegex(run.stdout, r"left out +surfaces without faces 12: Floor, WallSouth, .* …")
        for options in (COARSE, (*COARSE, "--seed", "51", "5", "3")):
            self.assertNotIn("no surface of the model has", self.atria("mesh", HOUSE, *options).stderr)

    def test_names_that_openfoam_does_not_take(self):
        """Patches of a case are found by the names in the model, too, and files may be called anything."""
        house = self.folder / "Büro Süd" / "Haus 1 ä.wrl"
        house.parent.mkdir()
        house.write_text(HOUSE.read_text().replace("WallSouth", "Wand_Süd"))
        run = self.atria("mesh", house, *COARSE, "-o", house.with_suffix(".vtu"))
        self.assertEqual(run.returncode, 0, run.stderr)
        for pattern in ("Wand_Süd*", "Wand_S_d*", "*Süd_*"):
            run = self.atria("case", house.with_suffix(".vtu"), "-o", "Büro Süd/Fall 1", "--patch", pattern, "slip")
            self.assertEqual(run.returncode, 0, run.stderr)
            roles = json.loads((house.parent / "Fall 1" / "case.json").read_text())["directions"][0]["patches"]
            self.assertEqual((roles["Wand_S_d_front"], roles["WallNorth_front"]), ("slip", "wall"))

    def test_a_full_disk_is_told_by_name(self):
        """Stood in for by the limit on files, which systems enforce alike."""
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))
        for options, name in ((["-o", "mesh.vtu"], "mesh.vtu"), (["-o", "mesh.vtu", "--openfoam", "case"], "mesh.vtu")):
            run = self.atria("mesh", HOUSE, *COARSE, *options, preexec_fn=limit)
            self.assertEqual(run.returncode, 1, run.stderr)
            self.assertIn(f"{name} could not be written: files may have 0.05 MB at most (ulimit -f)", run.stderr)
            self.assertNotIn("vtk", run.stderr)
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_full_disk_leaves_no_part_of_a_case(self):
        """But what was there before."""
        self.atria("mesh", HOUSE, *COARSE, "-o", "mesh.vtu")
        self.atria("mesh", HOUSE, *COARSE, "-o", "mesh.vtu", "--openfoam", "earlier")
        for large in (0, 1000, 50_000):  # its first file, its last ones, its mesh
            def limit():
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (large, large))
            run = self.atria("case", "mesh.vtu", "-o", "made/case", preexec_fn=limit)
            self.assertEqual(run.returncode, 2, run.stderr)  # of two folders the first must be there
            for source in ("mesh.vtu", "earlier"):
                run = self.atria("case", source, "-o", "case", preexec_fn=limit)
                self.assertEqual(run.returncode, 1, run.stderr)
                self.assertRegex(run.stderr, r"cannot (write|copy).*case/")
                self.assertFalse((self.folder / "case").exists(), run.stderr)
        case = self.folder / "case"
        (case / "constant").mkdir(parents=True)
        (case / "mine").write_text("mine")
        run = self.atria("case", "mesh.vtu", "-o", "case", preexec_fn=limit)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual(sorted(path.name for path in case.iterdir()), ["case.foam", "constant", "mine"])
        self.assertEqual(list((case / "constant").iterdir()), [])
        self.atria("case", "mesh.vtu", "-o", "case")
        before = {path: path.read_bytes() for path in case.rglob("*") if path.is_file()}
        self.assertEqual(self.atria("case", "earlier", "-o", "case", "--speed", "7", preexec_fn=limit).returncode, 1)
        self.assertEqual({path: path.read_bytes() for path in case.rglob("*") if path.is_file()}, before)

    def completed(self, *words):
        """What bash offers for the last word."""
        script = self.folder / "atria.bash"
        script.write_text(self.atria("completion", "bash").stdout)
        line = " ".join(f"'{word}'" for word in words)
        run = subprocess.run(["bash", "-c", f"source '{script}'; COMP_WORDS=(atria {line}); COMP_CWORD={len(words)}; _atria; "
                              "printf '%s\n' \"${COMPREPLY[@]}\""], capture_output=True, text=True, check=True,
                             cwd=self.folder)
        self.assertEqual(run.stderr, "")
        return run.stdout.split()

    def test_completion_knows_all_options(self):
        self.assertLessEqual(set(COMMANDS), set(self.completed("")))
        self.assertEqual(self.completed("insp"), ["inspect"])
        for command in COMMANDS:
            self.assertLessEqual(set(self.options(command)), set(self.completed(command, "--")))
        self.assertEqual(self.completed("mesh", "--align", ""), ["axes", "walls", "domain"])
        (self.folder / "model.wrl").write_text("")
        self.assertEqual(self.completed("mesh", "mod"), ["model.wrl"])
        fish = self.atria("completion", "fish").stdout
        for command in COMMANDS:
            for option in self.options(command):
                self.assertRegex(fish, rf"from {command}'.* -l {option[2:]} ")
        self.assertTrue(self.atria("completion", "zsh").stdout.startswith("#compdef atria\n"))
        self.refuses(2, "zsh", "completion", "tcsh")

    def test_the_manual_page_has_all_options(self):
        page = self.atria("man").stdout
        for command in COMMANDS:
            for option in self.options(command):
                self.assertIn(option.replace("-", "\\-"), page)
        if shutil.which("groff"):
            run = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=page, capture_output=True, text=True, check=True)
            self.assertEqual(run.stderr, "")
            self.assertIn("--size-min", run.stdout.replace("\u2010", "-").replace("\u2212", "-"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
