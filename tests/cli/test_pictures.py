"""--png of every tool: what is seen, sizes and views, refusals; pictures of real models as they
were.

With --keep, writes the pictures that are kept in pictures/ again."""

from support import *

import json
import zlib

KEPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pictures")
KEPT_SIZE = ("--png-size", "140x105")
# name of the picture: tool, arguments with models by their place in TREEFORM_MODELS_DIR
MODELS_SHOWN = {
    "meet": (TOOL, "selfint/scorpion_100k.obj"),
    "duplicates": (TOOL, "nonmanifold/truck_5k.obj", "--view", "front"),
    "sound": (TOOL, "clean/fandisk_14k.off"),
    "mended": (MEND, "open/camelhead_23k.off", "-n", "--view", "left"),
    "open": (MEND, "nonmanifold/beetle_2k.obj", "--check", "--view", "iso,top"),
    "union": (BOOLEAN, "union", "pairs/xcylinder.obj", "pairs/zcylinder.obj", "-n"),
    "points": (WELD, "coplanar/cubes_touching.stl", "-n"),
    "dropped": (PLACE, "drop", "clean/spot_23k.obj", "-n", "--view", "all"),
}


def read_png(data):
    """(width, height, rows of (red, green, blue)); raises what is wrong with it."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "no PNG"
    at, chunks = 8, {}
    while at < len(data):
        size, = struct.unpack(">I", data[at:at + 4])
        name, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        assert zlib.crc32(name + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
        chunks[name] = chunks.get(name, b"") + body
        at += 12 + size
    assert list(chunks) == [b"IHDR", b"IDAT", b"IEND"] and at == len(data)
    width, height, *form = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert form == [8, 2, 0, 0, 0]
    raw = zlib.decompress(chunks[b"IDAT"])
    assert len(raw) == height * (3 * width + 1)
    rows = []
    for y in range(height):
        line = raw[y * (3 * width + 1):(y + 1) * (3 * width + 1)]
        assert line[0] == 0
        rows.append([tuple(line[3 * x + 1:3 * x + 4]) for x in range(width)])
    return width, height, rows


def difference(one, other):
    """Of two pictures of one size: the mean over all colors, and the share of pixels far off."""
    pairs = [(p, q) for a, b in zip(one, other) for p, q in zip(a, b)]
    off = [max(abs(u - v) for u, v in zip(p, q)) for p, q in pairs]
    return sum(off) / len(off), sum(d > 48 for d in off) / len(off)


def command_of(name):
    tool, *arguments = MODELS_SHOWN[name]
    return [tool] + [os.path.join(MODELS, a) if "/" in a else a for a in arguments]


class Pictures(ToolTest):
    def picture(self, *arguments, size="160x120", status=None):
        run = self.run_tool(*arguments, "--png", "-", "--png-size", size, status=status)
        width, height, rows = read_png(run.out)
        self.assertEqual(f"{width}x{height}", size)
        return rows

    @staticmethod
    def count(rows, fits):
        return sum(fits(*pixel) for row in rows for pixel in row)

    def test_every_tool_writes_one(self):
        one, other = write(self.path("a.obj"), CLEAN), write(self.path("b.obj"),
                                                             cube((0.5, 0.5, 0.5)))
        for tool, *arguments in ((TOOL, one), (MEND, one, "-n"), (MEND, one, "--check"),
                                 (BOOLEAN, "union", one, other, "-n"), (WELD, one, "-n"),
                                 (PLACE, "drop", one, "-n"),
                                 (PLACE, "slide", one, "--fixed", other, "-n"),
                                 (PLACE, "measure", one, "--fixed", other),
                                 (PLACE, "clash", one, other, "-n"),
                                 (PLACE, "pack", one, other, "--size", "9,9", "-n")):
            with self.subTest(tool=tool, arguments=arguments):
                self.tool = tool
                rows = self.picture(*arguments)
                self.assertGreater(self.count(rows, lambda r, g, b: (r, g, b) != (255,) * 3), 1000)

    def test_what_is_nearer_hides_what_is_behind_it(self):
        square = lambda z: ([(0, 0, z), (1, 0, z), (1, 1, z), (0, 1, z)], [(0, 1, 2), (0, 2, 3)])
        upper, lower = write(self.path("a.obj"), square(1.0)), write(self.path("b.obj"),
                                                                     square(0.0))
        self.tool = PLACE
        for first, second, sees in ((upper, lower, True), (lower, upper, False)):
            rows = self.picture("measure", first, "--fixed", second, "--view", "front")
            red, _, blue = rows[70][85]  # y is up in OBJ. The map colors MOVING alone
            self.assertEqual(red > blue + 60, sees)

    def test_points_of_a_measured_cloud_are_seen_in_the_part(self):
        self.tool = PLACE
        part = write(self.path("part.obj"), CLEAN)
        cloud = self.put("cloud.xyz", "".join(f"{x / 8} {y / 8} {z / 4}\n" for x in range(1, 8)
                                              for y in range(1, 8) for z in range(1, 4)))
        command = ("measure", cloud, "--fixed", part, "--tolerance-band=-0.2,0.2", "--no-depth")
        blue = lambda r, g, b: b > r + 60
        self.assertGreater(self.count(self.picture(*command, size="640x480", status=1), blue), 300)
        self.run_tool(*command, "--html", "p.html", status=1)
        scene = self.scene_in("p.html")
        self.assertEqual([m["ghost"] for m in scene["meshes"]], [True])
        self.assertEqual(scene["tables"][0]["rows"][-1]["cells"], ["out of the band", 75])
        self.assertIn("penetrating part.obj; 95% within 0.375; 75 are out of the band from -0.2 "
                      "to 0.2</p>", self.read("p.html"))
        self.run_tool("measure", part, "--fixed", part, "--html", "q.html")
        self.assertEqual([m["ghost"] for m in self.scene_in("q.html")["meshes"]], [False, False])

    def test_z_is_up_over_a_bed_and_else_as_the_formats_of_all_inputs_have_it(self):
        slab = ([tuple(s * c for s, c in zip((4, 4, 1), p)) for p in cube()[0]], cube()[1])
        up_in = {}
        for name in ("a.obj", "a.ply"):
            self.tool = TOOL
            part = write(self.path("a.obj"), slab)
            if name != "a.obj":
                self.tool = MEND
                self.run_tool(part, "-o", self.path(name), status=0)
            self.tool = PLACE
            up_in[name] = {
                "drop": self.picture("drop", self.path(name), "-n", "--bed", "0", "--view",
                                     "front"),
                "pack": self.picture("pack", self.path(name), self.path(name), "--size",
                                        "19,19",
                                        "-n", "--view", "front")}
            self.tool = BOOLEAN
            up_in[name]["union"] = self.picture("union", self.path(name), self.path(name), "-n",
                                                "--view", "front")
        for what, same in (("drop", True), ("pack", True), ("union", False)):
            self.assertEqual(up_in["a.obj"][what] == up_in["a.ply"][what], same, msg=what)

    def test_findings_have_the_color_of_their_kind_and_there_are_none_in_a_sound_mesh(self):
        red = lambda r, g, b: r > g + 40 and r > b + 40
        found = self.picture(write(self.path("a.obj"), TWO_CUBES), status=1)
        self.assertGreater(self.count(found, red), 500)
        sound = self.picture(write(self.path("b.obj"), CLEAN), status=0)
        self.assertEqual(self.count(sound, red), 0)

    def test_the_legend_and_the_title_are_in_the_picture(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        rows = self.picture(part, size="640x480")
        self.assertGreater(self.count(rows[:60], lambda *c: max(c) < 120), 40)
        self.assertGreater(self.count(rows[:60], lambda r, g, b: r > 150 and g < 90), 200)
        self.assertGreaterEqual(self.count(rows[-60:], lambda *c: c == (0xE0, 0x20, 0x20)), 36)

    def scene_in(self, page):
        text = self.read(page)
        return json.loads(text[text.index("{", text.index('id="scene"')):].split("</script>")[0])

    def legend(self, *arguments, size="800x600"):
        """The colors of swatches, from left to right."""
        rows = self.picture(*arguments, size=size)[-60:]
        ink = (0x1C, 0x1F, 0x26)
        colors = []
        for row in rows:
            for first, *others in zip(*(row[i:] for i in range(6))):
                if set(others) == {first} and min(first) < 225 and first not in (ink, *colors):
                    colors.append(first)
        return colors

    def test_an_input_is_in_the_legend_once_and_in_a_color_of_its_own(self):
        self.tool = BOOLEAN
        parts = [write(self.path(f"{i}.obj"), cube((2 * i, 0, 0))) for i in range(14)]
        colors = self.legend("union", *parts[:2], "-n")
        self.assertEqual(colors, [(0x4E, 0x79, 0xA7), (0xF2, 0x8E, 0x2B)])
        self.run_tool("union", *parts, "-n", "--html", "p.html", status=0)
        of_sources = [c["color"] for c in self.scene_in("p.html")["classes"]
                      if c["name"].startswith("from ")]
        self.assertEqual(len(set(of_sources)), 14)

    def test_what_the_map_colors_has_its_colors_in_the_legend(self):
        self.tool = WELD
        points = [(i, 0, 0) for i in range(9)] + [(0.1, 0, 0), (5.05, 0, 0)]
        cloud = self.put("p.xyz", "".join("%g %g %g\n" % p for p in points
                                          + [(float("nan"), 1, 1)]))
        self.run_tool(cloud, "-t", "0.2", "-n", "--html", "p.html", status=0)
        scene = self.scene_in("p.html")
        counts = {c["name"]: (c["count"], c["mapped"]) for c in scene["classes"]}
        self.assertEqual(counts["merged with none"], ("7 points", False))  # what is drawn
        self.assertEqual(counts["dropped"], ("2 points", True))
        self.assertNotIn((0xE0, 0x20, 0x20), self.legend(cloud, "-t", "0.2", "-n"))

    def test_no_folder_is_in_a_picture(self):
        for folder in ("deep/er", "other"):
            os.makedirs(self.path(folder))
        for tool, *arguments in ((TOOL, "deep/er/a.obj"), (MEND, "deep/er/a.obj", "-n"),
                                 (BOOLEAN, "union", "deep/er/a.obj", "other/b.obj", "-n"),
                                 (PLACE, "measure", "deep/er/a.obj", "--fixed", "other/b.obj"),
                                 (PLACE, "clash", "deep/er/a.obj", "other/b.obj")):
            self.tool = tool
            with self.subTest(tool=tool, arguments=arguments):
                for name in ("deep/er/a.obj", "other/b.obj"):
                    write(self.path(name), cube((0, 0, 3 if name < "f" else 0)))
                self.run_tool(*arguments, "--html", "p.html", "-f", status=0)
                page, scene = self.read("p.html"), self.scene_in("p.html")
                facts = scene.pop("facts")
                self.assertNotIn("deep/", json.dumps(scene) + page[:page.index('id="scene"')])
                self.assertNotIn("other/", json.dumps(scene))
                if BOOLEAN != tool and "clash" not in arguments:
                    self.assertIn("deep/er/a.obj", facts[0][1])
        self.tool = BOOLEAN
        for name in ("deep/er/a.obj", "other/a.obj"):
            write(self.path(name), CLEAN)
        self.run_tool("union", "deep/er/a.obj", "other/a.obj", "-n", "--html", "p.html", "-f",
                      status=0)
        self.assertIn("from deep/er/a.obj", self.read("p.html"))  # which else

    def test_a_clash_has_a_color_for_each_pair(self):
        self.tool = PLACE
        parts = [write(self.path(f"{name}.obj"), cube(at)) for name, at in
                 (("a", (0, 0, 0)), ("b", (0.5, 0.5, 0.5)), ("c", (5, 0, 0)), ("d", (6, 0, 0)),
                  ("e", (9, 0, 0)), ("f", (10.1, 0, 0)))]
        self.run_tool("clash", *parts, "--clearance", "0.2", "--html", "p.html", "-r", "r.json",
                      status=1)
        scene = self.scene_in("p.html")
        self.assertEqual([c["name"] for c in scene["classes"]],
                         ["parts", "a and b, penetrating", "e and f, closer-than-clearance",
                          "c and d, touching"])
        with open(self.path("r.json")) as file:
            pairs = json.load(file)["files"][0]["pairs"]
        rows = {(row["cells"][0], row["cells"][1]): row for row in scene["tables"][0]["rows"]}
        for pair in pairs:
            row = rows.pop((pair["a"], pair["b"]))
            self.assertEqual((row["cells"][2], row["cells"][7]),
                             (pair["status"], pair["face_pairs"]))
            self.assertIn("box", row)
        self.assertEqual(rows, {})
        self.assertEqual(scene["lines"][0]["text"], "0.1")
        blue, orange, green = (0x4E, 0x79, 0xA7), (0xF2, 0x8E, 0x2B), (0x59, 0xA1, 0x4F)
        self.assertEqual(self.legend("clash", *parts, "--clearance", "0.2"),
                         [(0xC9, 0xCE, 0xD6), blue, orange, green])

    def test_several_views_are_one_file(self):
        part = write(self.path("part.obj"), together(cube(), cube((0, 0, 3), 0.5)))
        one, four = (self.picture(part, "--view", v) for v in ("front", "iso,top,front,right"))
        self.assertNotEqual(one, four)
        self.assertEqual(four, self.picture(part, "--view", "all"))
        self.run_tool(part, "--png", "p.png", "--view", "all", status=0)
        self.assertEqual(read_png(self.read_bytes("p.png"))[:2], (1600, 1200))
        self.assertEqual(self.listing(), ["p.png", "part.obj"])

    def test_the_number_of_threads_changes_no_byte(self):
        part = write(self.path("part.obj"), together(TWO_CUBES, grid(40, 3.0)))
        files = [self.run_tool(part, "--png", "-", "--png-size", "700x500", "--view", "all", "-j",
                               j,
                               status=1).out for j in (1, 2, 3)]
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_nothing_around_is_needed(self):
        write(self.path("part.obj"), CLEAN)
        done = subprocess.run([TOOL, "part.obj", "--png", "p.png"], cwd=self.folder, env={},
                              capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0, msg=done.stderr)
        read_png(self.read_bytes("p.png"))

    def test_what_cannot_be_written_is_an_output_error_and_nothing_is_left(self):
        part = write(self.path("part.obj"), CLEAN)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        done = subprocess.run([TOOL, part, "--png", "p.png"], cwd=self.folder, capture_output=True,
                              preexec_fn=limit, timeout=120)
        self.assertEqual(done.returncode, 4, msg=done.stderr)
        self.assertIn(b"p.png", done.stderr)
        self.run_tool(part, "--png", "no/such/p.png", status=4)
        if os.path.exists("/dev/full"):
            self.run_tool(part, "--png", "/dev/full", status=4)
            self.run_tool(part, "--html", "p.html", "--png", "/dev/full", status=4)
            self.tool = MEND
            self.run_tool(part, "-o", "/dev/full", "--output-format", "obj", "--html", "p.html",
                          "--png", "p.png", status=4)
        self.assertEqual(self.listing(), ["part.obj"])

    def test_an_existing_picture_is_not_overwritten_without_force(self):
        part = write(self.path("part.obj"), CLEAN)
        self.put("p.png", "mine")
        self.run_tool(part, "--png", "p.png", status=4)
        self.assertEqual(self.read("p.png"), "mine")
        self.run_tool(part, "--png", "p.png", "-f", status=0)
        read_png(self.read_bytes("p.png"))

    def test_options_that_make_no_sense_are_refused(self):
        part = write(self.path("part.obj"), CLEAN)
        for arguments, words in ((("--view", "top"), "--view needs --png"),
                                 (("--png-size", "90x90"), "--png-size needs --png"),
                                 (("--png", "p.png", "--view", "above"), "above"),
                                 (("--png", "p.png", "--view", "above"), "right, all"),
                                 (("--png", "p.jpg"), "p.jpg: a picture is written as png"),
                                 (("--png", "p.png", "--view", "top,"), "--view"),
                                 (("--png", "p.png", "--png-size", "1600"), "1600x1200"),
                                 (("--png", "p.png", "--png-size", "0x9"), "16 to"),
                                 (("--png", "p.png", "--png-size", "99999x9"), "16 to")):
            self.assertIn(words, self.run_tool(part, *arguments, status=2).err)
        self.tool = PLACE
        for words in (("--png", "p.png"), ("--html", "p.html")):
            self.assertIn(words[0] + " is not for check, which tests many poses and shows none",
                          self.run_tool("check", part, "--poses", "q", *words, status=2).err)
        self.tool = WELD
        points = self.put("p.xyz", "0 0 0\n1 0 0\n")
        self.assertIn("--png needs the whole cloud in memory",
                      self.run_tool(points, "--tile-points", "2", "--png", "p.png", "-n",
                                    status=2).err)
        self.assertEqual(self.listing(), ["p.xyz", "part.obj"])


@unittest.skipUnless(MODELS, "needs TREEFORM_MODELS_DIR")
class RealModels(ToolTest):
    """Kept pictures were made by a release build; another compiler may round otherwise at a rim."""

    def test_they_look_as_they_did(self):
        for name in MODELS_SHOWN:
            with self.subTest(picture=name):
                self.tool, *arguments = command_of(name)
                run = self.run_tool(*arguments, "--png", "p.png", *KEPT_SIZE, "-f")
                self.assertIn(run.status, (0, 1), msg=run.err)
                rows = read_png(self.read_bytes("p.png"))[2]
                with open(os.path.join(KEPT, name + ".png"), "rb") as file:
                    kept = file.read()
                self.assertLess(len(kept), 10_000)
                mean, far = difference(rows, read_png(kept)[2])
                self.assertLess(mean, 1.0)
                self.assertLess(far, 0.005)

    def test_another_side_of_a_model_does_not_pass(self):
        with open(os.path.join(KEPT, "duplicates.png"), "rb") as file:
            kept = read_png(file.read())[2]
        self.tool, *arguments = command_of("duplicates")
        arguments[arguments.index("front")] = "back"
        self.run_tool(*arguments, "--png", "p.png", *KEPT_SIZE)
        mean, far = difference(read_png(self.read_bytes("p.png"))[2], kept)
        self.assertGreater(mean, 2.0)
        self.assertGreater(far, 0.01)


class Documents(ToolTest):
    def test_pictures_in_documents_are_what_their_commands_draw(self):
        home = os.path.join(os.path.dirname(KEPT), "..", "..")
        os.symlink(os.path.join(os.path.abspath(home), "data"), self.path("data"))
        shown = os.path.join(home, "tools", "pictures")
        commands = {}
        for document in ("README.md", "tools/README.md"):
            with open(os.path.join(home, document)) as file:
                for line in file:
                    words = line.removeprefix("    ").removeprefix("$ ").split()
                    if "--png" in words and "--png-size" in words and words[0].startswith("tf-"):
                        commands[words[words.index("--png") + 1]] = words
        self.assertEqual(sorted(commands), sorted(os.listdir(shown)))
        tools = {os.path.basename(tool): tool for tool in (TOOL, MEND, BOOLEAN, WELD, PLACE)}
        for name, words in commands.items():
            with self.subTest(picture=name):
                self.tool = tools[words[0]]
                self.run_tool(*words[1:])
                with open(os.path.join(shown, name), "rb") as file:
                    kept = file.read()
                self.assertLess(len(kept), 60_000)
                mean, far = difference(read_png(self.read_bytes(name))[2], read_png(kept)[2])
                self.assertLess(mean, 1.0)
                self.assertLess(far, 0.005)


if __name__ == "__main__":
    if sys.argv[1:] == ["--keep"]:
        for picture in MODELS_SHOWN:
            subprocess.run(command_of(picture) + ["--png", os.path.join(KEPT, picture + ".png"),
                                                  *KEPT_SIZE, "-f"])
    else:
        main()
