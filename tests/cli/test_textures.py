"""The texture files that a PLY names, and the numbers by which its faces name them, are carried by
the tools."""

import shutil

from boolean_support import *

# Texture coordinates say which texture is meant: (u, u, u) is TEXTURES[u].
TEXTURES = ["a.png", "b c.jpg", "d.png", "nothing"]


def textured_ply(mesh, names, of_face, numbered=True, kind="int", face_column=None):
    """Face i has the texture `of_face(i)`, whose number in `names` stands where `numbered`, or what
    `face_column(i)` says."""
    points, faces = mesh
    numbered = numbered or face_column is not None
    lines = ["ply", "format ascii 1.0", "comment made by hand"]
    lines += ["comment TextureFile " + name for name in names]
    lines += [f"element vertex {len(points)}"] + [f"property float {k}" for k in "xyz"]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices",
              "property list uchar float texcoord"]
    lines += [f"property {kind} texnumber"] * numbered + ["end_header"]
    lines += ["%r %r %r" % p for p in points]
    for i, face in enumerate(faces):
        name = of_face(i)
        values = [TEXTURES.index(os.path.basename(name))] * 2 * len(face)
        row = [len(face), *face, len(values), *values]
        if numbered:
            row.append(face_column(i) if face_column else names.index(name))
        lines.append(" ".join(map(str, row)))
    return "\n".join(lines) + "\n"


class Read:
    """An ASCII PLY: names of textures, whether faces have numbers, points, and of each face its
    corners, u (None where it has none) and number."""

    def __init__(self, text):
        head, body = text.split("end_header\n")
        self.names = [l[20:] for l in head.splitlines() if l.startswith("comment TextureFile ")]
        columns, counts = {"vertex": [], "face": []}, {}
        for line in head.splitlines():
            words = line.split()
            if words[0] == "element":
                element = words[1]
                counts[element] = int(words[2])
            elif words[0] == "property":
                columns[element].append((words[-1], words[1] == "list"))
        self.columns = [name for name, _ in columns["face"]]
        self.numbered = "texnumber" in self.columns
        rows = body.splitlines()
        self.points = [tuple(map(float, row.split()[:3])) for row in rows[:counts["vertex"]]]
        self.faces = []
        for row in rows[counts["vertex"]:counts["vertex"] + counts["face"]]:
            values, face = row.split(), {}
            for name, is_list in columns["face"]:
                count = int(values.pop(0)) if is_list else 1
                face[name], values = values[:count], values[count:]
            us = {float(u) for u in face.get("texcoord", [])}
            assert len(us) < 2
            number = int(face["texnumber"][0]) if self.numbered else None
            self.faces.append((face["vertex_indices"], us.pop() if us else None, number))

    def name_of(self, number):
        if number is None:
            return self.names[0]
        return self.names[number] if 0 <= number < len(self.names) else "nothing"


class TextureTest(BooleanTest):
    def run_as(self, tool, *arguments):
        """Its warnings without those of names of parts, which PLY does not hold."""
        self.tool = tool
        report = self.report(*arguments, "--output-format", "ply", "--ascii", "-f", status=0)
        return [w["code"] for w in report["files"][0]["warnings"] if w["code"] != "data-dropped"]

    def check(self, name):
        """Every face has the texture that its coordinates are of; which ones there are."""
        mesh = Read(self.read(name))
        found = set()
        for _, u, number in mesh.faces:
            if u is not None:
                self.assertEqual(os.path.basename(mesh.name_of(number)), TEXTURES[int(u)])
                found.add(TEXTURES[int(u)])
        return mesh, found

    LOW, HIGH = box((0, 0, 0), (2, 2, 2)), box((1, 1, 1), (3, 3, 3))
    FAR = box((5, 0, 0), (7, 3, 2))

    def two(self, second=FAR, first_kind="int", second_kind="uchar"):
        """Inputs that have b c.jpg in common, under different numbers."""
        a, b = ["a.png", "b c.jpg"], ["b c.jpg", "d.png"]
        self.put("a.ply", textured_ply(self.LOW, a, lambda i: a[i % 2], kind=first_kind))
        self.put("b.ply", textured_ply(second, b, lambda i: b[i // 6], kind=second_kind))
        return ["a.png", "b c.jpg", "d.png"]

    def many(self):
        """How each tool makes one file of a.ply and b.ply."""
        return {"boolean": (BOOLEAN, "union", "a.ply", "b.ply", "-o"),
                "weld": (WELD, "a.ply", "b.ply", "--join", "-o"),
                "plate": (PLACE, "pack", "a.ply", "b.ply", "--size", "40,40", "-o"),
                "scene": (PLACE, "measure", "a.ply", "--fixed", "b.ply", "--scene", "-o")}


class One(TextureTest):
    def test_all_tools_keep_names_and_numbers(self):
        names = ["a.png", "b c.jpg", "a.png"]
        text = textured_ply(self.LOW, names, lambda i: names[i % 2], kind="uchar")
        self.put("in/a.ply", text)
        os.makedirs(self.path("out"))
        crossing = together(self.LOW, self.HIGH)
        self.put("in/x.ply", textured_ply(crossing, names, lambda i: names[i // 12]))
        runs = [(BOOLEAN, "union", "in/a.ply"), (WELD, "in/a.ply"), (TOOL, "in/a.ply"),
                (TOOL, "--repair", "in/x.ply"), (TOOL, "--repair=split", "in/x.ply"),
                (PLACE, "lay", "in/a.ply"), (PLACE, "pack", "in/a.ply", "--size", "9,9")]
        for tool, *arguments in runs:
            with self.subTest(arguments=arguments):
                self.assertEqual(self.run_as(tool, *arguments, "-o", "out/o.ply"), [])
                mesh, found = self.check("out/o.ply")
                self.assertEqual(mesh.names, ["../in/" + n for n in names])
                self.assertEqual(found, {"a.png", "b c.jpg"})
                self.assertTrue(mesh.numbered)
                # In the folder of the input, and to a stream, they are as they were.
                self.run_as(tool, *arguments, "-o", "in/o.ply")
                self.assertEqual(self.check("in/o.ply")[0].names, names)

    def test_numbers_that_name_nothing_stay(self):
        self.put("a.ply", textured_ply(self.LOW, ["a.png"], lambda i: "nothing",
                                       face_column=lambda i: 7 - 2 * i))
        for tool, *arguments in ((BOOLEAN, "union"), (WELD,), (PLACE, "lay"), (TOOL,),
                                 (PLACE, "pack", "--size", "9,9")):
            with self.subTest(tool=tool):
                self.assertEqual(self.run_as(tool, *arguments, "a.ply", "-o", "out.ply"), [])
                self.assertEqual([n for _, _, n in self.check("out.ply")[0].faces],
                                 [7 - 2 * i for i in range(12)])

    def test_files_without_numbers_get_none(self):
        self.put("a.ply", textured_ply(self.LOW, ["a.png"], lambda i: "a.png", numbered=False))
        self.put("b.ply", textured_ply(self.FAR, ["a.png"], lambda i: "a.png", numbered=False))
        for kind, arguments in self.many().items():
            with self.subTest(kind=kind):
                self.assertEqual(self.run_as(*arguments, "out.ply"), [])
                mesh, found = self.check("out.ply")
                self.assertEqual((mesh.names, mesh.numbered, found), (["a.png"], False, {"a.png"}))
                self.assertEqual(len(mesh.faces), 24)

    def test_formats_without_them_say_so(self):
        self.two()
        for extension in ("obj", "stl", "off", "glb"):
            codes = [w["code"] for w in self.entry("union", "a.ply", "-o", "out." + extension,
                                                   status=0)["warnings"]]
            self.assertEqual(codes.count("materials"), 1, msg=extension)
            codes = [w["code"] for w in self.entry("union", "a.ply", "b.ply", "--no-attributes",
                                                   "-f", "-o", "out." + extension,
                                                   status=0)["warnings"]]
            self.assertEqual(codes, [])
        self.assertEqual(self.run_as(BOOLEAN, "union", "a.ply", "b.ply", "--no-attributes", "-o",
                                     "out.ply"), [])
        self.assertNotRegex(self.read("out.ply"), "TextureFile|texnumber|texcoord")


class Several(TextureTest):
    def test_each_name_stands_once_and_faces_are_renumbered(self):
        for second in (self.FAR, self.HIGH):
            names = self.two(second)
            for kind, arguments in self.many().items():
                with self.subTest(kind=kind):
                    self.assertEqual(self.run_as(*arguments, "out.ply"), [])
                    mesh, found = self.check("out.ply")
                    self.assertEqual((mesh.names, found), (names, set(names)))
                    self.assertIn("property int texnumber", self.read("out.ply"))

    def test_names_are_seen_from_the_folder_of_the_output(self):
        self.two()
        for kind, arguments in self.many().items():
            with self.subTest(kind=kind):
                for name in "ab":
                    os.makedirs(self.path("in/" + name), exist_ok=True)
                    shutil.copy(self.path(name + ".ply"), self.path("in/" + name))
                moved = ["in/%s/%s" % (a[0], a) if a in ("a.ply", "b.ply") else a
                         for a in arguments]
                self.assertEqual(self.run_as(*moved, "in/out.ply"), [])
                mesh, _ = self.check("in/out.ply")
                # One name in two folders is two files.
                self.assertEqual(mesh.names, ["a/a.png", "a/b c.jpg", "b/b c.jpg", "b/d.png"])

    def test_faces_without_a_number_have_the_first_name_of_their_file(self):
        for first_has, second_has in ((True, False), (False, True), (False, False)):
            self.put("a.ply", textured_ply(self.LOW, ["a.png"], lambda i: "a.png", first_has))
            self.put("b.ply", textured_ply(self.FAR, ["b c.jpg", "d.png"], lambda i: "b c.jpg",
                                           second_has))
            for kind, arguments in self.many().items():
                with self.subTest(kind=kind, first_has=first_has, second_has=second_has):
                    self.assertEqual(self.run_as(*arguments, "out.ply"), [])
                    mesh, found = self.check("out.ply")
                    self.assertEqual(mesh.names, ["a.png", "b c.jpg", "d.png"])
                    self.assertEqual(found, {"a.png", "b c.jpg"})

    def test_faces_of_a_file_without_names_have_no_texture(self):
        self.put("a.ply", textured_ply(self.LOW, [], lambda i: "nothing", False))
        self.put("b.ply", textured_ply(self.FAR, ["b c.jpg"], lambda i: "b c.jpg", False))
        self.put("bare.ply", textured_ply(self.LOW, [], lambda i: "nothing", False)
                 .replace("texcoord", "other"))
        for kind, arguments in self.many().items():
            with self.subTest(kind=kind):
                self.assertEqual(self.run_as(*arguments, "out.ply"), [])
                mesh, found = self.check("out.ply")
                self.assertEqual((mesh.names, found), (["b c.jpg"], {"nothing", "b c.jpg"}))
                # Without texture coordinates there is nothing to tell apart.
                self.run_as(*["bare.ply" if a == "a.ply" else a for a in arguments], "out.ply")
                self.assertFalse(self.check("out.ply")[0].numbered)

    def test_numbers_that_name_nothing_are_warned_of(self):
        b = ["b c.jpg", "d.png"]
        for bad, warned in ((2, True), (-2, True), (0.5, True), ("nan", True), (-1, False)):
            self.put("a.ply", textured_ply(
                self.LOW, ["a.png"], lambda i: "a.png" if i else "nothing", kind="float",
                face_column=lambda i: 0 if i else bad))
            self.put("b.ply", textured_ply(self.FAR, b, lambda i: b[i % 2]))
            for kind, arguments in self.many().items():
                with self.subTest(kind=kind, bad=bad):
                    self.assertEqual(self.run_as(*arguments, "out.ply"), ["textures"] * warned)
                    mesh, found = self.check("out.ply")
                    self.assertEqual(found, {"a.png", "nothing", *b})
                    self.assertEqual([n for _, _, n in mesh.faces].count(-1), 1)

    def test_lists_of_numbers_are_replaced(self):
        self.two()
        text = textured_ply(self.LOW, ["a.png"], lambda i: "a.png", face_column=lambda i: "1 7")
        self.put("a.ply", text.replace("property int", "property list uchar int"))
        for kind, arguments in self.many().items():
            with self.subTest(kind=kind):
                # Scenes have no other properties of faces anyway.
                warned = ["textures"] if kind in ("boolean", "weld") else []
                self.assertEqual(self.run_as(*arguments, "out.ply"), warned)
                self.check("out.ply")

    def test_a_scene_has_no_names_of_one_before(self):
        self.two()
        self.put("c.ply", textured_ply(self.LOW, ["d.png"], lambda i: "d.png"))
        os.makedirs(self.path("out"))
        self.run_as(PLACE, "measure", "a.ply", "c.ply", "--fixed", "b.ply", "--scene",
                    "--output-dir", "out")
        for name, names in (("a", ["a.png", "b c.jpg", "d.png"]), ("c", ["d.png", "b c.jpg"])):
            mesh, found = self.check(f"out/{name}-place.ply")
            self.assertEqual((mesh.names, found), (["../" + n for n in names], set(names)))

    def test_polygons_have_the_numbers_of_all_their_triangles(self):
        points, _ = self.LOW
        quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        names = self.two()
        self.put("a.ply", textured_ply((points, quads), names, lambda i: names[i % 3]))
        for kind, arguments in self.many().items():
            with self.subTest(kind=kind):
                self.assertEqual(self.run_as(*arguments, "out.ply"), [])
                mesh, found = self.check("out.ply")
                self.assertEqual(found, set(names))
                self.assertEqual(len(mesh.faces), 6 + 12 if kind == "weld" else 24)

    def test_faces_of_two_textures_stay_apart_where_a_result_is_simplified(self):
        # All texture coordinates are alike.
        for name, mesh in (("a", self.LOW), ("b", box((2, 0, 0), (4, 2, 2)))):
            self.put(name + ".ply",
                     textured_ply(mesh, [name + "/a.png"], lambda i: name + "/a.png"))
        self.run_as(BOOLEAN, "union", "a.ply", "b.ply", "--merge-coplanar", "-o", "out.ply")
        mesh, _ = self.check("out.ply")
        self.assertEqual(mesh.names, ["a/a.png", "b/a.png"])
        for corners, _, number in mesh.faces:
            xs = [mesh.points[int(c)][0] for c in corners]
            self.assertTrue(min(xs) >= 2 if number else max(xs) <= 2)
        self.assertEqual({number for _, _, number in mesh.faces}, {0, 1})


class Materials(TextureTest):
    def test_materials_of_one_name_and_two_files_are_warned_of_by_all_tools(self):
        for name, mesh in (("a", self.LOW), ("b", self.FAR), ("c", box((9, 0, 0), (10, 1, 1)))):
            library = "mtllib %s.mtl\nusemtl Material\n" % name.replace("c", "a")
            self.put(name + ".obj", library + obj_bytes(mesh).decode())
        runs = [(BOOLEAN, "union", "a.obj", "b.obj"), (WELD, "a.obj", "b.obj", "--join"),
                (PLACE, "pack", "a.obj", "b.obj", "--size", "40,40"),
                (PLACE, "measure", "a.obj", "--fixed", "b.obj", "--scene")]
        for tool, *arguments in runs:
            with self.subTest(arguments=arguments):
                self.tool = tool
                words = "different material files use the same name for material Material"
                found = [w["text"] for w in self.entry(*arguments, "-f", "-o", "out.obj",
                                                       status=0)["warnings"]
                         if w["code"] == "materials"]
                self.assertEqual(len(found), 1)
                self.assertIn(words, found[0])
                same = ["c.obj" if a == "b.obj" else a for a in arguments]
                self.assertNotIn("materials", self.run_tool(*same, "-f", "-o", "out.obj",
                                                            status=0).err)
                # Where no materials are written, none are mixed up.
                self.assertNotIn("alike", self.run_tool(*arguments, "-f", "-o", "out.stl",
                                                        status=0).err)


if __name__ == "__main__":
    main()
