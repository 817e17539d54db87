"""Files of several bodies: each is looked at where it matters, and no other."""

from place_support import *

import json


def scene_obj(parts):
    """An OBJ of named boxes; a name of two words is an object and a group."""
    lines, first = [], 1
    for name, (points, faces) in parts:
        for letter, word in zip("og", name.split()):
            lines.append(f"{letter} {word}")
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in points]
        lines += ["f " + " ".join(str(c + first) for c in face) for face in faces]
        first += len(points)
    return ("\n".join(lines) + "\n").encode()


class Scenes(PlaceTest):
    def setUp(self):
        super().setUp()
        self.mesh("a.obj", box((1, 1, 5.5), (2, 2, 6.5)))

    def scene(self, name, parts):
        with open(self.path(name), "wb") as file:
            file.write(scene_obj(parts))
        return name

    def parts_of(self, entry):
        return {p["name"]: p["indexed"] for p in entry["fixed"][0]["parts"]}

    def test_only_parts_on_the_way_are_indexed(self):
        far = [(f"far{i}", box((10 + 2 * i, 0, 0), (11 + 2 * i, 1, 1))) for i in range(50)]
        self.scene("scene.obj", far[:20] + [("floor", box((0, 0, 0), (4, 4, 1)))] + far[20:])
        entry = self.entry("drop", "a.obj", "--fixed", "scene.obj", "-o", "out.obj", status=0)
        self.assertEqual((entry["travel"], entry["status"]), (4.5, "touching"))
        indexed = self.parts_of(entry)
        self.assertEqual(len(indexed), 51)
        self.assertEqual([name for name in indexed if indexed[name]], ["floor"])
        skipped = entry["skipped"]
        self.assertEqual((skipped["parts_not_indexed"], skipped["pairs_culled_by_box"],
                          skipped["primitives_not_indexed"]), (50, 50, 600))
        work = entry["work"]
        self.assertGreater(work["predicates"], 0)
        self.assertLessEqual(work["exact_predicates"], work["predicates"])
        for contact in entry["contacts"]:
            self.assertEqual((contact["part"], contact["name"]), (0, "floor"))
            self.assertIn(contact["fixed"], (12 * 20 + 2, 12 * 20 + 3))  # numbers in the file

    def test_clear_looks_at_what_is_near_and_at_more_only_where_it_must(self):
        self.mesh("in.obj", box((1, 1, 0.75), (2, 2, 1.75)))
        far = [(f"far{i}", box((10 + 2 * i, 0, 0), (11 + 2 * i, 1, 1))) for i in range(50)]
        floor = ("floor", box((0, 0, 0), (4, 4, 1)))
        self.scene("scene.obj", far[:20] + [floor] + far[20:])
        entry = self.entry("separate", "in.obj", "--fixed", "scene.obj", "-o", "out.obj", status=0)
        self.assertEqual((entry["travel"], entry["direction"]), (0.25, [0, 0, 1]))
        indexed = self.parts_of(entry)
        self.assertEqual([name for name in indexed if indexed[name]], ["floor"])
        self.assertEqual(entry["skipped"]["pairs_culled_by_box"], 50)
        # A lid is in the way up: out of both, which is through the side of the floor.
        lid = ("lid", box((-3, -3, 1.875), (7, 7, 9)))
        self.scene("lid.obj", [floor, lid] + far)
        entry = self.entry("separate", "in.obj", "--fixed", "lid.obj", "-o", "out2.obj", status=0)
        indexed = self.parts_of(entry)
        self.assertEqual([name for name in indexed if indexed[name]], ["floor", "lid"])
        self.assertEqual((entry["travel"], entry["direction"]), (1.75, [0, 0, -1]))
        again = self.entry("measure", "out2.obj", "--fixed", "lid.obj", status=0)
        self.assertEqual(again["status"], "touching")
        entry = self.entry("separate", "in.obj", "--fixed", "lid.obj", "--max-travel", "1",
                           status=1)
        for key in ("matrix", "travel", "output"):
            self.assertIsNone(entry[key])

    def test_one_file_of_parts_gives_what_a_file_for_each_gives(self):
        boxes = [("one", box((0, 0, 0), (4, 4, 1))), ("two", box((0.5, 0.5, 2), (1.5, 1.5, 3))),
                 ("three", box((-3, 0, 0), (-2, 1, 4)))]
        self.scene("scene.obj", boxes)
        fixed = []
        for name, mesh in boxes:
            fixed += ["--fixed", self.mesh(f"{name}.obj", mesh)]
        for mode in (["drop"], ["slide", "-d", "-1,0,-1"], ["mate"], ["measure"],
                     ["slide", "-d", "0,0,-1", "--clearance", "0.25"],
                     ["separate", "--clearance", "3"]):
            one = self.entry(*mode, "a.obj", "--fixed", "scene.obj")
            each = self.entry(*mode, "a.obj", *fixed)
            for key in ("placed", "status", "status_at_start", "travel", "matrix", "distance",
                        "contact_count", "direction"):
                self.assertEqual(one[key], each[key], msg=f"{mode} {key}")
            nearest = one["closest"]
            if nearest:
                self.assertEqual(nearest["fixed"]["name"] + ".obj",
                                 each["closest"]["fixed"]["file"])
                self.assertEqual(nearest["fixed"]["point"], each["closest"]["fixed"]["point"])

    def test_patches_of_one_surface_are_one_body_with_an_inside(self):
        points, faces = box((0, 0, 0), (9, 9, 9))
        lines = [f"v {x} {y} {z}" for x, y, z in points]
        for i, face in enumerate(faces):
            if i % 3 == 0:
                lines.append(f"g patch{i}")
            lines.append("f " + " ".join(str(c + 1) for c in face))
        with open(self.path("patches.obj"), "w") as file:
            file.write("\n".join(lines) + "\n")
        entry = self.entry("measure", "a.obj", "--fixed", "patches.obj", status=0)
        self.assertEqual((entry["status"], entry["inside"]), ("penetrating", "moving"))
        self.assertEqual(entry["fixed"][0]["parts"], [])

    def test_groups_of_an_object_are_parts_with_both_names(self):
        self.scene("scene.obj", [("table top", box((0, 0, 2), (4, 4, 3))),
                                 ("table leg", box((3, 3, 0), (4, 4, 1)))])
        entry = self.entry("drop", "a.obj", "--fixed", "scene.obj", status=0)
        self.assertEqual(self.parts_of(entry), {"table/top": True, "table/leg": False})
        self.assertIn("scene.obj: table/top",
                      self.run_tool("drop", "a.obj", "--fixed", "scene.obj", "-n",
                                    status=0).text)

    def test_nodes_of_a_glb_are_parts_where_their_transforms_put_them(self):
        points, faces = box((0, 0, 0), (1, 1, 1))
        data = b"".join(struct.pack("<3f", *p) for p in points)
        data += b"".join(struct.pack("<3H", *f) for f in faces)
        head = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
                "nodes": [{"name": "below", "mesh": 0, "scale": [4, 4, 1]},
                          {"name": "beside", "mesh": 0, "translation": [20, 0, 0]}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                               "min": [0, 0, 0], "max": [1, 1, 1]},
                              {"bufferView": 1, "componentType": 5123, "count": 36,
                               "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 96},
                                {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
                "buffers": [{"byteLength": len(data)}]}
        text = json.dumps(head).encode()
        text += b" " * (-len(text) % 4)
        glb = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data))
        glb += struct.pack("<I4s", len(text), b"JSON") + text
        glb += struct.pack("<I4s", len(data), b"BIN\0") + data
        with open(self.path("scene.glb"), "wb") as file:
            file.write(glb)
        self.run_tool("drop", "a.obj", "--fixed", "scene.glb", "-r", "r.json")
        entry = json.loads(self.read("r.json"))["files"][0]
        self.assertEqual((entry["travel"], entry["status"]), (4.5, "touching"))
        self.assertEqual(self.parts_of(entry), {"below": True, "beside": False})

    def test_a_scene_that_is_written_keeps_the_names_of_its_parts(self):
        self.scene("scene.obj", [("floor", box((0, 0, 0), (4, 4, 1))),
                                 ("wall", box((6, 0, 0), (7, 4, 4)))])
        self.entry("drop", "a.obj", "--fixed", "scene.obj", "--scene", "-o", "out.obj", status=0)
        names = [line for line in self.read("out.obj").splitlines() if line.startswith("o ")]
        self.assertEqual(names, ["o a", "o floor", "o wall"])
        again = self.entry("measure", "a.obj", "--fixed", "out.obj", status=0)
        self.assertEqual(list(self.parts_of(again)), ["a", "floor", "wall"])
        self.run_tool("measure", "a.obj", "--fixed", "scene.obj", "--scene", "-o", "out.ply",
                      status=0)

    def test_any_number_of_threads_gives_the_same_report(self):
        self.scene("scene.obj", [(f"p{i}", box((i % 7, i // 7, 0), (i % 7 + 0.9, i // 7 + 0.9,
                                                                 1 + i % 3))) for i in range(49)])
        reports = [self.entry("mate", "a.obj", "--fixed", "scene.obj", "-j", n) for n in (1, 2, 8)]
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[0], reports[2])


if __name__ == "__main__":
    main()
