"""The faces that meet, in the PLY and GLB files that tf-place writes."""

from place_support import *

PENETRATING, TOUCHING, CLOSER = 1, 2, 3
COLORS = {0: (180, 186, 194), PENETRATING: (224, 32, 32), TOUCHING: (236, 208, 0),
          CLOSER: (0, 160, 192)}


class Colors(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("floor.obj", box((0, 0, 0), (4, 4, 1)))
        self.mesh("a.obj", box((1, 1, 5.5), (2, 2, 6.5)))
        self.mesh("in.obj", box((1, 1, 0.75), (2, 2, 1.75)))

    def classes(self, *arguments, scene=True):
        """Of the 12 faces of MOVING and the 12 of the floor, after their colors were checked."""
        more = ["--scene"] if scene else []
        self.run_tool(*arguments, "--fixed", "floor.obj", "-o", "out.ply", "--ascii", "-f", *more,
                      status=0)
        rows = [line.split() for line in self.read("out.ply").splitlines()
                if line.startswith("3 ")]
        for row in rows:
            self.assertEqual(tuple(map(int, row[4:7])), COLORS[int(row[-1])])
        classes = [int(row[-1]) for row in rows]
        self.assertEqual(len(classes), 24 if scene else 12)
        return classes[:12], classes[12:]

    def test_faces_in_contact_are_yellow_where_it_came_to_rest(self):
        for mode in (["drop", "a.obj"], ["slide", "a.obj", "-d", "0,0,-1"], ["mate", "a.obj"],
                     ["separate", "in.obj"]):
            moving, floor = self.classes(*mode)
            bottom = moving[:2]
            self.assertEqual(bottom, [TOUCHING, TOUCHING], msg=mode)
            self.assertIn(TOUCHING, floor[2:4])
            self.assertEqual(floor[:2], [0, 0])
            self.assertEqual(moving[2:4], [0, 0])  # the top
            self.assertNotIn(PENETRATING, moving + floor)

    def test_contacts_count_where_rounding_left_a_gap(self):
        self.mesh("a.obj", box((1.1, 1.1, 3.3), (1.7, 1.7, 4.9)))
        moving, floor = self.classes("slide", "a.obj", "-d", "0.1,0.03,-1")
        self.assertIn(TOUCHING, moving)
        self.assertIn(TOUCHING, floor)

    def test_faces_at_the_clearance_are_cyan(self):
        for mode in (["drop", "a.obj"], ["slide", "a.obj", "-d", "0,0,-1"], ["mate", "a.obj"]):
            moving, floor = self.classes(*mode, "--clearance", "0.25")
            self.assertIn(CLOSER, moving[:2], msg=mode)
            self.assertIn(CLOSER, floor[2:4])
            self.assertEqual(set(moving + floor), {0, CLOSER})

    def test_what_penetrates_is_red_and_without_the_scene_too(self):
        moving, _ = self.classes("measure", "in.obj", scene=False)
        self.assertEqual(moving[:4], [0, 0, 0, 0])
        self.assertIn(PENETRATING, moving)

    def test_the_bed_counts_beside_fixed_meshes(self):
        self.mesh("floor.obj", box((7, 7, 0), (9, 9, 1)))
        moving, floor = self.classes("drop", "a.obj", "--bed", "-1")
        self.assertEqual(moving[:2], [TOUCHING, TOUCHING])
        self.assertEqual(set(floor), {0})

    def test_colors_of_its_own_stay_when_a_mesh_is_moved(self):
        points, faces = box((1, 1, 5.5), (2, 2, 6.5))
        lines = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
        lines += [f"property double {name}" for name in "xyz"]
        lines += [f"element face {len(faces)}", "property list uchar int vertex_indices"]
        lines += [f"property uchar {name}" for name in ("red", "green", "blue")] + ["end_header"]
        lines += [" ".join(map(str, p)) for p in points]
        lines += ["3 " + " ".join(map(str, f)) + " 1 2 3" for f in faces]
        with open(self.path("own.ply"), "w") as file:
            file.write("\n".join(lines) + "\n")
        self.run_tool("drop", "own.ply", "--fixed", "floor.obj", "-o", "out.ply", "--ascii",
                      status=0)
        rows = [line.split() for line in self.read("out.ply").splitlines()
                if line.startswith("3 ")]
        self.assertEqual({tuple(row[4:7]) for row in rows}, {("1", "2", "3")})
        self.assertEqual([int(row[-1]) for row in rows[:4]], [TOUCHING, TOUCHING, 0, 0])

    def test_polygons_stay_polygons(self):
        text = "v 1 1 5\nv 2 1 5\nv 2 2 5\nv 1 2 5\nv 1 1 6\nv 2 1 6\nv 2 2 6\nv 1 2 6\n"
        text += "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
        with open(self.path("quads.obj"), "w") as file:
            file.write(text)
        self.run_tool("drop", "quads.obj", "--fixed", "floor.obj", "-o", "out.ply", "--ascii",
                      status=0)
        rows = [line.split() for line in self.read("out.ply").splitlines()
                if line.startswith("4 ")]
        self.assertEqual([int(row[-1]) for row in rows], [TOUCHING, 0] + 4 * [TOUCHING])

    def test_on_the_bed_alone_nothing_is_colored(self):
        self.run_tool("drop", "a.obj", "-o", "out.ply", "--ascii", status=0)
        self.assertNotIn("red", self.read("out.ply"))

    def test_a_glb_has_the_colors(self):
        self.run_tool("drop", "a.obj", "--fixed", "floor.obj", "--scene", "-o", "out.glb",
                      status=0)
        data = self.read_bytes("out.glb")
        length, = struct.unpack_from("<I", data, 12)
        materials = json.loads(data[20:20 + length])["materials"]
        self.assertEqual(len(materials), 2)


if __name__ == "__main__":
    main()
