#!/usr/bin/env python3
"""check_layout.py [SOURCE | --self-test]: what CONTRIBUTING.md says of where things lie, and how
large.

Prints a line for each file that breaks a rule, with the rule, and fails if there is one. Reads the
sources as clang-format leaves them."""

import pathlib
import re
import sys
import tempfile

HEADER_LINES = 250    # of a public header
PUBLIC_HEADERS = 54
FILE_LINES = 500
FUNCTION_LINES = 60   # from the opening brace to the closing one
MEMBERS = 15          # data members of a class
# Classes that have more, and how many at most: this table only shrinks.
MORE_MEMBERS = {
    # options, results and settings, which callers read by name
    "common_options": 40, "repair_statistics": 34, "boolean_settings": 20, "cloud_survey": 20,
    "deviation_result": 21, "placement": 22, "weld_stream_options": 19, "align_result": 17,
    "place_settings": 17, "repair_options": 16, "scene": 16,
    # the values of a LAS point, each with its model
    "context": 27, "point_item": 19, "first_point_item": 17,
    # operations of many steps
    "giving_back": 26, "tile_faces": 25, "pass": 19, "remover": 19, "rounding": 18,
    "tile_steps": 18, "joined_points": 17, "repairer": 17, "simplifying": 22}

# Rooms of libmesh, top down; an include points down this list, and not across a line of it.
FLOORS = [
    ["stream", "carry", "wrap", "offset", "simplify"],
    ["assembly"],
    ["repair", "cut"],
    ["boolean"],
    ["round"],
    ["arrange", "place"],
    ["io"],
    ["intersect"],
    ["nearness", "weld"],
    ["geometry"],
    ["topology", "attributes"],
    ["exact"],
    ["laz"],
    ["base"],
]
# A public header belongs to the room that has a source of its name; but these are of several:
# to the lowest one.
ROOM_OF_HEADER = {"as_mesh": "weld", "intersections": "intersect", "properties": "topology",
                  "offset": None}  # of rooms on one floor
# Where the packages of others may be named, of libraries and tools.
HOME_OF_PACKAGE = {
    r"(tbb|oneapi)/": "libtree/base/parallel.cpp",
    r"assimp/": "libmesh/io/",
    r"draco/": "libmesh/io/draco_gltf.cpp",
    r"(pugixml|pugiconfig|minizip/)": "libmesh/io/",
    r"(zlib|zconf)\.h": ("libmesh/io/", "tools/picture/png.cpp"),
    r"Eigen/": "libmesh/place/",
    r"mpi\.h": "tools/mpi/mpi_team.cpp",
    r"openssl/": "tools/shell/sha256.cpp",
    r"(CGAL/|gmp|mpfr|lib3mf|Model/COM)": "tests/",
}
TOP = {"libtree", "libmesh", "tools", "tests", "data", "CMakeLists.txt", "CMakePresets.json",
       "README.md", "LICENSE", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md",
       "compile_commands.json"}
READS_FILES = ("stream", "carry")  # besides tools and tests, only these rooms know of `io`

INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')


def files(root, folder, *suffixes):
    return sorted(path for path in (root / folder).rglob("*") if path.suffix in suffixes)


def sources(root, *folders):
    return [path for folder in folders for path in files(root, folder, ".cpp", ".hpp", ".h")]


def public_headers(root):
    """Those of the door: what is in detail/ is there for the compiler alone."""
    return [path for path in sources(root, "libtree/include", "libmesh/include")
            if "detail" not in path.parts]


def check_top(root):
    for path in sorted(root.iterdir()):
        if not path.name.startswith((".", "build")) and path.name not in TOP:
            yield path, 1, "does not belong at the top level"


def lines_of(path):
    return path.read_text().splitlines()


def includes(path):
    for number, line in enumerate(lines_of(path), 1):
        if match := INCLUDE.match(line):
            yield number, match[1]


# ---- the door ----

def check_door(root):
    outside = sources(root, "libtree/include", "libmesh/include", "tools", "tests/c",
                      "tests/consumer", "tests/clients")
    for path in outside:
        public = "include" in path.parts
        for number, name in includes(path):
            if re.match(r"lib(tree|mesh)/", name):
                yield path, number, f"includes the inside of a library: <{name}>"
            elif not public and re.match(r"treeform/.*\bdetail/", name):
                yield path, number, f"includes what is no part of the door: <{name}>"


def check_headers(root):
    headers = public_headers(root)
    for path in headers:
        if (count := len(lines_of(path))) > HEADER_LINES:
            yield path, count, f"a public header of more than {HEADER_LINES} lines"
    if len(headers) > PUBLIC_HEADERS:
        yield (root / "libmesh/include", 0,
               f"{len(headers)} public headers, {PUBLIC_HEADERS} at most")


# What bindings may include of tools/, beside what is in their own folder.
FOR_BINDINGS = {"python": ("bindings", "picture"), "c": ("bindings",)}


def check_bindings(root):
    """The libraries in other languages share nothing with the commands but what is named there."""
    for folder, allowed in FOR_BINDINGS.items():
        for path in sources(root, f"tools/{folder}"):
            for number, name in includes(path):
                other = re.match(r"tools/(\w+)/", name)
                if other and other[1] not in (*allowed, folder):
                    yield path, number, f"a binding may not use tools/{other[1]}: <{name}>"


DOOR, SHORT_NAME = "treeform/treeform.hpp", "treeform/tf.hpp"


def check_whole_door(root):
    """The door includes every public header; the short name `tf` comes with none of them."""
    headers = {path.as_posix().rsplit("/include/")[-1]: path for path in public_headers(root)}
    if DOOR not in headers:
        yield root / "libmesh/include" / DOOR, 0, "there is no such header"
        return
    named = {name for _, name in includes(headers[DOOR])}
    for name in sorted(headers.keys() - {DOOR, SHORT_NAME} - named):
        yield headers[DOOR], 0, f"does not include <{name}>"
    for path in headers.values():
        for number, name in includes(path):
            if name == SHORT_NAME:
                yield path, number, f"a program asks for <{name}> itself"


# ---- lists of CMake ----

def commands(path):
    """(first line, words) of each command of a CMakeLists.txt."""
    text = re.sub(r"#.*", "", path.read_text())
    for match in re.finditer(r"\w+\s*\(([^()]*)\)", text):
        yield text.count("\n", 0, match.start()) + 1, match[0].replace("(", " ").strip(")").split()


def is_file(word):
    return re.fullmatch(r"[\w./-]+\.(cpp|hpp|h)", word) is not None


def check_lists(root):
    """Files of a list stand in the order of their letters; no command stands there twice."""
    for folder in ("libtree", "libmesh", "tools", "tests/unit"):
        for path in sorted((root / folder).rglob("CMakeLists.txt")):
            seen = []
            for number, words in commands(path):
                if len(words) > 1 and words in seen:
                    yield path, number, f"a second time: {' '.join(words)}"
                seen.append(words)
                names = [word for word in words if is_file(word)]
                for first, second in zip(names, names[1:]):
                    if second < first:
                        yield path, number, f"{second} after {first}"


def check_listed(root):
    """Each source is in the list of the nearest CMakeLists.txt; headers too, but those of tools."""
    for path in sources(root, "libtree", "libmesh", "tools", "tests/unit"):
        if path.suffix == ".hpp" and root / "tools" in path.parents:
            continue
        home = next(p for p in path.parents if (p / "CMakeLists.txt").exists())
        name = path.relative_to(home).as_posix()
        if not any(name in words for _, words in commands(home / "CMakeLists.txt")):
            yield path, 0, f"not listed in {(home / 'CMakeLists.txt').relative_to(root)}"


# ---- floors ----

def room_includes(root):
    """(path, line, name included, room of the file, room of the name) in libmesh; None: of no
    room."""
    room_of = {path.stem: path.parent.name for path in files(root, "libmesh", ".cpp")}
    room_of |= ROOM_OF_HEADER

    def room_reached(name):
        if match := re.match(r"libmesh/(\w+)/", name):
            return match[1]
        if match := re.match(r"treeform/mesh/(\w+)\.hpp", name):
            return room_of.get(match[1])
        return None

    for path in sources(root, "libmesh"):
        public = "include" in path.parts
        room = room_of.get(path.stem) if public else path.relative_to(root / "libmesh").parts[0]
        for number, name in includes(path):
            yield path, number, name, room, room_reached(name)


def check_floors(root):
    floor_of = {room: floor for floor, on_it in enumerate(FLOORS) for room in on_it}
    for path in sources(root, "libtree"):
        for number, name in includes(path):
            if re.match(r"(libmesh|treeform/mesh)/", name):
                yield path, number, f"libtree knows nothing of meshes: <{name}>"
    for path in files(root, "libmesh", ".cpp", ".hpp"):
        room = path.relative_to(root / "libmesh").parts[0]
        if room != "include" and room not in floor_of:
            yield path, 0, f"room {room} is on no floor of {pathlib.Path(__file__).name}"
    for path, number, name, room, target in room_includes(root):
        if target == "io" and room != "io" and room not in READS_FILES and room is not None:
            yield path, number, f"{room} knows of files: <{name}>"
        elif room in floor_of and target in floor_of and target != room and (
                floor_of[target] <= floor_of[room]):
            yield path, number, f"{room} is not above {target}: <{name}>"


def check_packages(root):
    for path in sources(root, "libtree", "libmesh", "tools"):
        place = path.relative_to(root).as_posix()
        for number, name in includes(path):
            for package, home in HOME_OF_PACKAGE.items():
                if re.match(package, name) and not place.startswith(home):
                    yield path, number, f"only {home} may name <{name}>"


TALKS = re.compile(r"\bstd::(cout|cerr|clog|exit|abort|terminate|getenv)\b"
                   r"|\b(f?printf|f?puts|putchar|perror|getenv|system|exit|abort)\s*\(")


def check_blender(root):
    """What imports bpy runs as a part of Blender, under its license: only the add-on does."""
    for path in files(root, "tools", ".py") + files(root, "tests", ".py"):
        if path.relative_to(root).parts[1] == "blender":
            continue
        for number, line in enumerate(lines_of(path), 1):
            if re.match(r"\s*(import|from) bpy\b", line):
                yield path, number, "only tools/blender and its tests may import bpy"


def check_silence(root):
    """The library prints nothing, reads no environment and never ends the program."""
    for path in sources(root, "libtree", "libmesh"):
        for number, line in enumerate(code_of(path.read_text()).splitlines(), 1):
            if match := TALKS.search(line):
                yield path, number, f"a library does not call {match[0].strip('( ')}"


# ---- lengths ----

LEFT_OUT = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\''
                      r"|//[^\n]*|/\*.*?\*/|^[ \t]*#(?:\\\n|[^\n])*", re.DOTALL | re.MULTILINE)
SCOPE = re.compile(r"(^|\s)(namespace|class|struct|union|enum|extern)\b(?!.*\)\s*(const|noexcept|->"
                   r"|override|$))", re.DOTALL)


def code_of(text):
    """Without comments, strings and directives; every line in its place."""
    return LEFT_OUT.sub(lambda left_out: "\n" * left_out[0].count("\n"), text)


def function_lengths(text):
    """(line of the opening brace, lines) of each function: a body that is in no other body."""
    text = code_of(text)
    opened, head, depth_of_body = [], "", None
    line = 1
    for char in text:
        if char == "\n":
            line += 1
        if char == "{":
            if depth_of_body is None and "(" in head and not SCOPE.search(head):
                depth_of_body = len(opened)
            opened.append(line)
        elif char == "}" and opened:
            first = opened.pop()
            if len(opened) == depth_of_body:
                yield first, line - first + 1
                depth_of_body = None
        head = "" if char in "{};" else head + char


def check_lengths(root):
    for path in sources(root, "libtree", "libmesh", "tools"):
        if (count := len(lines_of(path))) > FILE_LINES:
            yield path, count, f"a file of more than {FILE_LINES} lines"
        for line, length in function_lengths(path.read_text()):
            if length > FUNCTION_LINES:
                yield path, line, f"a function of {length} lines, {FUNCTION_LINES} at most"


# ---- columns ----

COLUMNS = 100
# Generators whose tables are lines of code, and a table of commands: this set only shrinks.
LONGER = {"tests/cli/output_hashes.py", "tools/bindings/c_language.py",
          "tools/bindings/c_surface.py", "tools/bindings/c_write.py",
          "tools/bindings/python_language.py", "tools/bindings/python_surface.py",
          "tools/bindings/python_write.py"}


def check_columns(root):
    """No line is longer, comments included."""
    for folder in ("libtree", "libmesh", "tools", "tests"):
        for path in files(root, folder, ".cpp", ".hpp", ".h", ".c", ".py", ".pyi"):
            if path.relative_to(root).as_posix() in LONGER:
                continue
            for number, line in enumerate(lines_of(path), 1):
                if len(line) > COLUMNS:
                    yield path, number, f"{len(line)} columns, {COLUMNS} at most"


# ---- members ----

CLASS_HEAD = re.compile(r"\b(?:class|struct)\s+(?:[A-Z_]+\s+)?([\w:]+)(?:\s+final)?"
                        r"(?:\s*<[^;{}]*>)?"
                        r"(?:\s*:[^:;{}][^;{}]*)?\s*$")
NO_MEMBER = re.compile(r"\s*(using|typedef|friend|static|enum|class|struct|union|template"
                       r"|extern)\b")
ANGLES = re.compile(r"<[^<>]*>")


def declared_members(statement):
    """How many data members a statement of a class declares: `double x = 0, y;` has two."""
    statement = re.sub(r"\b(public|private|protected)\s*:", "", statement).strip()
    if NO_MEMBER.match(statement):
        return 0
    statement = re.sub(r"\boperator\b.*|alignas\s*\(\w+\)|\[\[\w+\]\]", "", statement)
    while (without := ANGLES.sub("", statement)) != statement:
        statement = without
    names = re.sub(r"=[^,]*|\[[^\]]*\]", "", statement)
    return 0 if "(" in names or len(names.split()) < 2 else 1 + names.count(",")


def class_members(text):
    """(line of the opening brace, name, data members) of each class or struct with a name."""
    opened, head, line = [], "", 1
    for char in code_of(text):
        line += char == "\n"
        if char == "{":
            match = CLASS_HEAD.search(head)
            opened.append({"name": match and match[1], "line": line, "count": 0,
                           # of `int i{1};` it goes on
                           "head": "" if match or "(" in head else head})
            head = ""
        elif char == "}" and opened:
            closed = opened.pop()
            if closed["name"]:
                yield closed["line"], closed["name"], closed["count"]
            head = closed["head"]
        elif char == ";":
            if opened and opened[-1]["name"]:
                opened[-1]["count"] += declared_members(head)
            head = ""
        else:
            head += char


def check_members(root):
    """What C has is what C++ has, field by field: it is not counted twice."""
    for path in sources(root, "libtree", "libmesh", "tools"):
        if root / "tools/c/include" in path.parents:
            continue
        for line, name, count in class_members(path.read_text()):
            if count > (most := MORE_MEMBERS.get(name, MEMBERS)):
                yield path, line, f"{name} has {count} data members, {most} at most"


# ---- pages of rooms ----

def rooms(root):
    """Folders with sources of the libraries, and those of tools that commands share."""
    for folder in sorted(path for top in ("libtree", "libmesh", "tools")
                         if (root / top).exists() for path in (root / top).iterdir()):
        if folder.is_dir() and folder.name != "include" and not folder.name.startswith("tf-"):
            if any(path.suffix in (".cpp", ".hpp", ".js", ".py") for path in folder.rglob("*")):
                yield folder


def check_pages(root):
    for room in rooms(root):
        if not (room / "README.md").exists():
            yield room, 0, "a room without a README.md"


CHECKS = [check_top, check_door, check_headers, check_whole_door, check_bindings, check_lists,
          check_listed, check_floors, check_packages, check_blender, check_silence, check_lengths,
          check_columns, check_members, check_pages]


def faults(root):
    return [f"{path.relative_to(root)}:{line}: {what}" for check in CHECKS
            for path, line, what in check(root)]


WRONG = {  # each file with what is to be said of it
    "box.ply": ("", ["does not belong"]),
    "libmesh/include/treeform/mesh/door.hpp": ("#include <libmesh/weld/a.hpp>\n" * 251,
                                               ["the inside", "more than 250"]),
    "libmesh/include/treeform/treeform.hpp": ("#include <treeform/tf.hpp>\n",
                                              ["not include <treeform/mesh/door.hpp>",
                                               "asks for <treeform/tf.hpp>"]),
    "libmesh/weld/a.cpp": ("#include <libmesh/boolean/b.hpp>\n", ["weld is not above boolean"]),
    "libmesh/weld/reads.cpp": ("#include <treeform/mesh/read.hpp>\n", ["knows of files"]),
    "libmesh/io/read.cpp": ("int f() {\n" + "    g();\n" * 59 + "}\n", ["of 61 lines"]),
    "libmesh/boolean/b.hpp": ("\n" * 501, ["more than 500"]),
    "libmesh/lost/c.cpp": ("", ["on no floor"]),
    "libmesh/lost/wide.hpp": ("// " + "w" * 98 + "\n", ["101 columns"]),
    "libmesh/weld/talks.cpp": ('#include <Eigen/Dense>\nint f() { return std::printf("a"); }\n',
                               ["only libmesh/place/", "call printf"]),
    "libmesh/weld/CMakeLists.txt": ("target_sources(t PRIVATE\n reads.cpp\n a.cpp)\n",
                                    ["a.cpp after reads.cpp"]),
    "libtree/d.cpp": ("#include <treeform/mesh/mesh.hpp>\n", ["not listed", "nothing of meshes"]),
    "libtree/CMakeLists.txt": ("", []),
    "libmesh/CMakeLists.txt": ("", []),
    "tools/python/src/own.cpp": ('#include "tools/picture/a.hpp"\n#include "tools/shell/b.hpp"\n',
                                 ["2: a binding may not use tools/shell"]),
    "tools/python/treeform/_b.py": ("import bpy\n", ["1: only tools/blender"]),
    "tools/blender/b.py": ("import bpy\n", []),
    "tools/tf-x/e.cpp": ("#include <treeform/tree/detail/split.hpp>\n", ["no part of the door"]),
    "tools/tf-x/f.cpp": ("struct many {\n" + "".join(
        f"    int a{i} = f();\n    int b{i}{{0}};\n" for i in range(8))
                         + "    void g() { int x; }\n    bool operator==(const many&) const;\n};\n",
                         ["many has 16 data members"]),
    "tools/CMakeLists.txt": ("", []),
}
RIGHT = """
namespace a {
class b {
  public:
    b(int i) : i_{i} {}
    const char* text() const { return "}{"; }
}; // 90 lines of a class are no function: {
enum class c { d };
const int e[] = {1, 2};
}
""" + "\n" * 70


def self_test():
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, (text, _) in WRONG.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        said = faults(root)
    for name, (_, wanted) in (WRONG | {"libmesh/weld:": ("", ["without a README.md"])}).items():
        for what in wanted:
            assert any(line.startswith(name) and what in line for line in said), (name, what)
    assert [length for _, length in function_lengths(RIGHT)] == [1, 1]
    print("what is misplaced is found")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    broken = faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve())
    print("\n".join(broken) if broken else "every file is where it belongs")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
