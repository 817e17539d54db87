"""The add-on as it is used, in Blender without a window: run.sh starts it, not pytest."""

import itertools
import sys
import tempfile
import unittest

import addon_utils
import bmesh
import bpy
import numpy as np

import treeform

addon_utils.enable("treeform_blender")
import treeform_blender as addon

IDENTITY = np.eye(4)


def add(kind="cube", name="", scale=(1, 1, 1), **where):
    """A new object, the only one selected."""
    getattr(bpy.ops.mesh, f"primitive_{kind}_add")(**({"size": 1} if kind == "cube" else {}),
                                                   **where)
    bpy.context.object.name = name or bpy.context.object.name
    bpy.context.object.scale = scale
    bpy.context.view_layer.update()
    return bpy.context.object


def select(active, *others):
    bpy.ops.object.select_all(action="DESELECT")
    for one in (active, *others):
        one.select_set(True)
    bpy.context.view_layer.objects.active = active


def combined(operation, active, *others, **options):
    select(active, *others)
    assert bpy.ops.object.treeform_boolean(operation=operation, **options) == {"FINISHED"}
    return active


def mesh_of(object):
    """The triangles that are stored."""
    data = object.data
    data.calc_loop_triangles()
    vertices = np.array([one.co for one in data.vertices], np.float64).reshape(-1, 3)
    return treeform.Mesh(vertices, [one.vertices for one in data.loop_triangles])


def volume(object):
    return mesh_of(object).volume


def said():
    return bpy.context.window_manager.treeform_said


def state(object):
    """What a mesh is made of."""
    return ([tuple(one.co) for one in object.data.vertices],
            [tuple(one.vertices) for one in object.data.polygons])


def material(name):
    return bpy.data.materials.new(name)


def area_by_material(object):
    """{name: area} of the faces that have it."""
    areas = {}
    for one in object.data.polygons:
        slots = object.material_slots
        slot = slots[one.material_index].material if len(slots) else None
        name = slot.name if slot else None
        areas[name] = areas.get(name, 0) + one.area
    return areas


def paint(object, layer="UVMap", move=IDENTITY):
    """UVs that depend on the place in another space, and on the polygon: each is a chart."""
    data = object.data
    layer = data.uv_layers.get(layer) or data.uv_layers.new(name=layer)
    for polygon in data.polygons:
        for k in polygon.loop_indices:
            place = move[:3, :3] @ data.vertices[data.loops[k].vertex_index].co + move[:3, 3]
            layer.data[k].uv = uv_at(place) + 16 * (polygon.index + 1)


def uv_at(place):
    x, y, z = place
    return np.array([x + y / 2, z - x / 4])


class Case(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
        addon_utils.enable("treeform_blender")

    def assert_certified(self, object):
        """What the result promises holds for the numbers that are stored."""
        mesh = mesh_of(object)
        self.assertEqual(len(treeform.self_intersections(mesh)), 0)
        self.assertFalse(treeform.find_solid_defects(mesh), object.name)
        self.assertFalse(object.data.validate())
        return mesh

    def refused(self, sentence, run, *objects):
        """The operator fails with a sentence, and changes nothing."""
        before = [state(one) for one in objects]
        with self.assertRaisesRegex(RuntimeError, sentence):
            run()
        self.assertRegex(said(), sentence)
        self.assertEqual(str(before), str([state(one) for one in objects]))  # NaN may be there


class Booleans(Case):
    def test_volumes_are_exact(self):
        for operation, wanted in (("union", 1.875), ("difference", 0.875), ("intersection", 0.125)):
            a, b = add(), add(location=(0.5, 0.5, 0.5))
            name = b.name
            combined(operation, a, b)
            self.assertEqual(self.assert_certified(a).volume, wanted)
            self.assertNotIn(name, bpy.data.objects)
            self.assertIn(f"{a.name} has {len(a.data.polygons)} faces", said())

    def test_many_operands_and_those_that_stay(self):
        a, b, c = add(), add(location=(0.5, 0, 0)), add(location=(0, 0.5, 0))
        before = state(b)
        combined("difference", a, b, c, keep=True)
        self.assertEqual(self.assert_certified(a).volume, 0.25)
        self.assertEqual((state(b), c.name in bpy.data.objects), (before, True))

    def test_the_result_is_in_the_space_of_the_active_object(self):
        a = add(location=(8, -4, 2), scale=(2, 4, 1))
        b = add(location=(8.5, -4, 2))
        place = a.matrix_world.copy()
        combined("intersection", a, b)
        self.assertEqual(a.matrix_world, place)
        self.assertEqual(self.assert_certified(a).volume, 1 / 8)
        np.testing.assert_array_equal(mesh_of(a).bounds, [[0, -0.125, -0.5], [0.5, 0.125, 0.5]])

    def test_mirrored_objects(self):
        for scales in itertools.product((1, -1), repeat=2):
            a = add(scale=(scales[0], 1, 1))
            b = add(location=(0.5, 0.5, 0.5), scale=(1, 1, scales[1]))
            combined("difference", a, b)
            self.assertEqual(self.assert_certified(a).volume, 0.875)

    def test_turned_spheres_are_certified_in_float32(self):
        for operation in ("union", "difference", "intersection"):
            a = add("ico_sphere", subdivisions=3, rotation=(0.1, 0.2, 0.3),
                    location=(100.1, 7.3, 0))
            b = add("ico_sphere", subdivisions=3, rotation=(1, 2, 3), location=(100.7, 7.4, 0.2))
            c = add("uv_sphere", rotation=(0.3, 2, 1), location=(100.1, 7.9, 0),
                    scale=(1.1, 0.7, 0.9))
            combined(operation, a, b, c)
            self.assertGreater(self.assert_certified(a).volume, 0.1)

    def test_coordinates_of_the_active_object_stay_bit_for_bit(self):
        a, b = add("ico_sphere", rotation=(1, 2, 3),
                   location=(0.1, 0.2, 0.3)), add(location=(1, 1, 1))
        before = set(state(a)[0])
        combined("union", a, b)
        self.assertGreater(len(before & set(state(a)[0])), 0.7 * len(before))

    def test_nothing_left(self):
        a, b = add(), add(location=(5, 0, 0))
        combined("intersection", a, b)
        self.assertEqual((len(a.data.polygons), said()), (0, f"Nothing is left of {a.name}."))

    def test_modifiers_and_shape_keys_are_applied(self):
        a, b = add(), add(location=(0, 0, 2))
        a.modifiers.new("array", "ARRAY").count = 2
        b.shape_key_add(name="base")
        b.shape_key_add(name="up").data[0].co.z -= 1
        b.data.shape_keys.key_blocks["up"].value = 0
        combined("union", a, b)
        self.assertEqual((self.assert_certified(a).volume, len(a.modifiers)), (3, 0))
        a.shape_key_add(name="base")
        combined("union", a, add(location=(0, 0, 4)))
        self.assertEqual((volume(a), a.data.shape_keys), (4, None))

    def test_objects_that_share_a_mesh(self):
        a, b = add(), add(location=(0.5, 0, 0))
        b.data = other = a.data
        before = state(b)
        combined("union", a, b, keep=True)
        self.assertEqual((volume(a), state(b), b.data), (1.5, before, other))

    def test_undo(self):
        a, b = add(name="a"), add(name="b", location=(0.5, 0.5, 0.5))
        select(a, b)
        before = state(a)
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.object.treeform_boolean("EXEC_DEFAULT", True, operation="union")
        self.assertEqual(volume(bpy.data.objects["a"]), 1.875)
        self.assertNotIn("b", bpy.data.objects)
        bpy.ops.ed.undo()
        self.assertEqual(state(bpy.data.objects["a"]), before)
        self.assertIn("b", bpy.data.objects)
        for one in (addon.TREEFORM_OT_boolean, addon.TREEFORM_OT_check, addon.TREEFORM_OT_repair):
            self.assertEqual(one.bl_options, {"REGISTER", "UNDO"})

    def test_what_is_refused(self):
        a, b, sheet = add(), add(location=(0.5, 0, 0)), add("plane", name="sheet")
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        bpy.context.collection.objects.link(camera)
        union = bpy.ops.object.treeform_boolean
        select(a)
        self.refused("Select two objects or more", union, a)
        select(a, camera)
        self.refused("Not a mesh: camera", union, a)
        select(a, b, sheet)
        self.refused("Not closed, 4 open edges: sheet. Close", union, a, b)
        b.data.vertices[2].co.x = float("nan")
        select(a, b)
        self.refused(f"{b.name}: vertex 2 has a coordinate that is not finite", union, a)
        with tempfile.TemporaryDirectory() as folder:
            bpy.data.libraries.write(f"{folder}/other.blend", {a})
            with bpy.data.libraries.load(f"{folder}/other.blend", link=True) as (_, linked):
                linked.objects = [a.name]
        bpy.context.collection.objects.link(linked.objects[0])
        select(linked.objects[0], a)
        self.refused(f"{a.name} is linked from another file", union, a)
        select(a, b)
        a.scale.x = 0
        bpy.context.view_layer.update()
        self.refused(f"{a.name} has a scale of zero", union, a)
        bpy.ops.object.mode_set(mode="EDIT")
        self.assertFalse(union.poll())


class KeptThings(Case):
    def test_materials_by_area(self):
        a, b = add(), add(location=(0.5, 0.5, 0.5))
        red, blue, unused = map(material, ("red", "blue", "unused"))
        a.data.materials.append(red)
        for one in (unused, blue):
            b.data.materials.append(one)
        for one in b.data.polygons:
            one.material_index = 1
        combined("difference", a, b)
        self.assertEqual(area_by_material(a), {"red": 5.25, "blue": 0.75})
        self.assertEqual([one.name for one in a.data.materials], ["red", "blue"])

    def test_materials_that_both_have_or_none_has(self):
        red = material("red")
        a, b = add(), add(location=(0.5, 0.5, 0.5))
        b.data.materials.append(material("other"))
        b.material_slots[0].link = "OBJECT"
        b.material_slots[0].material = red
        combined("union", a, b)
        self.assertEqual(area_by_material(a), {None: 5.25, "red": 5.25})
        combined("union", a, add(location=(-0.5, -0.5, -0.5)))
        self.assertEqual(len(a.material_slots), 2)
        c, d = add(), add(location=(0.5, 0.5, 0.5))
        combined("union", c, d)
        self.assertEqual(len(c.material_slots), 0)
        e = add(location=(5, 0, 0))
        e.data.materials.append(red)
        combined("union", e, a)
        self.assertEqual(area_by_material(e)["red"], 11.25)
        self.assertEqual(len(e.material_slots), 2)

    def assert_painted(self, object, move=IDENTITY, layer="UVMap", tolerance=4e-6):
        """Each face is in one chart, and its UVs are those of its places. Returns the charts."""
        data, charts = object.data, set()
        for polygon in data.polygons:
            found = []
            for k in polygon.loop_indices:
                place = move[:3, :3] @ data.vertices[data.loops[k].vertex_index].co + move[:3, 3]
                off = np.array(data.uv_layers[layer].data[k].uv) - uv_at(place)
                self.assertLess(abs(off / 16 - np.round(off / 16)).max() * 16, tolerance)
                found.append(tuple(np.round(off / 16)))
            self.assertEqual(len(set(found)), 1)
            charts.add(found[0][0])
        return charts

    def test_uvs_are_interpolated_inside_the_face(self):
        for operation, charts in (("union", {1, 2, 3, 4, 5, 6}), ("difference", {1, 2, 3, 4, 5, 6}),
                                  ("intersection", None)):
            a, b = add(), add(location=(0.5, 0.25, 0.125))
            paint(a)
            paint(b, move=np.array(b.matrix_world))
            combined(operation, a, b)
            found = self.assert_painted(a)
            self.assertGreaterEqual(len(found), 3)
            if charts:
                self.assertEqual(found, charts)

    def test_uvs_of_turned_objects(self):
        a = add("ico_sphere", rotation=(1, 2, 3), location=(0.1, 0.2, 0.3), scale=(1, -2, 1))
        b = add("ico_sphere", rotation=(3, 1, 2), location=(0.6, 0.2, 0.3))
        for one in (a, b):
            paint(one, move=np.array(one.matrix_world))
        combined("union", a, b)
        self.assert_certified(a)
        self.assert_painted(a, np.array(a.matrix_world), tolerance=5e-4)

    def test_polygons_that_are_not_cut(self):
        for operation, quads in (("union", 6), ("difference", 6), ("intersection", 0)):
            for scale in (1, -1):
                a, b = add(), add(location=(0.5, 0.5, 0.5), scale=(1, scale, 1))
                for one in (a, b):
                    paint(one, move=np.array(one.matrix_world))
                combined(operation, a, b)
                self.assert_certified(a)
                self.assert_painted(a)
                self.assertEqual(sum(len(one.vertices) == 4 for one in a.data.polygons),
                                 3 if operation == "difference" else quads)
        # A hole inside: its quads are turned over.
        a, b = add(scale=(4, 4, 4)), add("uv_sphere", rotation=(1, 2, 3))
        paint(b, move=np.linalg.inv(a.matrix_world) @ np.array(b.matrix_world))
        a.data.uv_layers.remove(a.data.uv_layers[0])
        combined("difference", a, b)
        self.assertLess(self.assert_certified(a).volume, 1)
        self.assertGreater(sum(len(one.vertices) == 4 for one in a.data.polygons), 400)

    def test_the_triangles_that_are_stored_are_those_that_were_checked(self):
        """Also where Blender cuts polygons otherwise: a side turned over, quads that are not
        flat."""
        rng = np.random.default_rng(1)
        a, b = add(scale=(4, 4, 4)), add("cylinder", vertices=64, depth=1, rotation=(1, 2, 3))
        c, d = add(location=(0.2, 0.1, 1)), add("uv_sphere", segments=24, ring_count=12)
        for one in d.data.vertices:
            one.co += type(one.co)(rng.normal(0, 0.01, 3))
        d.rotation_euler = (1, 2, 3)
        bpy.context.view_layer.update()
        for operation, active, other, quads in (("difference", a, b, 70), ("union", c, d, 150)):
            made = addon.combine(bpy.context, operation, active, [other])
            stored = self.assert_certified(active)
            self.assertEqual((bool(made.certificate), made.certificate.precision),
                             (True, "float32"))
            np.testing.assert_array_equal(stored.vertices, made.vertices)
            self.assertEqual(*({min((x, y, z), (y, z, x), (z, x, y)) for x, y,
                                z in one.faces.tolist()}
                               for one in (stored, made)))
            self.assertGreaterEqual(sum(len(one.vertices) == 4 for one in active.data.polygons),
                                    quads)

    def test_layers_are_matched_by_name(self):
        a, b = add(), add(location=(0.5, 0.5, 0.5))
        for layer in ("UVMap", "second"):
            paint(a, layer)
        paint(b, "third")
        a.data.uv_layers.active = a.data.uv_layers["second"]
        combined("union", a, b)
        self.assertEqual([one.name for one in a.data.uv_layers], ["UVMap", "second", "third"])
        self.assertEqual(a.data.uv_layers.active.name, "second")
        values = np.array([one.uv for one in a.data.uv_layers["third"].data])
        self.assertTrue((values == 0).all(axis=1).any() and (values != 0).all(axis=1).any())

    def test_smooth_faces(self):
        a, b = add(), add(location=(0.5, 0.5, 0.5))
        for one in b.data.polygons:
            one.use_smooth = True
        combined("difference", a, b)
        self.assertEqual(sum(one.area for one in a.data.polygons if one.use_smooth), 0.75)


class Checks(Case):
    def two_in_one(self, *offset):
        """Two cubes in one mesh."""
        a, b = add(), add(location=offset)
        select(a, b)
        bpy.ops.object.join()
        return a

    def test_the_faces_that_meet_are_selected(self):
        a = self.two_in_one(0.5, 0.5, 0.5)
        self.assertEqual(bpy.ops.object.treeform_check(), {"FINISHED"})
        self.assertEqual(said(), f"{a.name}: 6 pairs of faces meet (6 crossing).")
        pairs, _ = addon.find_pairs(a.data)
        chosen = [one.index for one in a.data.polygons if one.select]
        self.assertEqual(chosen, sorted(set(pairs.ravel().tolist())))
        # Those of the first cube that look up, of the second that look down.
        for one in a.data.polygons:
            up = sum(one.normal) > 0
            self.assertEqual(one.select, up == (one.index < 6))
        loops = {a.data.loops[k].vertex_index for p in chosen
                 for k in a.data.polygons[p].loop_indices}
        self.assertEqual({one.index for one in a.data.vertices if one.select}, loops)

    def test_in_edit_mode(self):
        a = self.two_in_one(0.5, 0.5, 0.5)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.object.treeform_check()
        self.assertEqual(bpy.context.mode, "EDIT_MESH")
        self.assertEqual(sum(one.select for one in bmesh.from_edit_mesh(a.data).faces), 6)

    def test_several_objects_and_kinds(self):
        a, b, c = self.two_in_one(0.5, 0, 0), self.two_in_one(1, 0, 0), add()
        select(a, b, c)
        bpy.ops.object.treeform_check()
        self.assertIn(f"{a.name}: ", said())
        self.assertIn("overlap", said())
        self.assertIn(f"{b.name}: 1 pair of faces meets (1 fold)", said())
        self.assertNotIn(f"{c.name}: ", said())
        self.assertFalse(any(one.select for one in c.data.polygons))

    def test_as_many_pairs_as_the_package_finds(self):
        a = add("ico_sphere", subdivisions=3)
        b = add("ico_sphere", subdivisions=3, rotation=(1, 2, 3), location=(0.5, 0.1, 0.2))
        select(a, b)
        bpy.ops.object.join()
        found = treeform.self_intersections(mesh_of(bpy.context.object))
        pairs, kinds = addon.find_pairs(bpy.context.object.data)
        np.testing.assert_array_equal(pairs, found.pairs)
        np.testing.assert_array_equal(kinds, found.kinds)

    def test_nothing_meets(self):
        add("torus")
        bpy.ops.object.treeform_check()
        self.assertEqual(said(), "No faces meet.")

    def test_what_is_refused(self):
        a = add()
        a.data.vertices[3].co.y = float("nan")
        self.refused(f"{a.name}: vertex 3 has a coordinate that is not finite",
                     bpy.ops.object.treeform_check,
                     a)


class Repairs(Case):
    def test_a_hole_and_faces_that_cross(self):
        a, b = add(), add(location=(0.5, 0.5, 0.5))
        for one in (a, b):
            paint(one, move=np.array(one.matrix_world))
            one.data.materials.append(bpy.data.materials.get("red") or material("red"))
        select(a, b)
        bpy.ops.object.join()
        editing = bmesh.new()
        editing.from_mesh(a.data)
        editing.faces.ensure_lookup_table()
        bmesh.ops.delete(editing, geom=[max(editing.faces, key=lambda f: f.calc_center_median().z)],
                         context="FACES_ONLY")
        editing.to_mesh(a.data)
        bpy.ops.object.treeform_repair()
        self.assertEqual(said(), f"Repaired: {a.name}.")
        self.assertEqual(self.assert_certified(a).volume, 1.875)
        self.assertEqual(area_by_material(a), {"red": 10.5})
        self.assertEqual([one.name for one in a.data.uv_layers], ["UVMap"])

    def test_a_solid_stays_as_it_is(self):
        a = add()
        before = state(a)
        bpy.ops.object.treeform_repair()
        self.assertEqual((said(), state(a)), ("Nothing to repair.", before))

    def test_what_cannot_be_repaired(self):
        plane = add("plane")
        self.refused(f"{plane.name}: 4 edges stay open", bpy.ops.object.treeform_repair, plane)
        bpy.ops.object.treeform_repair(sheet=True)
        self.assertEqual(said(), "Nothing to repair.")
        broken = add()
        bmesh_of = bmesh.new()
        bmesh_of.from_mesh(broken.data)
        bmesh_of.faces.ensure_lookup_table()
        bmesh.ops.delete(bmesh_of, geom=[bmesh_of.faces[0]], context="FACES_ONLY")
        bmesh_of.to_mesh(broken.data)
        select(plane, broken)
        bpy.ops.object.treeform_repair()
        self.assertEqual(said(), f"Repaired: {broken.name}; {plane.name}: 4 edges stay open.")
        self.assertEqual(self.assert_certified(broken).volume, 1)


class Surroundings(Case):
    def test_progress_rises_to_the_end(self):
        a, b, shares = add(), add(location=(0.5, 0, 0)), []
        addon.combine(bpy.context, "union", a, [b], shares.append)
        self.assertEqual((shares, shares[-1]), (sorted(shares), 1))

    def test_buttons(self):
        class Layout:
            def __init__(self):
                self.names = []

            def operator(self, name, **_):
                self.names.append(name)
                return self

            def separator(self):
                pass

        layout = Layout()
        addon.draw_operators(layout)
        self.assertEqual(len(layout.names), 5)
        self.assertTrue(hasattr(bpy.types, "TREEFORM_PT_panel"))
        self.assertTrue(hasattr(bpy.types, "TREEFORM_MT_menu"))

    def test_leaves_nothing_when_disabled(self):
        addon_utils.disable("treeform_blender")
        self.assertFalse(hasattr(bpy.types, "TREEFORM_PT_panel"))
        self.assertFalse(hasattr(bpy.context.window_manager, "treeform_said"))
        addon_utils.enable("treeform_blender")

    def test_without_the_package(self):
        add()
        self.assertTrue(bpy.ops.object.treeform_repair.poll())
        kept, addon.treeform = addon.treeform, None
        try:
            self.assertFalse(bpy.ops.object.treeform_repair.poll())
        finally:
            addon.treeform = kept


if __name__ == "__main__":
    result = unittest.TextTestRunner(sys.stdout, verbosity=1).run(
        unittest.defaultTestLoader.loadTestsFromModule(sys.modules["__main__"]))
    bad, left_out = len(result.failures) + len(result.errors), len(result.skipped)
    print(f"{result.testsRun - bad - left_out} passed, {bad} failed, {left_out} skipped in Blender")
    sys.stdout.flush()
    sys.exit(bad > 0)
