# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the sources of one version of OpenFOAM, so that a name used in a case can be looked up in them.

OpenFOAM has no list of the names it knows. They are spread over the sources: a class says its name with TypeName, a
macro registers it for run-time selection, Make/files says which library or program it is compiled into, and keywords
are quoted where a dictionary is read. Sources reads all of these.

The sources are not compiled, only searched with regular expressions, so everything here is a heuristic. Macros are
not expanded: each word given to a macro whose name begins with add or make counts as registered. Namespaces are
ignored, so classes of the same name are told apart only by their files. The value type is left out of the names of
patch fields: fvPatchScalarField and fvPatchVectorField are both read as fvPatchField.
"""

import collections
import pathlib
import re
import subprocess
import typing

# Endings of C++ files, of those among them that are compiled, and of headers.
CPP_ENDINGS = (".C", ".H", ".cxx", ".txx")
COMPILED_ENDINGS = (".C", ".cxx")
HEADER_ENDING = ".H"

# A class may be written in several files: with xyz.H go xyz.C, xyzI.H, xyzTemplates.C and so on.
COMPANION_ENDINGS = (
    ".H", ".C", ".cxx", ".txx", "I.H", "Templates.C", "Templates.txx", "New.C", "IO.C",
)

# Lists of what is compiled into a library or program.
MAKE_FILES = "/Make/files"

# How many times a $(variable) within a $(variable) of Make/files is replaced.
MAKE_VARIABLE_DEPTH = 4

# How many times a class may take the TypeName of a class that itself takes that of another.
BORROWED_NAME_DEPTH = 2

# The files that are read. The finiteArea library is left out, since it has its own classes of the same names.
WANTED = re.compile(
    r"""
    (?!.*finiteArea)
    (?: (?:src|applications)/.*\.(?:C|H|cxx|txx)            # src/OpenFOAM/db/Time/Time.C
      | .*/Make/files                                       # src/OpenFOAM/Make/files
      | bin/.*                                              # bin/foamJob
      | tutorials/.*/(?:fvSchemes|fvSolution)[^/]*          # tutorials/basic/pitzDaily/system/fvSchemes
    )$
    """,
    re.VERBOSE,
)

# A comment, or a string (group 1), as that may have // within.
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*")', re.DOTALL)

# The value type in the name of a patch field: the atchScalarField of fvPatchScalarField.
VALUE_TYPE = re.compile(r"atch(Scalar|Vector|SphericalTensor|SymmTensor|Tensor)Field")

# class probes : public functionObject, public Field {
CLASS = re.compile(r"\bclass\s+(\w+)(?:\s+final)?\s*(?::([^{};]*))?\{")

# TypeName("probes") or TypeName(Foam::probes::typeName_())
TYPE_NAME = re.compile(
    r'\b(?:TypeName|TypeNameNoDebug|ClassName)\s*\(\s*(?:"([^"]+)"|(?:\w+::)*(\w+)::typeName_\(\))'
)

# addDictionaryConstructorToTable<probes>
TABLE = re.compile(r"\badd\w*Table\s*<([^;>]*)>")

# addToRunTimeSelectionTable(functionObject, probes, dictionary), or a table with a name:
# functionObject::adddictionaryConstructorToTable<probes> addProbes("probes")
MACRO = re.compile(r"\b((?:add|make|define)\w*)\b(?:\s*<([^;()]*)>\s*\w*)?\s*\(([^;()]*)\)")

# The macros that are given the name of a type as their last argument: addNamedToRunTimeSelectionTable.
NAMING_MACRO = re.compile(r"Named|WithName|Alias")

# What is left out to find the bare name of a class: the Foam:: and the <scalar> of Foam::Table<scalar>.
QUALIFIERS = re.compile(r"<.*|.*::")

# The ending of a class that makePatchFields(fixedValue) registers without it: fixedValueFvPatchField.
PATCH_ENDING = re.compile(r"FvPatchField$|FvPatch$")

# probes = probes/probes
MAKE_VARIABLE = re.compile(r"^\s*(\w+)\s*:?=\s*(\S+)\s*$", re.MULTILINE)

# LIB = $(FOAM_LIBBIN)/libsampling
MAKE_TARGET = re.compile(r"^\s*(LIB|EXE)\s*=\s*\S*?/?([\w+-]+)\s*$", re.MULTILINE)

# $(probes)/probes.C
MAKE_SOURCE = re.compile(r"[\w$(){}./+-]+\.(?:C|cxx)\b")

# $(probes) or ${probes}
MAKE_REFERENCE = re.compile(r"\$[({](\w+)[)}]")

# #include "Time.H"
INCLUDE = re.compile(r'#include\s+"([^"]+)"')

# A function that is given a dictionary: readFields(dict, ...
GIVEN_DICTIONARY = re.compile(r"\b(\w+)\s*\(\s*\w*[dD]ict\w*\s*[,)]")

WORD = re.compile(r"\w+")
ACCESS = {"public", "protected", "private", "virtual"}


class SourcesError(Exception):
    """Sources that cannot be read."""


class ClassDeclaration(typing.NamedTuple):
    """The file of a class, and the words its bases are named with."""

    path: str
    bases: set


class NamedClass(typing.NamedTuple):
    """A class that has a TypeName, and the file that says so."""

    name: str
    path: str


def run_git(repository, *arguments, given=None):
    """The output of git, or None if it fails."""
    command = ["git", "-C", repository, *arguments]
    try:
        result = subprocess.run(command, input=given, capture_output=True, check=False)
    except FileNotFoundError as error:
        raise SourcesError("The program git is not installed, which SOURCES with a revision needs.") from error
    return result.stdout if result.returncode == 0 else None


def check_place(place):
    """Raises SourcesError if there are no sources at this place."""
    if pathlib.Path(place).is_dir():
        if not pathlib.Path(place, "src").is_dir():
            raise SourcesError(f"{place} has no folder src: it does not have the sources of OpenFOAM.")
        return
    repository, _, revision = place.rpartition("@")
    if not repository or not revision:
        raise SourcesError(f"There is no folder {place}.")
    if not pathlib.Path(repository).is_dir():
        raise SourcesError(f"There is no repository {repository}.")
    if not run_git(repository, "rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{tree}"):
        raise SourcesError(f"The repository {repository} has no revision {revision}.")
    if not run_git(repository, "ls-tree", revision + ":src"):
        raise SourcesError(f"Revision {revision} of {repository} has no folder src.")


def files_of_folder(folder):
    """The path and the bytes of each wanted file of a folder."""
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if WANTED.match(name) and path.is_file():
            yield name, path.read_bytes()


def files_of_revision(repository, revision):
    """The path and the bytes of each wanted file of a revision. Files a partial copy does not have are left out."""
    rows = run_git(repository, "ls-tree", "-r", "-z", revision).decode("utf-8", "replace").split("\0")
    blobs = {}
    for row in rows:
        description, _, name = row.partition("\t")  # 100644 blob 1f7a8c2... and the path
        if WANTED.match(name):
            blobs[name] = description.split()[2]
    output = run_git(repository, "cat-file", "--batch", given="\n".join(blobs.values()).encode())
    position = 0
    for name in blobs:
        line_end = output.index(b"\n", position)
        header = output[position:line_end].split()  # 1f7a8c2... blob 1234, or 1f7a8c2... missing
        position = line_end + 1
        if header[1] == b"blob":
            size = int(header[2])
            yield name, output[position:position + size]
            position += size + 1


def without_comments(text):
    return COMMENT_OR_STRING.sub(lambda match: match.group(1) or " ", text)


def without_value_type(text):
    return VALUE_TYPE.sub("atchField", text)


class Sources:
    """The sources of one version. A place is a folder, or BARE_GIT_REPOSITORY@REVISION."""

    def __init__(self, place):
        check_place(place)
        self.files = {}                                   # path: text, without comments
        self.by_name = collections.defaultdict(list)      # file name: paths
        self.classes = collections.defaultdict(list)      # class: ClassDeclarations
        self.types = collections.defaultdict(list)        # TypeName: NamedClasses
        self.borrowed_names = []                          # NamedClass, and the class whose TypeName it takes
        self.registered = set()                           # classes registered for run-time selection
        self.defined = {}                                 # word given to a define... macro: path
        self.libraries = collections.defaultdict(set)     # library: its Make/files and sources
        self.programs = {}                                # program: its Make/files
        self.load(place)
        self.index()
        self.tutorials = {path: text for path, text in self.files.items() if path.startswith("tutorials/")}

    def load(self, place):
        if pathlib.Path(place).is_dir():
            files = files_of_folder(pathlib.Path(place))
        else:
            files = files_of_revision(*place.rsplit("@", 1))
        for path, data in files:
            text = data.decode("utf-8", "replace")
            self.files[path] = without_comments(text) if path.endswith(CPP_ENDINGS) else text
            self.by_name[path.rsplit("/", 1)[-1]].append(path)

    def index(self):
        for path, text in self.files.items():
            if path.endswith(MAKE_FILES):
                self.index_make(path, text)
            elif path.endswith(CPP_ENDINGS):
                self.index_types(path, text, self.index_classes(path, text))
                self.index_registered(path, text)
        for _ in range(BORROWED_NAME_DEPTH):
            self.resolve_borrowed_names()

    def index_make(self, path, text):
        """Libraries and programs of a Make/files."""
        variables = dict(MAKE_VARIABLE.findall(text))
        for kind, name in MAKE_TARGET.findall(text):
            if kind == "EXE":
                self.programs[name] = path
                continue
            self.libraries[name].add(path)
            for source in MAKE_SOURCE.findall(text):
                for _ in range(MAKE_VARIABLE_DEPTH):
                    source = MAKE_REFERENCE.sub(lambda match: variables.get(match.group(1), ""), source)
                self.libraries[name].add(f"{path.removesuffix(MAKE_FILES)}/{source}".replace("//", "/"))

    def index_classes(self, path, text):
        """Classes and their bases. Returns where the body of each class begins, and its name."""
        bodies = []
        for match in CLASS.finditer(text):
            name = without_value_type(match.group(1))
            bases = set(WORD.findall(without_value_type(match.group(2) or ""))) - ACCESS
            self.classes[name].append(ClassDeclaration(path, bases))
            bodies.append((match.end() - 1, name))
        return bodies

    def index_types(self, path, text, bodies):
        """TypeNames, each of the innermost class whose body it stands in."""
        for match in TYPE_NAME.finditer(text):
            position = match.start()
            around = [
                name for start, name in bodies
                if text.count("{", start, position) > text.count("}", start, position)
            ]
            if not around:
                continue
            named = NamedClass(around[-1], path)
            literal, other_class = match.groups()
            if literal:
                self.types[literal].append(named)
            else:
                self.borrowed_names.append((named, other_class))

    def index_registered(self, path, text):
        """What the macros for run-time selection are given."""
        for match in TABLE.finditer(text):
            self.registered.update(WORD.findall(match.group(1)))
        for match in MACRO.finditer(text):
            macro, template, arguments = match.groups()
            if macro.startswith("define"):
                self.defined.update(dict.fromkeys(WORD.findall(arguments), path))
                if "WithName" not in macro:
                    continue
            words = WORD.findall(f"{template or ''} {arguments}")
            self.registered.update(without_value_type(word) for word in words)
            if path.endswith(COMPILED_ENDINGS):
                self.index_macro_names(path, macro, [argument.strip() for argument in arguments.split(",")])

    def index_macro_names(self, path, macro, arguments):
        """TypeNames that a macro is given, or makes of its arguments."""
        if len(arguments) < 2:
            return
        first, second = arguments[:2]
        if WORD.fullmatch(first) and WORD.fullmatch(second):
            # makeFvOption(SemiImplicitSource, scalar) names it scalarSemiImplicitSource
            self.types[second + first].append(NamedClass(first, path))
        if NAMING_MACRO.search(macro):
            # addNamedToRunTimeSelectionTable(base, class, ..., name), but makeNamed...(class, name)
            name = second if "Table" in macro else first
            named = NamedClass(without_value_type(QUALIFIERS.sub("", name)), path)
            self.types[arguments[-1].strip('"')].append(named)

    def resolve_borrowed_names(self):
        """Adds the classes that take the TypeName of another class, as with TypeName(other::typeName_())."""
        for classes in self.types.values():
            names = {named.name for named in classes}
            classes += [
                named for named, other_class in self.borrowed_names
                if other_class in names and named not in classes
            ]

    def ancestors(self, name, path):
        """The class itself and all its bases, nearest first. As several classes may have its name, path says which."""
        order = [name]
        for current in order:
            for declaration in self.classes.get(current, []):
                if current == name and declaration.path != path:
                    continue
                order += [base for base in sorted(declaration.bases) if base in self.classes and base not in order]
        return order

    def is_registered(self, name):
        return name in self.registered or PATCH_ENDING.sub("", name) in self.registered

    def find_type(self, word, roots=()):
        """The classes with this TypeName that are registered and derive from one of the roots, if any are given."""
        return [
            found for named in self.types.get(word, []) for found in self.declared(named)
            if self.is_registered(found.name)
            and (not roots or set(roots) & set(self.ancestors(found.name, found.path)))
        ]

    def declared(self, named):
        """The class as declared in headers, where its TypeName is given elsewhere."""
        if named.path.endswith(HEADER_ENDING):
            return [named]
        return [NamedClass(named.name, declaration.path) for declaration in self.classes.get(named.name, [])]

    def quoted(self, word, paths):
        """The first of the files that has the word in quotes, or None."""
        text = f'"{word}"'
        return next((path for path in paths if text in self.files[path]), None)

    def with_companions(self, path):
        """A file and those next to it, or below, that belong to the same class."""
        folder, _, name = path.rpartition("/")
        stem = name.rsplit(".", 1)[0]
        return [path] + [
            other for ending in COMPANION_ENDINGS for other in self.by_name.get(stem + ending, [])
            if other != path and other.startswith(folder + "/")
        ]

    def files_of_class(self, name, path):
        """The files that a keyword of a class may be quoted in: first its own, then those that these include.

        Its own are all files in its folder and those of its bases. What they include is added, and, of what that
        includes, the files with a function of a name that the own files call with a dictionary: a heuristic to
        follow the dictionary to where it is read.
        """
        folder = path.rpartition("/")[0] + "/"
        own = dict.fromkeys(self.with_companions(path))
        own.update(dict.fromkeys(other for other in self.files if other.startswith(folder)))
        for base in self.ancestors(name, path)[1:]:
            for declaration in self.classes.get(base, []):
                own.update(dict.fromkeys(self.with_companions(declaration.path)))
        included = self.included(own, own)
        further = self.included(included, own | included)
        return list(own), list(included) + self.that_take_dictionary(further, own)

    def included(self, paths, known):
        """What files include, with companions, other than the known; as keys, in order."""
        added = {}
        for path in paths:
            for include in INCLUDE.findall(self.files[path]):
                for found in self.by_name.get(include.rsplit("/", 1)[-1], []):
                    added.update((other, None) for other in self.with_companions(found) if other not in known)
        return added

    def that_take_dictionary(self, paths, callers):
        """Those of the files that define a function which the callers give a dictionary."""
        called = {name for path in callers for name in GIVEN_DICTIONARY.findall(self.files[path])} - {"read"}
        if not called:
            return []
        # ::readFields
        definition = re.compile(rf"::({'|'.join(sorted(called))})\b")
        return [path for path in paths if definition.search(self.files[path])]
