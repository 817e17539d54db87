"""Files that are written: pairs, curves, marked meshes, pages; names and refusals."""

from support import *

import base64
import html.parser


def read_ply(path):
    """Header lines and the values of each element of an ASCII PLY."""
    with open(path) as file:
        lines = file.read().split("\n")
    end = lines.index("end_header")
    elements, at = [], end + 1
    for line in lines[:end]:
        words = line.split()
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[-1])
    values = {}
    for name, count, properties in elements:
        values[name] = (properties, [line.split() for line in lines[at:at + count]])
        at += count
    return values


class Outputs(ToolTest):
    def test_a_file_beyond_the_limit_is_an_output_error_and_nothing_is_left(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))
        run = subprocess.run([TOOL, part, "-o", "marked.ply"], cwd=self.folder,
                             capture_output=True, preexec_fn=limit)
        self.assertEqual(run.returncode, 4, msg=run.stderr)
        self.assertIn(b"marked.ply", run.stderr)
        self.assertEqual(os.listdir(self.folder), ["part.obj"])

    def test_pairs_are_listed_with_the_numbers_of_the_file(self):
        part = write(self.path("part.obj"), together(FOLD, PIERCE))
        self.run_tool(part, "--pairs", "p.csv", status=1)
        self.assertEqual(self.read("p.csv").splitlines()[0], "face,face,kind,region")
        entry = self.report(part)["files"][0]
        rows = [f"{a},{b},{kind},{region}" for a, b, kind, region in entry["list"]]
        self.assertEqual(self.read("p.csv").splitlines()[1:], rows)

    def test_pairs_are_complete_whatever_the_limit(self):
        part = write(self.path("part.obj"), TWO_CUBES)
        self.run_tool(part, "--pairs", "p.csv", "--limit", "1")
        found = sum(n or 0 for n in self.counts(part).values())
        self.assertEqual(len(self.read("p.csv").splitlines()), 1 + found)

    def test_a_curve_is_where_the_faces_meet(self):
        part = write(self.path("part.obj"), CROSSING)
        self.run_tool(part, "--curves", "c.obj", status=1)
        lines = self.read("c.obj").splitlines()
        ends = sorted(tuple(map(float, line.split()[1:])) for line in lines[:2])
        self.assertEqual(ends, [(1.0, 1.0, 0.0), (1.5, 1.0, 0.0)])
        self.assertEqual(lines[2:], ["l 1 2"])
        self.run_tool(part, "--curves", "c.ply", status=1)
        curves = read_ply(self.path("c.ply"))
        self.assertEqual(curves["edge"][0], ["vertex1", "vertex2", "tf_class", "tf_region"])
        self.assertEqual(curves["edge"][1], [["0", "1", "1", "0"]])
        self.run_tool(part, "--curves", "c.stl", status=2)

    def test_overlaps_are_outlined(self):
        part = write(self.path("part.obj"), OVERLAP)
        self.run_tool(part, "--curves", "c.obj", status=1)
        lines = self.read("c.obj").splitlines()
        [outline] = [line.split()[1:] for line in lines if line.startswith("l ")]
        self.assertEqual((len(outline), outline[0]), (4, outline[-1]))
        self.assertEqual(len(set(outline)), 3)

    def test_the_marked_mesh_keeps_geometry_and_numbers(self):
        mesh = together(cube((10.0, 10.0, 10.0)), CROSSING)
        part = write(self.path("part.obj"), mesh)
        self.run_tool(part, "-o", "m.ply", "--ascii", status=1)
        ply = read_ply(self.path("m.ply"))
        names, rows = ply["vertex"]
        self.assertEqual([tuple(map(float, row[:3])) for row in rows],
                         [tuple(map(float, p)) for p in mesh[0]])
        names, rows = ply["face"]
        self.assertEqual([tuple(map(int, row[1:4])) for row in rows], mesh[1])
        kind = names.index("tf_class") + 3  # a list of three takes four words
        region = names.index("tf_region") + 3
        self.assertEqual([row[kind] for row in rows], ["0"] * 12 + ["1"] * 2)
        self.assertEqual([row[region] for row in rows], ["-1"] * 12 + ["0"] * 2)
        red = names.index("red") + 3
        self.assertNotEqual(rows[0][red:red + 3], rows[12][red:red + 3])

    def test_a_soup_becomes_a_mesh_in_its_marked_copy(self):
        part = write(self.path("part.stl"), TWO_CUBES)
        self.run_tool(part, "-o", "m.ply", status=1)
        entry = self.report("m.ply", status=1)["files"][0]
        self.assertEqual(entry["vertices"], {"stored": 16, "distinct": 16})
        self.assertEqual(entry["pairs"], self.counts(part))

    def test_precision_is_kept_or_as_asked_for(self):
        third = together(CROSSING, ([(1 / 3, 5, 5), (6, 5, 5), (6, 6, 5)], [(0, 1, 2)]))
        part = write(self.path("part.obj"), third)
        output = self.report(part, "-o", "keep.ply")["files"][0]["output"]
        self.assertEqual((output["precision_out"], output["max_move"]), ("double", 0))
        entry = self.report(part, "-o", "single.ply", "--precision", "float")["files"][0]
        self.assertEqual(entry["output"]["precision_out"], "float")
        self.assertGreater(entry["output"]["max_move"], 0)
        self.assertEqual([w["code"] for w in entry["warnings"]], ["rounded"])
        again = self.report("keep.ply", "-o", "second.ply", "--ascii")["files"][0]
        self.assertEqual(again["precision_in"], "double")
        soup = write(self.path("part.stl"), CROSSING)
        output = self.report(soup, "-o", "kept.ply")["files"][0]["output"]
        self.assertEqual(output["precision_out"], "float")
        output = self.report(soup, "-o", "wide.ply", "--precision", "double")["files"][0]["output"]
        self.assertEqual((output["precision_out"], output["max_move"]), ("double", 0))
        self.run_tool(soup, "-o", "x.ply", "--precision", "half", status=2)

    def test_glb_is_written(self):
        part = write(self.path("part.obj"), CROSSING)
        self.run_tool(part, "-o", "m.glb", status=1)
        data = self.read_bytes("m.glb")
        self.assertEqual((data[:4], len(data)), (b"glTF", int.from_bytes(data[8:12], "little")))

    def test_output_dir_names_one_file_for_each_input(self):
        os.mkdir(self.path("out"))
        for name in ("a.obj", "b.stl"):
            write(self.path(name), CROSSING)
        self.run_tool("a.obj", "b.stl", "--output-dir", "out", status=1)
        self.assertEqual(sorted(os.listdir(self.path("out"))),
                         ["a-selfintersect.ply", "b-selfintersect.ply"])
        self.run_tool("a.obj", "--output-dir", "out", "--suffix", "_x", "--output-format", "glb",
                      status=1)
        self.assertIn("a_x.glb", os.listdir(self.path("out")))
        self.run_tool("a.obj", "--output-dir", "new/one", status=1)
        self.assertEqual(os.listdir(self.path("new/one")), ["a-selfintersect.ply"])
        self.run_tool("a.obj", "--output-dir", "none", "-n", status=1)
        self.run_tool("a.obj", "--output-dir", "none", "--repair=all", status=2)
        self.run_tool("a.obj", "--output-dir", "none", "--repair", "--first", status=2)
        self.assertNotIn("none", self.listing())
        self.put("file", "")
        self.assertIn("there is no folder file",
                      self.run_tool("a.obj", "--output-dir", "file", status=4).err)
        os.mkdir(self.path("other"))
        write(self.path("other/a.obj"), CLEAN)
        self.run_tool("a.obj", "other/a.obj", "--output-dir", "out", "-f", status=2)

    def test_existing_files_are_not_overwritten_without_force(self):
        part = write(self.path("part.obj"), CROSSING)
        for option, name in (("-o", "m.ply"), ("-r", "r.json"), ("--pairs", "p.csv"),
                             ("--curves", "c.obj"), ("--html", "h.html"), ("--png", "h.png")):
            with open(self.path(name), "w") as file:
                file.write("mine")
            run = self.run_tool(part, option, name, status=4)
            self.assertIn(name, run.err)
            self.assertIn("-f", run.err)
            self.assertEqual(self.read(name), "mine")
            self.run_tool(part, option, name, "-f", status=1)
            self.assertNotEqual(self.read_bytes(name), b"mine")
        self.assertEqual(self.listing(),
                         ["c.obj", "h.html", "h.png", "m.ply", "p.csv", "part.obj", "r.json"])

    def test_a_dry_run_writes_reports_but_no_mesh(self):
        part = write(self.path("part.obj"), CROSSING)
        self.run_tool(part, "-n", "-o", "m.ply", "--curves", "c.obj", "--pairs", "p.csv", "-r",
                      "r.json", status=1)
        self.assertEqual(self.listing(), ["p.csv", "part.obj", "r.json"])

    def test_outputs_that_cannot_be_are_4(self):
        part = write(self.path("part.obj"), CROSSING)
        self.run_tool(part, "-r", "no/such/r.json", status=4)
        self.run_tool(part, "-o", "no/such/m.ply", status=4)
        self.run_tool(part, "--pairs", self.folder, status=4)
        if os.path.exists("/dev/full"):
            self.run_tool(part, "--pairs", "/dev/full", status=4)
            self.run_tool(part, "-r", "/dev/full", status=4)
        self.assertEqual(self.listing(), ["part.obj"])

    def test_links_stay_links(self):
        part = write(self.path("part.obj"), CROSSING)
        open(self.path("real.csv"), "w").close()
        os.symlink("real.csv", self.path("link.csv"))
        self.run_tool(part, "--pairs", "link.csv", "-f", status=1)
        self.assertTrue(os.path.islink(self.path("link.csv")))
        self.assertIn("crossing", self.read("real.csv"))

    def test_devices_are_written_to(self):
        part = write(self.path("part.obj"), CROSSING)
        self.run_tool(part, "-r", "/dev/null", "--pairs", "/dev/null", status=1)


class TextOfPage(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.open, self.scripts, self.links = None, {}, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "script":
            self.open = attributes.get("id", "code")
        self.links += [v for k, v in attributes.items() if k in ("src", "href")]

    def handle_endtag(self, tag):
        self.open = None if tag == "script" else self.open

    def handle_data(self, data):
        if self.open:
            self.scripts[self.open] = self.scripts.get(self.open, "") + data


class Page(ToolTest):
    def page(self, *arguments):
        self.run_tool(*arguments, "--html", "h.html", "-f")
        text = self.read("h.html")
        return text, TextOfPage(text)

    def test_a_page_needs_nothing_from_elsewhere(self):
        text, page = self.page(write(self.path("part.obj"), TWO_CUBES))
        self.assertEqual(page.links, [])
        for word in ("http:", "https:", "import(", "fetch(", "@import", "url("):
            self.assertNotIn(word, text)

    def test_a_page_holds_verdict_regions_and_scene(self):
        text, page = self.page(write(self.path("part.obj"), together(TWO_CUBES, PIERCE)))
        self.assertIn("self-intersecting pairs of 26 faces", text)
        scene = json.loads(page.scripts["scene"])
        mesh = scene["meshes"][0]
        self.assertEqual((mesh["faces"], mesh["points"]), (26, 21))
        self.assertGreater(scene["lines"][0]["count"], 0)
        self.assertEqual(len(scene["tables"][0]["rows"]),
                         len(self.report(self.path("part.obj"))["files"][0]["regions"]))

    def test_the_legend_says_what_it_counts(self):
        text, page = self.page(write(self.path("part.obj"), together(TWO_CUBES, PIERCE)))
        counts = self.report(self.path("part.obj"))["files"][0]
        legend = {c["name"]: c["count"] for c in json.loads(page.scripts["scene"])["classes"]}
        self.assertEqual(legend["other"], f"{26 - counts['faces_hit']} faces")
        self.assertEqual(legend["crossing"], f"{counts['pairs']['crossing']} pairs")
        self.assertEqual(legend["pierce"], "1 pair")

    def test_components_are_in_the_order_of_their_numbers(self):
        bar = ([(-1, 0.25, 0.25), (40, 0.25, 0.25), (40, 0.75, 0.25), (-1, 0.5, 0.75)],
               [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
        cubes = [cube((3 * i, 0, 0)) for i in range(12)]
        text, page = self.page(write(self.path("part.obj"), together(*cubes, bar)))
        row = json.loads(page.scripts["scene"])["tables"][0]["rows"][0]
        self.assertEqual(row["cells"][-1], ", ".join(map(str, range(13))))
        regions = self.report(self.path("part.obj"))["files"][0]["regions"]
        self.assertEqual([r["components"] for r in regions], [list(range(13))])

    def test_the_scene_unpacks_to_the_mesh(self):
        mesh = TWO_CUBES
        text, page = self.page(write(self.path("part.obj"), mesh))
        scene = json.loads(page.scripts["scene"])
        data = base64.b64decode(page.scripts["geometry"])
        numbers, value, scale = [], 0, 1
        for byte in data:
            value += (byte & 127) * scale
            scale *= 128
            if byte < 128:
                numbers.append(-(value + 1) // 2 if value % 2 else value // 2)
                value, scale = 0, 1
        stream = iter(numbers)
        last, points = [0, 0, 0], []
        for _ in range(scene["meshes"][0]["points"]):
            last = [v + next(stream) for v in last]
            points.append([low + v * scene["step"] for low, v in zip(scene["low"], last)])
        corner = number = 0
        for expected in range(scene["meshes"][0]["faces"]):
            triangle = []
            for _ in range(3):
                corner += next(stream)
                triangle.append(points[corner])
            number += next(stream)
            self.assertEqual(number, expected)
            kind, region = next(stream), next(stream)
            self.assertEqual(region, 0 if kind else -1)
            for got, vertex in zip(triangle, mesh[1][number]):
                for a, b in zip(got, mesh[0][vertex]):
                    self.assertAlmostEqual(a, b, delta=1e-6)

    def test_names_are_escaped(self):
        name = "<b>&\"'.obj"
        text, page = self.page(write(self.path(name), CROSSING))
        self.assertNotIn("<b>&", text)
        self.assertIn("&lt;b&gt;&amp;", text)

    def test_large_models_are_thinned_out_but_keep_what_was_found(self):
        mesh = together(grid(360), ([(3.2, 3.3, -1), (3.2, 3.3, 1), (3.4, 3.3, 1)], [(0, 1, 2)]))
        text, page = self.page(write(self.path("part.stl"), mesh))
        scene = json.loads(page.scripts["scene"])
        self.assertLess(scene["meshes"][0]["faces"], 201_000)
        self.assertGreater(scene["left_out"][0]["count"], 50_000)
        self.assertLess(len(text), 4_000_000)


if __name__ == "__main__":
    main()
