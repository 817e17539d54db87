"""What an OBJ says per corner (texture coordinates, normals) and per face (materials) is carried by
the tools."""

import re
import struct

from boolean_support import *


def affine(p):
    """Texture coordinates of the box that they belong to."""
    return (0.125 + 0.25 * p[0] - 0.5 * p[2], 3 + 0.5 * p[1] + 0.25 * p[2])


def textured_text(mesh, normals=True, seam=None, head="", uv=affine, material=None):
    """Every face has a row a corner of its own in flat normals; texture rows are shared by points,
    except for the faces `seam`, which are moved by 10."""
    points, faces = mesh
    lines = [head] if head else []
    lines += ["v %r %r %r" % p for p in points]
    lines += ["vt %r %r" % uv(p) for p in points]
    lines += ["vt %r %r" % tuple(c + 10 for c in uv(p)) for p in points]
    axes = []
    for a, b, c in faces:
        n = normal_of([points[a], points[b], points[c]])
        if n not in axes:
            axes.append(n)
    if normals:
        lines += ["vn %r %r %r" % n for n in axes]
    for i, face in enumerate(faces):
        if material:
            lines.append("usemtl " + material(i))
        n = axes.index(normal_of([points[c] for c in face])) + 1
        shift = len(points) if seam and i in seam else 0
        lines.append("f " + " ".join(
            f"{c + 1}/{c + 1 + shift}" + (f"/{n}" if normals else "") for c in face))
    return "\n".join(lines) + "\n"


def normal_of(corners):
    (a, b, c) = corners
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = sum(x * x for x in n) ** 0.5
    return tuple(x / length + 0.0 for x in n)


class Parsed:
    """v, vt, vn, faces of (v, vt, vn) from 0 or None, the material of each face, mtllib."""

    def __init__(self, text):
        self.v, self.vt, self.vn = [], [], []
        self.faces, self.materials, self.libraries = [], [], []
        material = ""
        for line in text.splitlines():
            word, *rest = line.split()
            if word in ("v", "vt", "vn"):
                getattr(self, word).append(tuple(map(float, rest)))
            elif word == "usemtl":
                material = " ".join(rest)
            elif word == "mtllib":
                self.libraries.append(" ".join(rest))
            elif word == "f":
                corners = [[int(n) - 1 if n else None for n in (c + "//").split("/")[:3]]
                           for c in rest]
                self.faces.append(corners)
                self.materials.append(material)

    def normal(self, face):
        return normal_of([self.v[v] for v, _, _ in face[:3]])


class CornerTest(BooleanTest):
    def parsed(self, name):
        return Parsed(self.read(name))

    def warnings(self, *arguments, status=0):
        return [w["code"] for w in self.entry(*arguments, status=status)["warnings"]]

    def boxes(self, **options):
        self.put("a.obj", textured_text(box((0, 0, 0), (2, 2, 2)), **options))
        self.put("b.obj", textured_text(box((0.7, 0.9, 1.1), (3, 3.5, 3.7)), **options))

    def check_rows(self, mesh, uv=affine):
        """Every corner has what the function of its place says, and the normal of its face."""
        self.assertTrue(mesh.faces)
        for face in mesh.faces:
            for v, vt, vn in face:
                for is_there, should_be in zip(mesh.vt[vt], uv(mesh.v[v])):
                    self.assertLess(abs(is_there - should_be), 1e-12)
                for is_there, should_be in zip(mesh.vn[vn], mesh.normal(face)):
                    self.assertLess(abs(is_there - should_be), 1e-12)


    def soup(self):
        """A box with points of its own in each face, and a texture row a corner."""
        points, faces = box((0, 0, 0), (2, 2, 2))
        corners = [points[c] for f in faces for c in f]
        return textured_text((corners, [(i, i + 1, i + 2) for i in range(0, 36, 3)]))


class Booleans(CornerTest):
    def test_texture_coordinates_and_normals_are_those_of_the_faces_of_the_inputs(self):
        self.boxes()
        for operation in ("union", "intersection", "difference", "symmetric-difference", "split"):
            run = self.run_tool(operation, "a.obj", "b.obj", "-o", "out.obj", "-f", status=0)
            if operation != "symmetric-difference":  # touches itself
                self.assertNotIn("warning", run.err)
            self.check_rows(self.parsed("out.obj"))

    def test_rows_are_shared_as_in_the_inputs_and_stand_once(self):
        self.boxes()
        self.run_tool("union", "a.obj", "-o", "same.obj", status=0)
        mesh = self.parsed("same.obj")
        self.assertEqual((len(mesh.vt), len(mesh.vn)), (8, 6))
        self.run_tool("difference", "a.obj", "b.obj", "-o", "out.obj", status=0)
        mesh = self.parsed("out.obj")
        used = [c[1] for f in mesh.faces for c in f], [c[2] for f in mesh.faces for c in f]
        for numbers, rows in zip(used, (mesh.vt, mesh.vn)):
            first_uses = list(dict.fromkeys(numbers))
            self.assertEqual(first_uses, list(range(len(rows))))
        # Flat faces keep the one row that they had; three sides of b are turned around.
        self.assertEqual(len(mesh.vn), 6 + 3)
        self.assertNotIn("-0 ", self.read("out.obj"))
        # Where an edge was cut, the faces on both sides still share a row: one for each input.
        for k in (1, 2):
            rows_at = {}
            for face in mesh.faces:
                for corner in face:
                    key = (corner[0], mesh.normal(face) if k == 2 else None)
                    rows_at.setdefault(key, set()).add(corner[k])
            self.assertLessEqual(max(map(len, rows_at.values())), 2)

    def test_points_that_are_one_by_place_have_the_rows_of_each_face(self):
        self.boxes()
        self.put("a.obj", self.soup())
        self.run_tool("difference", "a.obj", "b.obj", "-o", "out.obj", status=0)
        self.check_rows(self.parsed("out.obj"))
        self.run_tool("union", "a.obj", "-o", "same.obj", status=0)
        mesh = self.parsed("same.obj")
        self.assertEqual((len(mesh.v), len(mesh.vt), len(mesh.vn)), (8, 36, 6))

    def test_a_seam_stays_a_seam(self):
        # Two faces of the bottom, z = 0, are elsewhere in the picture.
        self.boxes(seam=(0, 1))
        self.run_tool("union", "a.obj", "b.obj", "-o", "out.obj", status=0)
        mesh = self.parsed("out.obj")
        elsewhere = 0
        for face in mesh.faces:
            moved = mesh.normal(face) == (0, 0, -1)
            for v, vt, _ in face:
                u = mesh.vt[vt][0] - affine(mesh.v[v])[0]
                self.assertLess(abs(u - 10 * moved), 1e-12)
                elsewhere += moved
        self.assertGreater(elsewhere, 0)

    def test_smooth_normals_stay_of_length_one(self):
        points, faces = box((-1, -1, -1), (1, 1, 1))
        third = 3 ** -0.5
        text = "\n".join(["v %r %r %r" % p for p in points] +
                         ["vn %r %r %r" % tuple(third * x for x in p) for p in points] +
                         ["f " + " ".join(f"{c + 1}//{c + 1}" for c in f) for f in faces]) + "\n"
        self.put("round.obj", text)
        self.mesh("hole.obj", box((-0.5, -0.5, -3), (0.5, 0.5, 3)))
        self.run_tool("difference", "round.obj", "hole.obj", "-o", "out.obj", status=0)
        mesh = self.parsed("out.obj")
        of_hole = cut = 0
        for face in mesh.faces:
            if face[0][2] is None:
                of_hole += 1
                continue
            for v, _, vn in face:
                n = mesh.vn[vn]
                self.assertLess(abs(sum(x * x for x in n) - 1), 1e-14)
                cut += abs(n[0]) < 0.55
                # Along the line in which the point lies, except for the diagonal of the face.
                self.assertGreater(sum(a * b for a, b in zip(n, mesh.normal(face))), 0.5)
        self.assertEqual(of_hole, sum(f[0][2] is None for f in mesh.faces))
        self.assertGreater(of_hole, 0)
        self.assertGreater(cut, 0)

    def test_corners_without_values_have_none_in_the_result(self):
        self.put("a.obj", textured_text(box((0, 0, 0), (2, 2, 2))))
        self.run_tool("difference", "a.obj", "b.obj", "-o", "out.obj", status=0)
        mesh = self.parsed("out.obj")
        bare = [f for f in mesh.faces if f[0][1] is None]
        self.assertGreater(len(bare), 0)
        for face in bare:  # of b, whose inner sides are at 1
            self.assertTrue(all(c[1] is None and c[2] is None for c in face))
            self.assertTrue(any(all(mesh.v[v][k] == 1 for v, _, _ in face) for k in range(3)))

    def test_a_matrix_turns_the_normals(self):
        self.boxes()
        self.put("m.txt", "0 -1 0 5\n1 0 0 0\n0 0 2 0\n0 0 0 1\n")
        self.run_tool("union", "a.obj", "--matrix", "1:m.txt", "-o", "out.obj", status=0)
        mesh = self.parsed("out.obj")
        back = lambda p: affine((p[1], 5 - p[0], p[2] / 2))
        self.check_rows(mesh, back)

    def test_no_attributes_leaves_all_of_it_out(self):
        self.boxes(head="mtllib a.mtl", material=lambda i: "m%d" % (i // 6))
        self.run_tool("union", "a.obj", "b.obj", "--no-attributes", "-o", "out.obj", status=0)
        self.assertEqual(set(line.split()[0] for line in self.read("out.obj").splitlines()),
                         {"v", "f"})
        self.assertNotIn("/", self.read("out.obj"))

    def test_materials_are_those_of_the_source_faces(self):
        self.put("sub/a.obj", textured_text(box((0, 0, 0), (2, 2, 2)), head="mtllib a.mtl",
                                            material=lambda i: ("oak", "pine")[i // 6]))
        self.put("b.obj", "o other\ng some\n" +
                 textured_text(box((1, 1, 1), (3, 3, 3)), head="mtllib /lib/b.mtl",
                               material=lambda i: "steel"))
        os.makedirs(self.path("made"))
        self.run_tool("difference", "sub/a.obj", "b.obj", "-o", "made/out.obj", status=0)
        mesh = self.parsed("made/out.obj")
        self.assertEqual(mesh.libraries, ["../sub/a.mtl", "/lib/b.mtl"])
        self.assertNotRegex(self.read("made/out.obj"), r"(?m)^[og] ")
        for face, material in zip(mesh.faces, mesh.materials):
            normal = mesh.normal(face)
            inside = all(all(1 <= x <= 2 for x in mesh.v[v]) for v, _, _ in face)
            if inside and sum(normal) == 1 and all(mesh.v[v][normal.index(1)] == 1
                                                   for v, _, _ in face):
                self.assertEqual(material, "steel")
            else:  # the first six faces of a box look along z and down y
                self.assertEqual(material, "oak" if normal[2] or normal[1] < 0 else "pine")
        # So are names that are whole on another system.
        self.put("sub/c.obj", "mtllib C:\\x\\c.mtl\nmtllib \\\\host\\d.mtl\n" +
                 textured_text(box((0, 0, 0), (2, 2, 2))))
        self.run_tool("union", "sub/c.obj", "-o", "made/c.obj", status=0)
        self.assertEqual(self.parsed("made/c.obj").libraries, ["C:\\x\\c.mtl", "\\\\host\\d.mtl"])
        # In the folder of the input the name is as it was; to a stream it is as given.
        self.run_tool("union", "sub/a.obj", "-o", "sub/out.obj", status=0)
        self.assertEqual(self.parsed("sub/out.obj").libraries, ["a.mtl"])
        text = self.run_tool("union", "sub/a.obj", "-o", "-", "--output-format", "obj",
                             status=0).text
        self.assertIn("mtllib a.mtl\n", text)

    def test_materials_of_one_name_and_two_files_are_warned_of(self):
        for name in "ab":
            self.put(name + ".obj", textured_text(box((0, 0, 0), (2, 2, 2)),
                                                  head=f"mtllib {name}.mtl",
                                                  material=lambda i: "Material"))
        self.assertIn("materials", self.warnings("union", "a.obj", "b.obj", "-o", "out.obj"))
        self.assertNotIn("materials", self.warnings("union", "a.obj", "a.obj", "-o", "two.obj"))

    def test_simplifying_does_not_merge_what_looks_different(self):
        self.boxes()
        self.run_tool("union", "a.obj", "b.obj", "--merge-coplanar", "-o", "out.obj", status=0)
        self.check_rows(self.parsed("out.obj"))
        # One value on a whole side, and one material: these may go together.
        points, faces = box((0, 0, 0), (2, 2, 2))
        flat = "\n".join(["v %r %r %r" % p for p in points] +
                         ["vt %d 0.5" % i for i in range(6)] +
                         ["f " + " ".join(f"{c + 1}/{i // 2 + 1}" for c in f)
                          for i, f in enumerate(faces)]) + "\n"
        self.put("flat.obj", flat)
        self.put("cut.obj", flat.replace("2.0", "1.0"))
        self.mesh("bare.obj", box((1, 1, 1), (3, 3, 3)))
        run = self.entry("difference", "flat.obj", "bare.obj", "--merge-coplanar", "-o", "f.obj",
                         status=0)
        bare = self.entry("difference", "a.obj", "bare.obj", "--merge-coplanar",
                          "--no-attributes", "-o", "g.obj", status=0)
        self.assertEqual(run["output"]["faces"], bare["output"]["faces"])
        colors = {}
        mesh = self.parsed("f.obj")
        for face in mesh.faces:
            if face[0][1] is not None:
                self.assertEqual(len({vt for _, vt, _ in face}), 1)
                colors.setdefault(mesh.normal(face), set()).add(face[0][1])
        self.assertEqual(sorted(len(c) for c in colors.values()), [1] * 6)

    def test_formats_without_corners_say_so(self):
        self.boxes()
        self.assertEqual(self.warnings("union", "a.obj", "b.obj", "-o", "o.stl").count(
            "corner-values"), 1)
        self.assertNotIn("corner-values", self.warnings("union", "a.obj", "b.obj",
                                                        "--no-attributes", "-o", "p.stl"))

    def test_a_ply_has_wedge_coordinates(self):
        self.put("a.obj", textured_text(box((0, 0, 0), (2, 2, 2)), normals=False))
        self.assertEqual(self.warnings("difference", "a.obj", "b.obj", "--ascii", "-o", "o.ply"),
                         [])
        self.run_tool("union", "o.ply", "-o", "again.obj", status=0)
        mesh = self.parsed("again.obj")
        with_texture = 0
        for face in mesh.faces:
            for v, vt, _ in face:
                if vt is None:
                    continue
                with_texture += 1
                self.assertEqual(mesh.vt[vt], affine(mesh.v[v]))  # floats hold these
        self.assertGreater(with_texture, 30)

    def test_wedge_coordinates_that_are_double_stay_double(self):
        self.put("a.obj", textured_text(box((0, 0, 0), (2, 2, 2)), normals=False))
        self.run_tool("union", "a.obj", "--ascii", "-o", "single.ply", status=0)
        text = self.read("single.ply").replace("uchar float texcoord", "uchar double texcoord")
        self.put("double.ply", text.replace("0.625", "0.6"))
        self.run_tool("union", "double.ply", "-o", "out.ply", status=0)
        self.run_tool("union", "out.ply", "-o", "out.obj", status=0)
        self.assertEqual({vt[0] for vt in self.parsed("out.obj").vt}, {0.125, 0.6, -0.875, -0.375})

    def test_repair_carries_them(self):
        points, faces = together(box((0, 0, 0), (2, 2, 2)), box((0.7, 0.9, 1.1), (3, 3.5, 3.7)))
        self.put("part.obj", textured_text((points, faces), head="mtllib a.mtl",
                                           material=lambda i: "oak" if i < 12 else "pine"))
        for mode in ("outer", "split"):
            done = subprocess.run([TOOL, "--repair=" + mode, "part.obj", "-f", "-o", "out.obj"],
                                  cwd=self.folder, capture_output=True)
            self.assertEqual(done.returncode, 0, msg=done.stderr.decode())
            mesh = self.parsed("out.obj")
            self.check_rows(mesh)
            self.assertEqual(mesh.libraries, ["a.mtl"])
            for face, material in zip(mesh.faces, mesh.materials):
                self.assertIn(material, ("oak", "pine"))
                if any(max(mesh.v[v]) > 2 for v, _, _ in face):
                    self.assertEqual(material, "pine")
                if any(min(mesh.v[v]) < 0.7 for v, _, _ in face):
                    self.assertEqual(material, "oak")

    def repaired(self, *arguments):
        done = subprocess.run([TOOL, *arguments], cwd=self.folder, capture_output=True)
        self.assertEqual(done.returncode, 0, msg=done.stderr.decode())
        return done.stderr.decode()

    def test_repair_carries_them_where_other_points_are_searched_than_the_file_has(self):
        text = textured_text(together(box((0, 0, 0), (2, 2, 2)),
                                      box((0.7, 0.9, 1.1), (3, 3.5, 3.7))),
                             head="mtllib a.mtl", material=lambda i: "oak" if i < 12 else "pine")
        self.put("part.obj", text)
        self.repaired("--repair", "part.obj", "-o", "whole.obj")
        # A face that is left out, first in the file, with a point that is first, too.
        shifted = re.sub(r"(?m)(?<=[ f])(\d+)(?=/)", lambda m: str(int(m[1]) + 1), text)
        self.put("nan.obj", "v nan 0 0\n" + shifted.replace("usemtl", "f 1/1 2/2 3/3\nusemtl", 1))
        self.put("soup.obj", self.soup())
        self.repaired("--repair", "nan.obj", "-o", "nan-out.obj")
        self.assertEqual(self.read("nan-out.obj"), self.read("whole.obj"))
        warned = self.repaired("--repair", "--vertices", "equal", "soup.obj", "-o", "soup-out.obj")
        self.assertEqual(warned, "")
        mesh = self.parsed("soup-out.obj")
        self.assertEqual(len(mesh.v), 8)
        self.check_rows(mesh)

    def test_repair_carries_what_faces_of_an_stl_have(self):
        points, faces = box((0, 0, 0), (2, 2, 2))
        with open(self.path("part.stl"), "wb") as file:
            file.write(b" " * 80 + struct.pack("<I", len(faces)))
            for i, face in enumerate(faces):
                corners = [x for c in face for x in points[c]]
                file.write(struct.pack("<12fH", 0, 0, 0, *corners, 7 * i))
        self.repaired("--repair", "part.stl", "-o", "out.stl")
        values = [v[12] for v in struct.iter_unpack("<12fH", self.read_bytes("out.stl")[84:])]
        self.assertEqual(values, [7 * i for i in range(12)])


class Weld(CornerTest):
    tool = WELD

    def test_points_become_one_and_corners_keep_what_they_have(self):
        self.put("soup.obj", self.soup())
        self.run_tool("soup.obj", "-o", "out.obj", status=0)
        before, after = self.parsed("soup.obj"), self.parsed("out.obj")
        self.assertEqual((len(after.v), len(after.faces)), (8, 12))
        self.assertEqual([[c[1:] for c in f] for f in after.faces],
                         [[c[1:] for c in f] for f in before.faces])
        self.assertEqual((after.vt, after.vn), (before.vt, before.vn))

    def test_faces_that_collapse_take_their_corners_with_them(self):
        rows = "".join("vt %d 0\nvn 0 0 %d\n" % (i, i) for i in range(1, 7))
        self.put("fan.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 1.001 0\nv 0 1 0\nv -1 1 0\n" + rows +
                 "f 1/1/1 2/2/2 3/3/3 4/4/4 5/5/5 6/6/6\nf 3/6 2/5 1/4\n")
        self.run_tool("fan.obj", "-t", "0.01", "-o", "out.obj", status=0)
        corners = [[tuple(n if n is None else n + 1 for n in c[1:]) for c in f]
                   for f in self.parsed("out.obj").faces]
        # Corners 3 and 4 are one point, which has two values: the polygon comes apart there.
        self.assertEqual(corners, [[(1, 1), (2, 2), (3, 3)],
                                   [(1, 1), (4, 4), (5, 5), (6, 6)],
                                   [(6, None), (5, None), (4, None)]])

    def test_joined_files_have_the_rows_of_all(self):
        self.put("a/a.obj", textured_text(box((0, 0, 0), (2, 2, 2)), normals=False,
                                          head="mtllib a.mtl", material=lambda i: "oak"))
        self.mesh("b.obj", box((4, 0, 0), (5, 2, 2)))
        self.put("c.obj", textured_text(box((6, 0, 0), (8, 2, 2)), head="mtllib c.mtl",
                                        material=lambda i: "steel"))
        self.run_tool("a/a.obj", "b.obj", "c.obj", "--join", "-o", "out.obj", status=0)
        mesh = self.parsed("out.obj")
        self.assertEqual(mesh.libraries, ["a/a.mtl", "c.mtl"])
        self.assertEqual(mesh.materials, ["oak"] * 12 + [""] * 12 + ["steel"] * 12)
        for i, face in enumerate(mesh.faces):
            for v, vt, vn in face:
                self.assertEqual((vt is None, vn is None), (12 <= i < 24, i < 24))
                if vt is not None:
                    self.assertEqual(mesh.vt[vt], affine(mesh.v[v]))
                if vn is not None:
                    self.assertEqual(mesh.vn[vn], mesh.normal(face))

    def test_wedge_coordinates_of_a_ply_go_with_their_faces(self):
        self.put("in.ply", "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
                 "property float y\nproperty float z\nelement face 2\n"
                 "property list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                 "end_header\n0 0 0\n1 0 0\n1 1 0\n1 1 0\n0 1 0\n"
                 "5 0 1 2 3 4 10 0 0 1 0 2 2 3 3 0 1\n3 4 3 0 6 0 1 1 1 0 0\n")
        self.run_tool("in.ply", "--ascii", "-o", "out.ply", status=0)
        self.assertEqual(self.read("out.ply").split("\n")[-4:-1],
                         ["3 0 1 2 6 0 0 1 0 2 2", "3 0 2 3 6 0 0 3 3 0 1",
                          "3 3 2 0 6 0 1 1 1 0 0"])


    def test_joined_wedge_coordinates_lose_no_digits_and_stand_once(self):
        head = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                "property list uchar %s texcoord\nend_header\n0 0 %d\n1 0 %d\n1 1 %d\n3 0 1 2 %s\n")
        kinds = {"single": ("float", "6 0 0 1 0 1 1"), "double": ("double", "6 0.1 0 1e-300 0 1 1"),
                 "odd": ("float", "4 0 0 1 0")}
        for i, (name, (type, values)) in enumerate(kinds.items()):
            self.put(name + ".ply", head % (type, i, i, i, values))
        for first, second in (("single", "double"), ("double", "single")):
            self.run_tool(first + ".ply", second + ".ply", "--join", "--ascii", "-f", "-o",
                          "out.ply", status=0)
            text = self.read("out.ply")
            self.assertIn("property list uchar double texcoord", text)
            self.assertIn(" " + kinds["double"][1] + "\n", text)
            self.assertIn(" " + kinds["single"][1] + "\n", text)
        for first, second in (("single", "odd"), ("odd", "single")):
            codes = self.warnings(first + ".ply", second + ".ply", "--join", "--ascii", "-f", "-o",
                                  "out.ply")
            self.assertEqual(codes, ["corner-values"])
            self.assertEqual(self.read("out.ply").count("texcoord"), 1)
            self.assertIn(" " + kinds["single"][1] + "\n", self.read("out.ply"))


class Place(CornerTest):
    tool = PLACE

    def test_normals_turn_with_the_body_and_texture_coordinates_stay(self):
        text = textured_text(box((0, 0, 0), (1, 4, 5)), head="mtllib a.mtl",
                             material=lambda i: "oak")
        self.put("a.obj", text)
        self.run_tool("lay", "a.obj", "-o", "out.obj", status=0)
        before, after = Parsed(text), self.parsed("out.obj")
        self.assertEqual(max(p[2] for p in after.v), 1)  # on its largest side
        self.assertEqual((after.vt, after.faces, after.libraries, after.materials),
                         (before.vt, before.faces, before.libraries, before.materials))
        for face in after.faces:
            for _, _, vn in face:
                for is_there, should_be in zip(after.vn[vn], after.normal(face)):
                    self.assertLess(abs(is_there - should_be), 1e-12)

    def test_a_plate_has_the_rows_and_materials_of_all(self):
        self.put("a.obj", textured_text(box((0, 0, 0), (1, 7, 2)), head="mtllib a.mtl",
                                        material=lambda i: ("oak", "pine")[i // 6]))
        self.mesh("b.obj", box((0, 0, 0), (6, 1, 2)))
        self.run_tool("pack", "a.obj", "b.obj", "a.obj", "--size", "20,6", "-o", "out.obj",
                      status=0)
        mesh = self.parsed("out.obj")
        self.assertEqual(mesh.libraries, ["a.mtl"])
        both = ["oak"] * 6 + ["pine"] * 6
        self.assertEqual(mesh.materials, both + [""] * 12 + both)
        self.assertEqual(re.findall(r"(?m)^o (.*)", self.read("out.obj")), ["a", "b", "a"])
        before = self.parsed("a.obj")
        self.assertEqual(mesh.vt, before.vt * 2)
        for i, face in enumerate(mesh.faces):
            for (v, vt, vn), (_, old, _) in zip(face, before.faces[i % 12]):
                self.assertEqual(vt, None if 12 <= i < 24 else old + len(before.vt) * (i >= 24))
                if vn is not None:  # also of what was turned to find room
                    self.assertEqual(mesh.vn[vn], mesh.normal(face))

    def test_a_body_of_one_name_is_one_solid(self):
        text = textured_text(box((0, 0, 0), (1, 7, 2)))
        self.put("a.obj", re.sub(r"(?m)^(f .*\n)", r"\1o later\n", text, count=1))
        self.run_tool("pack", "a.obj", "a.obj", "--size", "20,20", "--ascii", "-o", "out.stl",
                      status=0)
        self.assertEqual(re.findall("(?m)^solid.*", self.read("out.stl")), ["solid a"] * 2)

    def test_what_is_only_shifted_has_the_same_rows(self):
        text = textured_text(box((0, 0, 5), (1, 4, 6)))
        self.put("a.obj", text.replace("vn ", "vn 0.1 0.7 0.3\nvn ", 1))
        self.run_tool("drop", "a.obj", "-o", "out.obj", status=0)
        before, after = self.parsed("a.obj"), self.parsed("out.obj")
        self.assertEqual(min(p[2] for p in after.v), 0)
        self.assertEqual((after.vt, after.vn, after.faces), (before.vt, before.vn, before.faces))


if __name__ == "__main__":
    main()
