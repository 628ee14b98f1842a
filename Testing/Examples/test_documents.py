# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documents name exists: commands with their options, classes, properties and files, and messages they quote.

Usage: test_documents.py SOURCE ATRIA
"""

import functools
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE, ATRIA = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
DOCUMENTS = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").glob("**/*.md"))]
SOURCES = ("Filters", "IO", "ParaViewPlugin", "Examples", "Testing", ".ci", "docs/pictures", "docs/site")
# Names of VTK and of IFC, and options of other programs: Python's venv and pip, our tests.
OTHERS = re.compile(r"vtk(?!Atria)\w+|Ifc\w+")
OTHER_OPTIONS = {"--system-site-packages", "--no-deps", "--full"}
# Made when there is something to keep in them.
LATER = {"Testing/Data/VRML/damaged", "Testing/Data/Models/damaged"}
COMMANDS = re.findall(r"^  (\w+) ", re.split("(?i)subcommands:", subprocess.run(
    [ATRIA, "--help"], capture_output=True, text=True, check=True).stdout)[1], re.MULTILINE)
QUOTE = re.compile(r"`([^`\n]+)`")


@functools.cache
def options_of(command):
    text = subprocess.run([ATRIA, command, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", text)) | {"--su2", "--config", "--help", "-h"}


@functools.cache
def sources():
    files = [file for folder in SOURCES for file in (SOURCE / folder).rglob("*")
             if file.suffix in (".h", ".cxx", ".py", ".xml", ".txt", ".cmake", ".module", ".sh", ".in", ".wrl") and file.is_file()]
    return {file: file.read_text(encoding="utf-8", errors="replace") for file in files}


@functools.cache
def words():
    return set(re.findall(r"\w+", "\n".join(sources().values())))


@functools.cache
def messages():
    """Text within quotes, parts that follow each other put together."""
    return "\n".join("".join(re.findall(r'"((?:[^"\\]|\\.)*)"', re.sub(r'"\s*\n?\s*"', "", text))) for text in sources().values())


def code(document):
    """What stands in backticks, and lines of blocks, without comments; lines that go on are joined."""
    text = document.read_text(encoding="utf-8")
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
        if language in ("sh", ""):
            yield from re.sub(r"#.*", "", block.replace("\\\n", " ")).splitlines()
    yield from QUOTE.findall(re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE))


class Documents(unittest.TestCase):
    def test_commands_and_their_options_exist(self):
        wrong, found = [], 0
        for document in DOCUMENTS:
            for line in code(document):
                for part in re.split(r"&&|;|\|", line):
                    match = re.match(r"\s*(?:\S*/)?atria ([a-z]\w*)\b(.*)", part)
                    if not match:
                        continue
                    found += 1
                    if match[1] not in COMMANDS:
                        wrong.append(f"{document.name}: no command {match[1]}: {part}")
                        continue
                    given = re.findall(r"(?<=\s)(--?[a-z][a-z0-9-]*)", re.sub(r"'[^']*'", "", match[2]))
                    wrong += [f"{document.name}: {option} of {match[1]}" for option in given if option not in options_of(match[1])]
        self.assertEqual(wrong, [])
        self.assertGreater(found, 60)

    def test_options_alone_are_those_of_a_command(self):
        everything = set().union(*(options_of(command) for command in COMMANDS))
        wrong = []
        for document in DOCUMENTS:
            for line in code(document):
                option = re.match(r"(--[a-z][a-z0-9-]*)(?: [A-Z'\"0-9<].*)?$", line)
                if option and option[1] not in everything | OTHER_OPTIONS:
                    wrong.append(f"{document.name}: {option[1]}")
        self.assertEqual(wrong, [])

    def test_names_are_in_the_sources(self):
        wrong = [f"{document.name}: {name}" for document in DOCUMENTS for quoted in code(document)
                 for name in re.findall(r"^(?:Set|Get)?((?:vtk)?[A-Z][a-z]+(?:[A-Z][a-z0-9]*)+)(?:\(.*\))?$", quoted)
                 if name not in words() and not {f"Set{name}", f"Get{name}"} & words() and not OTHERS.match(name)]
        self.assertEqual(wrong, [])

    def test_files_are_there(self):
        wrong = []
        for document in DOCUMENTS:
            for name in QUOTE.findall(document.read_text(encoding="utf-8")):
                if re.fullmatch(r"(?:Filters|IO|Testing|Examples|ParaViewPlugin|docs)/[\w./-]+", name):
                    if name not in LATER and not (SOURCE / name).exists() and not list(SOURCE.glob(name + ".*")):
                        wrong.append(f"{document.name}: {name}")
        self.assertEqual(wrong, [])

    def test_messages_that_troubleshooting_quotes_are_told(self):
        text = (SOURCE / "docs/troubleshooting.md").read_text(encoding="utf-8")
        quoted = [quote for quote in QUOTE.findall(text)
                  if len(re.findall(r"\b[a-z]{2,}\b", quote)) >= 3 and not re.match(r"atria |-|\d", quote)]
        self.assertGreater(len(quoted), 0)
        self.assertEqual([quote for quote in quoted if quote not in messages()], [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
