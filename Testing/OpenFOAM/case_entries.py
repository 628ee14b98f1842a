# SPDX-License-Identifier: GPL-3.0-or-later
"""Walks over the entries of OpenFOAM cases, and looks each of them up in the sources of one version.

The rules, all of them heuristics:

- A type counts as known if it is the TypeName of a class that is registered for run-time selection and derives from
  the right base class. If the dictionary says libs, one of these libraries must have the class too.
- A keyword, or a word given as a value, counts as known if it is quoted in the sources of the class that reads it, of
  its bases, or of what they include. It may be quoted there for another reason.
- A keyword that no type owns is looked for in parts of the sources that depend on the file: see PLACES.
- Keys of fvSchemes and fvSolution that solvers make of the names of fields, such as div(phi,k), count as known if the
  tutorials have one like it, with the name of any field in place of the case's own.
- Names that the case itself gives (patches, zones, fields) are not looked up, and nor are numbers, switches, quoted
  strings and values that begin with $. In a dictionary within one that has a type, only the keywords are looked up.
"""

import re
import typing

from foam_dictionary import NUMBER, DictionaryError, parse

SWITCHES = {"yes", "no", "on", "off", "true", "false"}

# Fields that are known to be fields, even if the case has no file for them.
USUAL_FIELDS = {"k", "epsilon", "omega", "age"}
FLUX = "phi"

# The base classes of the types named in each part of fvSchemes.
SCHEMES = {
    "ddtSchemes": ["ddtScheme"],
    "gradSchemes": ["gradScheme", "surfaceInterpolationScheme"],
    "divSchemes": ["convectionScheme", "divScheme", "surfaceInterpolationScheme"],
    "laplacianSchemes": ["laplacianScheme", "surfaceInterpolationScheme", "snGradScheme"],
    "interpolationSchemes": ["surfaceInterpolationScheme"],
    "snGradSchemes": ["snGradScheme"],
    "wallDist": ["patchDistMethod"],
}

# Keywords other than "type" whose value is a type, and its base classes (none: any).
TYPE_KEYWORDS = {
    "solver": ["solver"],
    "smoother": ["smoother"],
    "preconditioner": ["preconditioner"],
    "method": ["decompositionMethod", "patchDistMethod"],
    "viscosityModel": ["viscosityModel"],
    "transportModel": ["viscosityModel"],
    "RASModel": ["RASModel"],
    "model": ["RASModel"],
    "simulationType": [],
}

# The base classes of a dictionary with a type that stands within another one.
INNER_ROOTS = ["option", "fvModel"]

# Files whose dictionaries all have such a type.
MODEL_FILES = ("fvOptions", "fvModels")
# Where models have the keywords of their cells from.
CELLS_PLACE = re.compile(r"src/meshTools/(sets/polyCellSet|zoneGenerators/cell/generatedCellZone)/")

# Where the keywords of a file are looked for that no type owns: the beginnings of paths. A file that is not named
# here is taken for one of the folder constant.
PLACES = {
    "controlDict": r"src/OpenFOAM/db/|src/OSspecific|applications/solvers/foamRun|bin/",
    "decomposeParDict": r"src/parallel/decompos|src/OpenFOAM/db/dictionary/dictionary.C",
    "fvSchemes": r"src/finiteVolume/|src/OpenFOAM/matrices/",
    "fvSolution": r"src/finiteVolume/cfdTools|src/OpenFOAM/matrices|applications/(solvers|modules)",
    "constant": r"src/[^/]*([tT]urbulence|[tT]ransport|physicalProperties)",
}
FUNCTIONS_PLACE = "src/OpenFOAM/db/functionObjects/"

# The folders of a case that have dictionaries, and the patch entries that are written by the mesh itself.
CASE_FOLDERS = ("0", "constant", "system")
PATCH_RANGE = ("nFaces", "startFace")

# Dictionaries of fvSolution whose keys are made of the names of fields.
FIELD_DICTIONARIES = ("solvers", "residualControl", "fields", "equations")

# A keyword may be the name of a field or a method and an ending of at least this length: p and RefCell.
SHORTEST_ENDING = 3
# A file may be named after a class of at least this length, and an ending.
SHORTEST_CLASS = 3

# How far into a file its header is looked for.
HEADER_BYTES = 2000

# The class in the header of a file: FoamFile { version 2.0; class dictionary;
HEADER_CLASS = re.compile(rb"FoamFile\s*\{[^}]*\bclass\s+(\w+)\s*;")

# A name on a line of its own, in the files of zones: inletZone
ZONE_NAME = re.compile(r"^(\w+)\s*$", re.MULTILINE)

# The quotes and the ending of the name of a library: "libforces.so"
LIBRARY_DECORATION = re.compile(r'^"|(\.so)?"$')

# The choices in a key that is a regular expression: (U|k|epsilon) of "(U|k|epsilon)Final", but not \(a|b\)
CHOICES = re.compile(r"(?<!\\)\(([^()]*\|[^()]*)\)")

# Characters of a key that are escaped to search for it: ( ) and * of div(phi,k)
BRACKET_OR_STAR = re.compile(r"([()*])")

WORD = re.compile(r"\w+")

# Stands for .* while a key is made into a pattern.
ANY = "ANY"

# Put before a file that does not belong to the class, but is included by it.
INCLUDED = "(included) "


class Places(typing.NamedTuple):
    """The source files a keyword is looked for in, and which of them are only included by a class."""

    paths: list
    included: frozenset = frozenset()


class Position(typing.NamedTuple):
    """A place in a dictionary file: the name of the file, the keys around, and where keywords are looked for."""

    file: str
    keys: tuple
    places: Places

    def within(self, key):
        return self._replace(keys=(*self.keys, key))


def words_of(value):
    """The words of a list and of the lists within, other than numbers, switches, strings and $names."""
    for item in value:
        if isinstance(item, list):
            yield from words_of(item)
        elif isinstance(item, str) and not NUMBER.match(item) and item not in SWITCHES and item[0] not in '"$':
            yield item


def first_of(value, entry):
    if not value or isinstance(value, dict):
        raise DictionaryError(f"An entry of the case has no value: {entry}.")
    return value[0]


def is_composed(position, key):
    """Whether solvers make such a key of the names of fields."""
    if position.file not in ("fvSchemes", "fvSolution") or not position.keys or key == "default":
        return False
    return position.keys[0].endswith("Schemes") or position.keys[-1] in FIELD_DICTIONARIES


def alternatives(key):
    """The keys that a quoted key with choices stands for: UFinal and kFinal for "(U|k)Final"."""
    choices = CHOICES.search(key) if key.startswith('"') else None
    if not choices:
        return []
    return [
        key.replace(choices.group(), word).strip('"').replace("\\", "").replace(".*", ANY)
        for word in choices.group(1).split("|")
    ]


class CaseEntries:
    """The entries of cases. In rows is where each was found: a path, or None if the version does not know it."""

    def __init__(self, sources):
        self.sources = sources
        self.rows = {}
        self.names = {FLUX}
        self.fields = set(USUAL_FIELDS)

    def add_row(self, entry, where):
        """An entry may come up several times: it is known if it is each time."""
        if entry not in self.rows or not where:
            self.rows[entry] = where

    # The files of a case

    def add_case(self, folder):
        self.collect_names(folder)
        for path in sorted(folder.rglob("*")):
            inside = path.relative_to(folder).parts
            if not path.is_file():
                continue
            if path.parent.name == "polyMesh":
                self.check_header(path)
            if inside[0].startswith("processor"):
                continue
            if inside[-2:] == ("polyMesh", "boundary"):
                self.check_boundary(path)
            elif path.parent.name in CASE_FOLDERS:
                self.check_file(path)

    def collect_names(self, folder):
        """The names of patches, their groups, zones and fields."""
        for boundary in folder.rglob("constant/polyMesh/boundary"):
            for item in self.patches(boundary):
                if isinstance(item, str):
                    self.names.add(item)
                elif isinstance(item, dict):
                    self.names.update(words_of(item.get("inGroups", [])))
        for zones in folder.rglob("constant/polyMesh/*Zones"):
            self.names.update(ZONE_NAME.findall(zones.read_text("latin-1")))
        self.fields.update(path.name for path in folder.rglob("0/*"))
        self.names.update(self.fields)

    @staticmethod
    def patches(path):
        """The list of a boundary file: names and dictionaries in turn."""
        content = parse(path)
        if "" not in content:
            raise DictionaryError(f"{path} has no list of patches.")
        return content[""]

    def check_header(self, path):
        """The class that a file says it is of."""
        with path.open("rb") as file:
            match = HEADER_CLASS.search(file.read(HEADER_BYTES))
        if not match:
            raise DictionaryError(f"{path} has no FoamFile header that names a class.")
        word = match.group(1).decode()
        types = self.sources.types.get(word)
        self.add_row(f"class {word}", types[0].path if types else self.sources.defined.get(word))

    def check_boundary(self, path):
        patches = self.patches(path)
        for patch in patches[1::2]:
            self.check_typed("patch", patch, ["polyPatch"], skipped=PATCH_RANGE)

    def check_file(self, path):
        content = parse(path)
        self.check_header(path)
        if "boundaryField" in content:
            self.check_field(content)
        else:
            self.check_dictionary_file(path.name, content)

    def check_field(self, content):
        paths = [path for path in self.sources.files if "/GeometricFields/" in path or "Field/" in path]
        for key in sorted(set(content) - self.names):
            self.add_row(f"field: {key}", self.sources.quoted(key, paths))
        for condition in content["boundaryField"].values():
            self.check_typed("condition", condition, ["fvPatchField"])

    def check_dictionary_file(self, name, content):
        """The file itself is known if its name is quoted anywhere, or is that of a class and a quoted ending."""
        place = re.compile(PLACES.get(name, PLACES["constant"]))
        paths = [path for path in self.sources.files if place.match(path)]
        where = self.sources.quoted(name, self.sources.files)
        if not where:
            where, files_of_class = self.file_of_class(name)
            paths = files_of_class or paths
        self.add_row(f"file {name}", where)
        if name in MODEL_FILES:
            cells = Places([path for path in self.sources.files if CELLS_PLACE.match(path)])
            for model in content.values():
                if isinstance(model, dict) and "type" in model:
                    self.check_typed("model", model, INNER_ROOTS, cells)
            return
        self.check_entries(content, Position(name, (), Places(paths)))

    def file_of_class(self, name):
        """For a file named after a class, with an ending that is quoted there: where that is, and the class's files."""
        for length in range(len(name) - 1, SHORTEST_CLASS - 1, -1):
            files = [
                path for named in self.sources.types.get(name[:length], [])
                for path in self.sources.with_companions(named.path)
            ]
            where = self.sources.quoted(name[length:], files)
            if where:
                return where, files
        return None, None

    # Keywords and words

    def check_keyword(self, entry, word, places):
        where = self.sources.quoted(word, places.paths) or self.spelled(word, places.paths)
        if where in places.included:
            where = INCLUDED + where
        self.add_row(entry, where)

    def spelled(self, word, paths):
        """The first file that has each letter of the word in single quotes: a word such as xyz is read by letter."""
        letters = [f"'{letter}'" for letter in word]
        return next((path for path in paths if all(letter in self.sources.files[path] for letter in letters)), None)

    def check_words(self, entry, value, places):
        """Words given as a value: quoted where the keyword is, or else types of any kind."""
        for word in words_of(value):
            if word in self.names:
                continue
            types = self.sources.find_type(word)
            if types and not self.sources.quoted(word, places.paths):
                self.add_row(f"{entry} {word}", types[0].path)
            else:
                self.check_keyword(f"{entry} {word}", word, places)

    # Dictionaries with a type

    def check_type(self, entry, word, roots):
        """The classes of a type."""
        found = self.sources.find_type(word, roots)
        self.add_row(f"{entry} {word}", found[0].path if found else None)
        return found

    def check_typed(self, title, dictionary, roots, outer=Places(()), skipped=()):
        """A dictionary that should have a type: without one, its keywords are those of the dictionary around it.

        If the type is not known, nothing is said of the other entries.
        """
        if not isinstance(dictionary, dict):
            raise DictionaryError(f"An entry of the case is not a dictionary: {title}. $name is not expanded.")
        found, name, places = None, title, outer
        if "type" in dictionary:
            word = first_of(dictionary["type"], f"{title}: type")
            found = self.check_type(f"{title}: type", word, roots)
            if not found:
                return
            name, places = f"{title} {word}", self.places_of(found, outer)
        for key, value in dictionary.items():
            entry = f"{name}: {key}"
            if key == "libs":
                self.check_libraries(name, value, found)
            elif key != "type" and key not in self.names:
                if key not in skipped:
                    self.check_keyword(entry, key, places)
                self.check_inner(entry, value, places)

    def places_of(self, classes, outer):
        """Where the keywords of these classes are looked for: their own files, those around, what they include."""
        own, included = {}, set()
        for named in classes:
            own_files, included_files = self.sources.files_of_class(*named)
            own.update(dict.fromkeys(own_files))
            included.update(included_files)
        included -= set(own)
        around = [path for path in outer.paths if path not in own]
        return Places([*own, *around, *sorted(included)], frozenset(included))

    def check_inner(self, entry, value, places):
        """The value of an entry of a dictionary with a type."""
        if isinstance(value, dict):
            self.check_inner_dictionary(entry, value, places)
            return
        for item in value:
            if isinstance(item, list):
                self.check_inner(entry, item, places)
            elif isinstance(item, dict):
                for key, inner in item.items():
                    self.check_keyword(f"{entry}: {key}", key, places)
                    self.check_words(f"{entry}: {key}", inner, places)
            else:
                self.check_words(entry, [item], places)

    def check_inner_dictionary(self, entry, dictionary, places):
        for key, value in dictionary.items():
            if isinstance(value, dict) and "type" in value:
                self.check_typed(entry, value, INNER_ROOTS, places)
            elif key not in self.names:
                self.check_keyword(f"{entry}: {key}", key, places)

    def check_libraries(self, name, value, classes):
        """The libraries of an entry libs: that they exist and, if classes are given, that one has a class of them."""
        libraries = [LIBRARY_DECORATION.sub("", word) for word in first_of(value, f"{name}: libs")]
        sources = set()
        for library in libraries:
            files = self.sources.libraries.get(library)
            self.add_row(f"libs {library}", min(files, key=len) if files else None)
            sources.update(files or ())
        if classes is None:
            return
        compiled = [
            path for named in classes for path in self.sources.with_companions(named.path) if path in sources
        ]
        self.add_row(f"{name}: is in {' or '.join(libraries)}", compiled[0] if compiled else None)

    # Dictionaries without a type

    def check_entries(self, content, position):
        siblings = set(words_of(content.values()))
        for key, value in content.items():
            entry = ": ".join([position.file, *position.keys, key])
            if is_composed(position, key):
                self.check_composed(entry, key)
            elif key == "libs":
                self.check_libraries(position.file, value, None)
                continue
            else:
                self.add_row(entry, self.find_keyword(key, siblings, position.places.paths))
            self.check_value(entry, key, value, position)

    def check_value(self, entry, key, value, position):
        top = (position.keys or (key,))[0]
        if key == "functions":
            paths = [path for path in self.sources.files if FUNCTIONS_PLACE in path]
            for function in value.values():
                self.check_typed("function", function, ["functionObject"], Places(paths))
        elif isinstance(value, dict):
            self.check_entries(value, position.within(key))
        elif key == "application":
            program = first_of(value, entry)
            self.add_row(f"application {program}", self.sources.programs.get(program))
        elif position.file == "fvSchemes" and top in SCHEMES:
            for word in words_of(value):
                if "(" not in word and word != "none":
                    self.check_type(top, word, SCHEMES[top])
        elif key in TYPE_KEYWORDS:
            self.check_type(entry, first_of(value, entry), TYPE_KEYWORDS[key])
        else:
            self.check_words(entry, value, position.places)

    def find_keyword(self, key, siblings, paths):
        """Where a keyword is quoted, whole or as an ending, or where a script of bin has it."""
        where = self.sources.quoted(key, paths) or self.find_ending(key, siblings, paths)
        return where or self.find_in_scripts(key, paths)

    def find_ending(self, key, siblings, paths):
        """Where a keyword is made: of a field's name, as pRefCell, or of a value beside it, as hierarchicalCoeffs."""
        for name in sorted(self.names | siblings):
            ending = key.removeprefix(name)
            if SHORTEST_ENDING <= len(ending) < len(key):
                where = self.sources.quoted(ending, paths)
                if where:
                    return where
        return None

    def find_in_scripts(self, key, paths):
        return next((path for path in paths if path.startswith("bin/") and key in self.sources.files[path]), None)

    # Keys made of the names of fields

    def check_composed(self, entry, key):
        """A key that solvers make of the names of fields; if it has choices, each of them."""
        choices = alternatives(key)
        for choice in choices:
            self.add_row(f"{entry} = {choice}", self.find_composed(choice))
        if not choices:
            self.add_row(entry, self.find_composed(key))

    def find_composed(self, key):
        """A tutorial that has such a key, for any fields; or a source that quotes how it begins."""
        escaped = BRACKET_OR_STAR.sub(r"\\\1", key)
        pattern = WORD.sub(lambda match: r"\w+" if match.group() in self.fields else match.group(), escaped)
        search = re.compile(rf"(?<!\w){pattern}(?![\w.])".replace(ANY, r"\w+")).search
        where = next((path for path, text in self.sources.tutorials.items() if search(text)), None)
        if not where and ANY in key:
            beginning = key.split(ANY)[0]
            where = self.sources.quoted(beginning, self.sources.files)
        return where
