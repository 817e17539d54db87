"""3MF packages: read by all tools, and written."""

import json
import os
import unittest
import zipfile

from support import BOOLEAN, CLEAN, MODELS, PLACE, TWO_CUBES, WELD, ToolTest, cube, main, obj_bytes

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
START = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"


def mesh_text(mesh):
    points, faces = mesh
    vertices = "".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in points)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces)
    return f"<mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh>"


def write_package(path, meshes, unit="millimeter", model=None):
    objects = "".join(f'<object id="{i}" name="body {i}">{mesh_text(m)}</object>'
                      for i, m in enumerate(meshes, 1))
    items = "".join(f'<item objectid="{i}"/>' for i in range(1, len(meshes) + 1))
    text = model or (f'<model unit="{unit}" xmlns="{CORE}"><resources>{objects}</resources>'
                     f"<build>{items}</build></model>")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        package.writestr("_rels/.rels", f'<Relationships><Relationship Id="a" Type="{START}" '
                                        'Target="/3D/3dmodel.model"/></Relationships>')
        package.writestr("3D/3dmodel.model", text)


class Packages(ToolTest):
    def put_package(self, name, *meshes, **how):
        write_package(self.path(name), meshes, **how)
        return name

    def model(self, name):
        with zipfile.ZipFile(self.path(name)) as package:
            self.assertIsNone(package.testzip())
            return package.read("3D/3dmodel.model").decode()

    def test_self_intersections_are_found_whatever_the_name(self):
        self.put_package("a.3mf", TWO_CUBES)
        self.assertEqual(self.counts("a.3mf")["crossing"], self.counts_of_obj()["crossing"])
        os.rename(self.path("a.3mf"), self.path("a.bin"))
        report = self.report("a.bin", status=1)["files"][0]
        self.assertEqual(report["format"], "3mf")

    def counts_of_obj(self):
        with open(self.path("a.obj"), "wb") as file:
            file.write(obj_bytes(TWO_CUBES))
        return self.counts("a.obj")

    def test_what_was_repaired_is_written_and_is_clean(self):
        self.put_package("a.3mf", TWO_CUBES, unit="inch")
        self.run_tool("--repair", "a.3mf", "-o", "b.3mf", status=0)
        self.run_tool("b.3mf", status=0)
        for mode in ("split", "remove"):
            self.run_tool(f"--repair={mode}", "a.3mf", "-o", f"{mode}.3mf", "--accept-loss",
                          status=0)

    def test_marks_are_colors_of_faces(self):
        self.put_package("a.3mf", TWO_CUBES)
        self.run_tool("a.3mf", "-o", "marked.3mf", status=1)
        self.assertIn("<m:color ", self.model("marked.3mf"))
        self.run_tool("marked.3mf", status=1)

    def test_welding_keeps_objects_names_and_the_unit(self):
        self.tool = WELD
        self.put_package("a.3mf", CLEAN, cube((5.0, 0.0, 0.0)), unit="inch")
        self.run_tool("a.3mf", "-o", "b.3mf", status=0)
        text = self.model("b.3mf")
        self.assertIn('unit="inch"', text)
        self.assertEqual(text.count("<object "), 2)
        for name in ("body 1", "body 2"):
            self.assertIn(f'name="{name}"', text)
        self.run_tool("b.3mf", "-o", "c.3mf", status=0)
        self.assertEqual(self.read_bytes("b.3mf"), self.read_bytes("c.3mf"))
        self.run_tool("b.3mf", "--in-place", status=0)
        self.assertEqual(self.read_bytes("b.3mf"), self.read_bytes("c.3mf"))

    def test_doubles_are_written_when_asked_for(self):
        self.tool = WELD
        points, faces = CLEAN
        self.put_package("a.3mf", ([(x + 0.1, y, z) for x, y, z in points], faces))
        self.run_tool("a.3mf", "-o", "float.3mf", status=0)
        self.run_tool("a.3mf", "-o", "double.3mf", "--precision", "double", status=0)
        self.assertNotIn('x="0.1"', self.model("float.3mf"))
        self.assertIn('x="0.1"', self.model("double.3mf"))

    def test_solids_and_plates(self):
        self.put_package("a.3mf", CLEAN)
        self.put_package("b.3mf", cube((0.5, 0.5, 0.5)))
        self.tool = BOOLEAN
        self.run_tool("difference", "a.3mf", "b.3mf", "-o", "c.3mf", status=0)
        self.tool = PLACE
        self.run_tool("pack", "a.3mf", "b.3mf", "c.3mf", "--size", "20,20", "-o", "plate.3mf",
                      status=0)
        self.assertEqual(self.model("plate.3mf").count("<item "), 3)

    def test_a_damaged_package_is_refused_with_part_and_byte(self):
        self.put_package("a.3mf", CLEAN)
        with zipfile.ZipFile(self.path("a.3mf")) as package:
            text = package.read("3D/3dmodel.model").decode()
        self.put_package("b.3mf", model=text.replace('v1="0"', 'v1="9"', 1))
        run = self.run_tool("b.3mf", status=3)
        self.assertRegex(run.err, r"b.3mf: 3D/3dmodel.model: byte \d+: <triangle> v1=9 is out of")
        self.put_package("c.3mf", model="<!DOCTYPE a>" + text)
        self.assertIn("document type", self.run_tool("c.3mf", status=3).err)

    @unittest.skipUnless(MODELS, "TREEFORM_MODELS_DIR names no folder of models")
    def test_a_real_scene_stays_one(self):
        self.tool = WELD
        gears = os.path.join(MODELS, "scene", "cube_gears.3mf")
        run = self.run_tool(gears, "-o", "a.3mf", "-r", "r.json", status=0)
        self.assertEqual(self.model("a.3mf").count("<object "), 17)
        self.assertEqual(json.loads(self.read("r.json"))["files"][0]["format"], "3mf", run.err)


if __name__ == "__main__":
    main()
