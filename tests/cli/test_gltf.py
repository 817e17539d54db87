"""glTF and GLB through the tools: what people reported about other programs, and what other
programs say of the files. These are assimp (apt-get install assimp-utils) and gltf-transform with
the validator of Khronos (npm install -g @gltf-transform/cli)."""

from support import *
from gltf_support import *

ASSIMP = shutil.which(os.environ.get("ASSIMP", "assimp"))
TRANSFORM = shutil.which(os.environ.get("GLTF_TRANSFORM", "gltf-transform"))
COLORS = [(0, 128, 64, 255), (255, 128, 64, 255)] * 4


class GltfTest(ToolTest):
    tool = WELD

    def put_glb(self, name, gltf):
        with open(self.path(name), "wb") as file:
            file.write(gltf.glb())
        return name

    def of(self, tool, *arguments, status=0):
        self.tool = tool
        try:
            return self.run_tool(*arguments, status=status)
        finally:
            self.tool = WELD

    def ply(self, name):
        """The rows of vertices, and the names of their properties."""
        self.run_tool("--ascii", name, "-o", "o.ply", "-f", "-t", "0", status=0)
        head, body = self.read("o.ply").split("end_header\n")
        vertices = head.split("element vertex ")[1].split("element face")[0].splitlines()
        names = [line.split()[2] for line in vertices[1:] if line.startswith("property")]
        rows = [tuple(map(float, line.split())) for line in body.splitlines()[:int(vertices[0])]]
        return names, rows


class Reports(GltfTest):
    def test_a_negative_determinant_turns_faces_over(self):
        left = {"mesh": 0, "name": "left"}
        for name, right in (("mirrored.glb", {"scale": [-1, 1, 1], "translation": [1.5, 0, 0]}),
                            ("plain.glb", {"translation": [0.5, 0, 0]})):
            self.put_glb(name, Gltf([left, {"mesh": 0, "name": "right", **right}]))
            run = self.of(PLACE, "clash", name, status=1)
            self.assertIn("left and right: penetrating", run.text)
            self.assertIn("common volume 0.5", run.text)
            self.assertIn("volume 1.5", self.of(BOOLEAN, "union", name, "-o", "u.stl", "-f").text)
            self.assertAlmostEqual(volume_of_stl(self.read_bytes("u.stl")), 1.5)

    def test_quantized_coordinates_are_what_they_stand_for(self):
        for letter, full, members in (("H", 65535, {"normalized": True}), ("b", 127, {}),
                                      ("h", 32767, {"normalized": True}), ("B", 255, {})):
            gltf = Gltf(extensionsRequired=["KHR_mesh_quantization"])
            rows = [tuple(full * x for x in p) for p in CORNERS]
            gltf.attributes["POSITION"] = gltf.add(rows, letter, **members)
            size = 1.0 if members else float(full)
            self.put_glb("q.glb", gltf)
            self.assertEqual(self.ply("q.glb")[1], [tuple(size * x for x in p) for p in CORNERS])

    def test_extensions_that_are_required_and_not_read_are_refused_by_name(self):
        for name in ("EXT_meshopt_compression", "ACME_shape"):
            self.put_glb("e.glb", Gltf(extensionsUsed=[name], extensionsRequired=[name]))
            run = self.run_tool("e.glb", "-o", "o.ply", status=3)
            self.assertIn(f"requires the extension {name}, which is not supported", run.err)
            self.assertEqual("gltf-transform copy" in run.err, name != "ACME_shape")
        self.assertEqual(self.listing(), ["e.glb"])

    def test_instances_are_parts(self):
        gltf = Gltf(extensionsRequired=["EXT_mesh_gpu_instancing"])
        shifts = gltf.add([(0, 0, 0), (0.5, 0, 0), (9, 0, 0)], "f")
        gltf.root["nodes"][0] = {"mesh": 0, "name": "bolt", "extensions": {
            "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": shifts}}}}
        self.put_glb("i.glb", gltf)
        run = self.of(PLACE, "clash", "i.glb", status=1)
        self.assertIn("bolt and bolt (2): penetrating", run.text)
        self.assertIn("3 parts: 1 pair", run.text)

    def test_files_with_encoded_names_are_read_and_no_others(self):
        gltf = Gltf()
        with open(self.path("my bufü.bin"), "wb") as file:
            file.write(gltf.data)
        self.put("e.gltf", gltf.text("my%20buf%C3%BC.bin"))
        self.assertEqual(len(self.ply("e.gltf")[1]), 8)
        self.put("in/e.gltf", gltf.text("../my%20buf%C3%BC.bin"))
        self.assertIn("only files in the folder", self.run_tool("in/e.gltf", "-n", status=3).err)
        self.put("m.gltf", gltf.text("none.bin"))
        self.assertIn("none.bin', which does not exist",
                      self.run_tool("m.gltf", "-n", status=3).err)

    def test_colors_of_points_go_to_ply_and_back(self):
        for letter, full in (("B", 255), ("H", 65535), ("f", 1.0)):
            for channels in (3, 4):
                gltf = Gltf()
                rows = [tuple(full if c == 255 else 0 for c in row[:channels]) for row in COLORS]
                gltf.attributes["COLOR_0"] = gltf.add(rows, letter, normalized=letter != "f")
                self.put_glb("c.glb", gltf)
                names, points = self.ply("c.glb")
                self.assertEqual(names[3:], ["red", "green", "blue", "alpha"][:channels])
                # PLY has them as others read them, in 8 bits.
                self.assertEqual([p[3:] for p in points],
                                 [tuple(255.0 if c == 255 else 0.0 for c in row[:channels])
                                  for row in COLORS])
                self.run_tool("o.ply", "-o", "d.glb", "-f", status=0)
                self.assertEqual(self.ply("d.glb"), (names, points))

    def test_normals_and_texture_coordinates_go_to_glb_and_back(self):
        head = "".join(f"property float {n}\n" for n in ("x", "y", "z", "s", "t", "nx", "ny", "nz"))
        rows = "".join(f"{x} {y} {z} 0.5 0.25 0 0 1\n" for x, y, z in CORNERS)
        faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
        self.put("n.ply", f"ply\nformat ascii 1.0\nelement vertex 8\n{head}element face 12\n"
                          f"property list uchar int vertex_indices\nend_header\n{rows}{faces}")
        self.run_tool("n.ply", "-o", "n.glb", status=0)
        primitive = json_of_glb(self.read_bytes("n.glb"))["meshes"][0]["primitives"][0]
        self.assertEqual(list(primitive["attributes"]), ["POSITION", "NORMAL", "TEXCOORD_0"])
        names, points = self.ply("n.glb")
        self.assertEqual(dict(zip(names, points[1])), {"x": 1, "y": 0, "z": 0, "nx": 0, "ny": 0,
                                                       "nz": 1, "s": 0.5, "t": 0.25})

    def test_names_go_to_glb_and_back(self):
        self.put("p.obj", obj_bytes(cube()).decode().replace("f ", "o first\nf ", 1)
                 + "o second\n" + "\n".join(f"v {x + 5} {y} {z}" for x, y, z in CORNERS)
                 + "\n" + "\n".join("f " + " ".join(str(i + 9) for i in f) for f in FACES) + "\n")
        self.run_tool("p.obj", "-o", "p.glb", status=0)
        self.assertEqual([n["name"] for n in json_of_glb(self.read_bytes("p.glb"))["nodes"]],
                         ["first", "second"])
        self.run_tool("p.glb", "-o", "q.obj", status=0)
        names = [line for line in self.read("q.obj").splitlines() if line.startswith("o ")]
        self.assertEqual(names, ["o first", "o second"])


def samples():
    """Name, glTF and volume."""
    moved = {"mesh": 0, "rotation": [0, 0.6, 0, 0.8], "scale": [1, 2, 3], "translation": [5, 6, 7]}
    yield "plain", Gltf(), 1
    yield "moved", Gltf([moved]), 6
    yield "nested", Gltf([{"children": [1], "scale": [2, 2, 2]}, {"mesh": 0}],
                         scenes=[{"nodes": [0]}]), 8
    colored = Gltf()
    colored.attributes["COLOR_0"] = colored.add(COLORS, "B", normalized=True)
    yield "colored", colored, 1
    bytes_ = Gltf()
    bytes_.root["meshes"][0]["primitives"][0]["indices"] = bytes_.add(
        [(i,) for face in FACES for i in face], "B")
    yield "bytes", bytes_, 1


class Judges(GltfTest):
    """Volumes of what others read of files, and of what they write."""

    def volume(self, name):
        self.run_tool(name, "-o", "v.stl", "-f", "-t", "0", status=0)
        return volume_of_stl(self.read_bytes("v.stl"))

    def judged(self, *command):
        done = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, msg=f"{command}\n{done.stdout}\n{done.stderr}")
        return done.stdout.decode()

    def each(self):
        """Files of each sample: as it is, and as a tool writes it."""
        for name, gltf, volume in samples():
            with self.subTest(name):
                self.put_glb("a.glb", gltf)
                self.run_tool("a.glb", "-o", "b.glb", "-f", "-t", "0", status=0)
                yield "a.glb", volume
                yield "b.glb", volume

    @unittest.skipUnless(ASSIMP, "needs assimp: apt-get install assimp-utils")
    def test_assimp_has_the_same_volume(self):
        for name, volume in self.each():
            self.judged(ASSIMP, "export", name, "j.stl", "-fstlb", "-ptv")
            self.assertAlmostEqual(volume_of_stl(self.read_bytes("j.stl")), volume, 5)
            self.assertAlmostEqual(self.volume(name), volume, 5)

    @unittest.skipUnless(TRANSFORM, "needs gltf-transform: npm install -g @gltf-transform/cli")
    def test_the_validator_of_khronos_finds_no_errors(self):
        for name, _ in self.each():
            self.assertIn("No errors found", self.judged(TRANSFORM, "validate", name))

    @unittest.skipUnless(TRANSFORM, "needs gltf-transform: npm install -g @gltf-transform/cli")
    def test_what_gltf_transform_writes_is_read(self):
        self.put_glb("a.glb", Gltf([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]},
                                    {"mesh": 0, "translation": [9, 0, 0], "scale": [2, 1, 1]}]))
        for verb in (["copy"], ["quantize"], ["instance", "--min", "2"], ["sparse"], ["tangents"],
                     ["flatten"], ["reorder"]):
            with self.subTest(verb[0]):
                self.judged(TRANSFORM, verb[0], "a.glb", "j.glb", *verb[1:])
                self.assertAlmostEqual(self.volume("j.glb"), 4, 2)
        for verb in (["draco"], ["draco", "--method", "sequential"], ["meshopt"]):
            with self.subTest(" ".join(verb)):
                self.judged(TRANSFORM, verb[0], "a.glb", "j.glb", *verb[1:])
                run = self.run_tool("j.glb", "-n")
                if run.status == 0:  # draco, where the tools were built with it
                    self.assertAlmostEqual(self.volume("j.glb"), 4, 2)
                else:
                    self.assertEqual(run.status, 3)
                    self.assertIn("gltf-transform copy", run.err)
                self.judged(TRANSFORM, "copy", "j.glb", "k.glb")
                self.assertAlmostEqual(self.volume("k.glb"), 4, 2)


if __name__ == "__main__":
    main()
