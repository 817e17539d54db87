"""Files of several objects, solids that are inside out, materials: what all tools make of them."""

import zipfile

from boolean_support import *

MODEL = ('<model unit="millimeter" '
         'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">')
RELATIONSHIPS = ('<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/'
                 'relationships">'
                 '<Relationship Target="/3D/3dmodel.model" Id="r" Type="http://'
                 'schemas.microsoft.com/'
                 '3dmanufacturing/2013/01/3dmodel"/></Relationships>')


def turned_over(mesh):
    points, faces = mesh
    return points, [(a, c, b) for a, b, c in faces]


class Objects(BooleanTest):
    def package(self, name, objects, transforms=None, zip64=False, streamed=False,
                unit="millimeter"):
        """A 3MF of named boxes, each (name, low, high); streamed archives cannot go back."""
        text, items = MODEL.replace("millimeter", unit) + "<resources>", ""
        for number, (label, low, high) in enumerate(objects, 1):
            points, faces = box(low, high)
            text += (f'<object id="{number}" name="{label}"><mesh><vertices>' +
                     "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in points) +
                     "</vertices><triangles>" +
                     "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces) +
                     "</triangles></mesh></object>")
            move = (transforms or {}).get(label)
            items += f'<item objectid="{number}"' + (f' transform="{move}"/>' if move else "/>")
        text += f"</resources><build>{items}</build></model>"
        with open(self.path(name), "wb") as file:
            class Unseekable:
                def write(self, data):
                    return file.write(data)

                def flush(self):
                    file.flush()
            with zipfile.ZipFile(Unseekable() if streamed else file, "w",
                                 zipfile.ZIP_DEFLATED) as archive:
                for member, content in (("3D/3dmodel.model", text), ("_rels/.rels", RELATIONSHIPS)):
                    with archive.open(member, "w", force_zip64=zip64) as to:
                        to.write(content.encode())
        return name

    def crossing(self, **how):
        return self.package("two.3mf", (("first", (0, 0, 0), (10, 10, 40)),
                                        ("second", (0, 0, 30), (10, 10, 42))), **how)

    def volume_of(self, *words, name="two.3mf"):
        entry = self.entry(*words, name, "-o", "x.ply", "-f", status=0)
        return round(entry["output"]["volume"], 9)

    # ---- one file of several objects ----

    def test_the_objects_of_one_file_are_the_operands(self):
        self.crossing()
        for words, expected in ((["difference"], 3000), (["intersection"], 1000),
                                (["symmetric-difference"], 3200), (["union"], 4200),
                                (["--expr", "a-b"], 3000), (["--expr", "b-a"], 200),
                                (["--expr", "second-first"], 200),
                                (["--expr", "a"], 4000)):
            self.assertEqual(self.volume_of(*words), expected, msg=words)
        run = self.run_tool("difference", "two.3mf", "-n", "-v", status=0)
        self.assertIn("two.3mf: difference of its 2 objects: ", run.text)
        self.assertIn("operands in order: first, second", run.err)
        entry = self.entry("difference", "two.3mf", "-n", status=0)
        self.assertEqual([i["part"] for i in entry["inputs"]], ["first", "second"])
        self.assertEqual([i["closed"] for i in entry["inputs"]], [True, True])

    def test_objects_that_touch_are_operands(self):
        self.package("touching.3mf", (("a", (0, 0, 0), (1, 1, 1)), ("b", (1, 0, 0), (2, 1, 1)),
                                      ("c", (0, 0, 0), (0.5, 1, 1))))
        self.assertEqual(self.volume_of("difference", name="touching.3mf"), 0.5)
        self.assertEqual(self.volume_of("--expr", "b+c", name="touching.3mf"), 1.5)
        self.assertIn("no part is named d; the parts are a, b, c",
                      self.run_tool("--expr", "a-d", "touching.3mf", "-n", status=2).err)

    def test_letters_are_names_where_all_are_names(self):
        self.package("ba.3mf", (("b", (0, 0, 0), (1, 1, 1)), ("a", (0, 0, 0), (2, 1, 1))))
        self.assertEqual(self.volume_of("--expr", "a-b", name="ba.3mf"), 1)

    def test_several_files_and_files_of_one_object_stay_as_they_are(self):
        self.crossing()
        self.package("third.3mf", (("third", (0, 0, 0), (10, 10, 10)),))
        run = self.run_tool("difference", "two.3mf", "third.3mf", "-n", status=0)
        self.assertIn("volume 3200", run.text)
        self.assertNotIn("objects", run.text)
        self.assertEqual(self.run_tool("union", "third.3mf", "-n", status=0).err, "")
        run = self.run_tool("difference", "third.3mf", "-n", status=0)
        self.assertIn("third.3mf: there is only one operand", run.err)
        # Shells of one STL are one solid, and so are groups of an OBJ that are pieces of a surface.
        points, faces = box((0, 0, 0), (1, 1, 1))
        far, _ = box((0.5, 0, 0), (1.5, 1, 1))
        self.mesh("shells.stl", (points + far, faces + [tuple(i + 8 for i in f) for f in faces]))
        self.assertEqual(self.volume_of("difference", name="shells.stl"), 1.5)
        lines = ["f " + " ".join(str(i + 1) for i in f) for f in faces]
        self.put("groups.obj", "\n".join([*(f"v {x} {y} {z}" for x, y, z in points), "g lid",
                                          *lines[:2], "g rest", *lines[2:], ""]))
        run = self.run_tool("difference", "groups.obj", "-n", status=0)
        self.assertIn("there is only one operand, since its parts are pieces of one surface",
                      run.err)
        self.assertIn("volume 1", run.text)

    def test_an_open_object_is_named(self):
        points, faces = box((0, 0, 0), (1, 1, 1))
        self.put("open.obj", "\n".join(
            ["o whole", *(f"v {x} {y} {z}" for x, y, z in points),
             *("f " + " ".join(str(i + 1) for i in f) for f in faces), "o hole",
             *(f"v {x + 5} {y} {z}" for x, y, z in points),
             *("f " + " ".join(str(i + 9) for i in f) for f in faces[1:]), ""]))
        run = self.run_tool("difference", "open.obj", "-n", status=1)
        self.assertIn("open.obj: hole: not a solid", run.err)
        self.assertEqual(self.run_tool("difference", "open.obj", "--repair", "-n",
                                       status=0).status, 0)

    def test_a_union_leaves_nothing_of_an_object_out_that_is_inside_out(self):
        points, faces = box((0, 0, 0), (1, 1, 1))
        _, inward = turned_over((points, faces))
        self.put("mixed.obj", "\n".join(
            ["o one", *(f"v {x} {y} {z}" for x, y, z in points),
             *("f " + " ".join(str(i + 1) for i in f) for f in faces), "o two",
             *(f"v {x + 0.5} {y} {z}" for x, y, z in points),
             *("f " + " ".join(str(i + 9) for i in f) for f in inward), ""]))
        self.assertEqual(self.volume_of("union", name="mixed.obj"), 1.5)

    # ---- archives ----

    def test_files_of_different_units_are_said_to_be(self):
        self.package("a.3mf", [("a", (0, 0, 0), (1, 1, 1))])
        self.package("b.3mf", [("b", (2, 0, 0), (3, 1, 1))], unit="inch")
        run = self.run_tool("union", "a.3mf", "b.3mf", "-o", "x.ply", status=0)
        self.assertIn("b.3mf has the unit inch, an earlier input the unit millimeter; numbers are "
                      "not converted", run.err)
        run = self.run_tool("union", "a.3mf", "a.3mf", "-o", "y.ply", status=0)
        self.assertNotIn("unit", run.err)

    def test_reports_have_the_unit_that_files_declare(self):
        for name, unit in (("a.3mf", "millimeter"), ("b.3mf", "inch"), ("c.3mf", "micron")):
            self.package(name, [("a", (0, 0, 1), (1, 1, 2))], unit=unit)
        write(self.path("d.obj"), box((0, 0, 0), (1, 1, 1)))
        for inputs, unit in ((["a.3mf"], "mm"), (["b.3mf"], "in"), (["c.3mf"], "um"),
                             (["a.3mf", "d.obj"], "mm"), (["d.obj"], "unknown"),
                             (["a.3mf", "b.3mf"], "unknown"), (["a.3mf", "--units", "cm"], "cm")):
            for tool, *words in ((CUT, "info"), (PLACE, "drop", "-n"), (PLACE, "clash"),
                                 (MEND, "--check")):
                self.tool = tool
                with self.subTest(tool=tool, words=words, inputs=inputs):
                    self.assertEqual(self.report(*words, *inputs)["unit"], unit)
        self.tool = PLACE
        self.run_tool("drop", "a.3mf", "-n", "--html", "p.html", status=0)
        self.assertIn('"unit_name":"mm"', self.read("p.html"))

    def test_archives_with_zip64_and_streamed_ones_are_read(self):
        for how in ({"zip64": True}, {"streamed": True}, {"zip64": True, "streamed": True}):
            self.crossing(**how)
            self.assertEqual(self.volume_of("difference"), 3000, msg=how)

    # ---- inside out, mirrored ----

    def clash(self, *words, status):
        done = subprocess.run([PLACE, "clash", *words], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, status, msg=done.stdout + done.stderr)
        return done

    def test_a_clash_with_a_part_that_is_inside_out(self):
        self.mesh("one.stl", box((0, 0, 0), (1, 1, 1)))
        self.mesh("two.stl", turned_over(box((0.5, 0, 0), (1.5, 1, 1))))
        self.mesh("away.stl", turned_over(box((9, 0, 0), (10, 1, 1))))
        done = self.clash("one.stl", "two.stl", "away.stl", status=1)
        self.assertIn("one and two: penetrating, at most 0.5 deep, common volume 0.5",
                      done.stdout)
        self.assertIn("warning: 3 inputs: two: is inside out", done.stderr)
        self.assertNotIn("away", done.stderr)
        self.assertNotIn("one:", done.stderr)
        run = subprocess.run([PLACE, "measure", "one.stl", "--fixed", "two.stl"], cwd=self.folder,
                             capture_output=True, text=True)
        self.assertIn("penetrating", run.stdout)
        self.assertIn("two.stl: is inside out", run.stderr)
        self.put("poses.jsonl", "{}\n")
        run = subprocess.run([PLACE, "check", "one.stl", "two.stl", "--poses", "poses.jsonl"],
                             cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("two: is inside out", run.stderr)

    def test_a_transform_that_mirrors_turns_faces_over(self):
        mirror = "-1 0 0 0 1 0 0 0 1 1.5 0 0"  # from 0.5 to 1.5
        self.package("mirrored.3mf", (("one", (0, 0, 0), (1, 1, 1)), ("two", (0, 0, 0), (1, 1, 1))),
                     {"two": mirror})
        done = self.clash("mirrored.3mf", status=1)
        self.assertIn("common volume 0.5", done.stdout)
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.volume_of("union", name="mirrored.3mf"), 1.5)
        self.put("mirror.txt", "-1 0 0 2\n0 1 0 0\n0 0 1 0\n0 0 0 1\n")
        self.entry("--expr", "a", "a.obj", "b.obj", "--matrix", "1:mirror.txt", "--fill-rule",
                   "positive", "-o", "x.obj", "-f", status=0)
        self.assertEqual(volume(*obj_mesh(self.read("x.obj"))), 8)
        done = subprocess.run([PLACE, "drop", "a.obj", "--start", "mirror.txt", "-o",
                               "dropped.obj"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, msg=done.stderr)
        self.assertEqual(volume(*obj_mesh(self.read("dropped.obj"))), 8)

    # ---- materials ----

    def test_colors_of_materials_get_to_3mf_and_ply(self):
        points, faces = cube()
        self.put("my colors.mtl", "newmtl red one\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nTr 0.5\n")
        lines = ["f " + " ".join(str(i + 1) for i in f) for f in faces]
        self.put("m.obj", "\n".join(["mtllib my colors.mtl",
                                     *(f"v {x} {y} {z}" for x, y, z in points),
                                     "usemtl red one", *lines[:6], "usemtl blue", *lines[6:], ""]))
        weld = lambda *words: subprocess.run([WELD, *words], cwd=self.folder, capture_output=True,
                                             text=True, check=True)
        self.assertIn("Tr", weld("m.obj", "-o", "m.3mf").stderr)
        with zipfile.ZipFile(self.path("m.3mf")) as archive:
            model = archive.read("3D/3dmodel.model").decode()
        self.assertIn('<base name="red one" displaycolor="#FF0000"/>', model)
        self.assertIn('<base name="blue" displaycolor="#0000FF"/>', model)
        for name in ("m.obj", "m.3mf"):
            weld("-q", name, "--ascii", "-o", "m.ply", "-f")
            rows = [line.split()[4:] for line in self.read("m.ply").splitlines()
                    if line[:2] == "3 "]
            self.assertEqual(rows, 6 * [["255", "0", "0"]] + 6 * [["0", "0", "255"]], msg=name)


if __name__ == "__main__":
    main()
