"""Pages of all tools in a headless Chromium, from file://: what they draw, say and ask for.

With KEEP_PICTURES=1, the small pictures beside this file are made anew."""

import base64
import functools
import html
import json
import os
import pathlib
import re
import shutil
import struct
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "cli"))

import support  # noqa: E402
from browser import CHROMIUM, Browser, read_png  # noqa: E402
from support import BOOLEAN, MEND, PLACE, TOOL, WELD, ToolTest, together, write  # noqa: E402

DATA = HERE.parents[1] / "data"
SPHERES, CUBE, SPHERE, DIRTY = (str(DATA / name) for name in
                                ("two_spheres.stl", "cube.stl", "sphere.ply", "dirty.stl"))

# name: (tool, arguments); {high} is the sphere, six above the cube
PAGES = {
    "selfintersect": (TOOL, [SPHERES]),
    "repair": (MEND, [DIRTY, "-n"]),
    "repair_check": (MEND, [DIRTY, "--check"]),
    "repair_wrap": (MEND, [DIRTY, "--wrap", "20%", "-n"]),
    "boolean": (BOOLEAN, ["difference", SPHERES, CUBE, "-n"]),
    "boolean_open": (BOOLEAN, ["--check", CUBE, str(DATA / "fold.obj")]),
    "weld": (WELD, [SPHERE, "-t", "0.15", "--check"]),
    "weld_cloud": (WELD, ["{cloud}", "-t", "0.15", "-n"]),
    "drop": (PLACE, ["drop", SPHERE, "--bed", "5", "-n"]),
    "slide": (PLACE, ["slide", "{high}", "--fixed", CUBE, "--clearance", "0.03", "-n"]),
    "touch": (PLACE, ["slide", "{high}", "--fixed", CUBE, "-n"]),
    "measure": (PLACE, ["measure", "{high}", "--fixed", CUBE]),
    "band": (PLACE, ["measure", SPHERE, "--fixed", CUBE, "--tolerance-band=-0.1,0.2"]),
    "pack": (PLACE, ["pack", "{high}", CUBE, "--count", CUBE + ":6", "--size", "5,5",
                        "--spacing",
                        "0.2", "-n"]),
    "clash": (PLACE, ["clash", SPHERES, CUBE, "{high}", "--clearance", "3.9"]),
    "no_place": (PLACE, ["slide", SPHERE, "--fixed", CUBE, "-n"]),
}

# What all tests of pixels use. `only` shows these classes; `drawn` counts pixels that are opaque,
# of these the ones of a class's color in some light, and all that are not empty.
HELPERS = """
window.only = (kinds) => {
    document.querySelectorAll('[data-class]').forEach((input) => {
        const wanted = kinds === null || kinds.includes(Number(input.dataset.class));
        if (input.checked !== wanted) input.click();
    });
};
window.drawn = (kind) => {
    viewer.draw();
    const pixels = viewer.pixels(), c = kind === null ? [1, 1, 1] : viewer.scene.classes[kind].rgb;
    const cc = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    let opaque = 0, own = 0, any = 0;
    for (let i = 0; i < pixels.length; i += 4) {
        const [r, g, b, a] = [pixels[i], pixels[i + 1], pixels[i + 2], pixels[i + 3]];
        if (a) ++any;
        if (a < 255) continue;
        ++opaque;
        const s = Math.min(Math.max((r * c[0] + g * c[1] + b * c[2]) / cc, 0.25), 1.02);
        const off = [r - s * c[0], g - s * c[1], b - s * c[2]];
        if (Math.max(...off.map(Math.abs)) < 9) ++own;
    }
    return { opaque, own, any };
};
window.sum = () => {
    viewer.draw();
    let sum = 0;
    viewer.pixels().forEach((v, i) => { sum = (sum * 31 + v) % 1000000007; });
    return sum;
};
window.project = (point) => {
    const view = document.querySelector('canvas'), p = viewer.scene.toView(point);
    const m = viewer.camera.matrix(view.clientWidth / view.clientHeight);
    const [x, y, , w] = [0, 1, 2, 3].map(
        (i) => m[i] * p[0] + m[4 + i] * p[1] + m[8 + i] * p[2] + m[12 + i]);
    return [(x / w + 1) / 2 * view.clientWidth, (1 - y / w) / 2 * view.clientHeight];
};
window.small = () => {
    viewer.draw();
    const from = document.querySelector('canvas'), to = document.createElement('canvas');
    [to.width, to.height] = [160, 96];
    const pen = to.getContext('2d');
    pen.fillStyle = '#e8ebef';
    pen.fillRect(0, 0, 160, 96);
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(from, 0, 0, 160, 96);
    return to.toDataURL('image/png').split(',')[1];
};
"""


@functools.cache
def triangles_of_stl(path):
    """Of a binary STL, or an ASCII one."""
    data = pathlib.Path(path).read_bytes()
    if data[:5] == b"solid":
        numbers = [tuple(map(float, line.split()[1:])) for line in data.decode().splitlines()
                   if line.split()[:1] == ["vertex"]]
        return [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
    count = struct.unpack("<I", data[80:84])[0]
    values = [struct.unpack("<9f", data[84 + 50 * i + 12:84 + 50 * i + 48]) for i in range(count)]
    return [[v[0:3], v[3:6], v[6:9]] for v in values]


def rod(at, size):
    points, faces = support.cube()
    return [tuple(a + s * p for a, s, p in zip(at, size, point)) for point in points], faces


def setUpModule():
    if CHROMIUM:
        PageTest.browser = Browser()
        PageTest.pages = tempfile.mkdtemp(prefix="treeform-pages-")


def tearDownModule():
    if CHROMIUM:
        PageTest.browser.close()
        shutil.rmtree(PageTest.pages)


@unittest.skipUnless(CHROMIUM, "needs chromium: apt-get install chromium")
class PageTest(ToolTest):
    def make(self, name):
        """The page of that name, made once for all tests."""
        page = os.path.join(self.pages, name + ".html")
        if os.path.exists(page):
            return page
        tool, arguments = PAGES[name]
        if "{high}" in arguments:
            self.tool = PLACE
            self.run_tool("drop", SPHERE, "--bed", "5", "-o", "high.ply", "-f", status=0)
        if "{cloud}" in arguments:
            self.tool = WELD
            self.run_tool("-q", SPHERE, "-o", "cloud.las", "-f", status=0)
        self.tool = tool
        run = self.run_tool(*[a.format(high="high.ply", cloud="cloud.las") for a in arguments],
                            "--html", page, "-r", os.path.join(self.pages, name + ".json"), "-f")
        self.assertIn(run.status, (0, 1), run.err)
        return page

    def open(self, page, fragment=""):
        self.browser.open(page, fragment)
        self.browser.run(HELPERS)

    def show(self, name):
        self.open(self.make(name))
        return json.loads(pathlib.Path(self.pages, name + ".json").read_text())

    def quiet(self):
        self.assertEqual(self.browser.complaints(), [])

    def run_js(self, script):
        return self.browser.run(script)

    def variants(self):
        return self.run_js("[...document.querySelectorAll('[data-variant]')].map(b => "
                           "b.dataset.variant)")

    def press_button(self, data, value):
        self.run_js(f"document.querySelector('[data-{data}=\"{value}\"]').click()")
        self.browser.settle()


class Pages(PageTest):
    def test_each_color_of_a_legend_is_drawn_and_goes_with_its_switch(self):
        for name in PAGES:
            with self.subTest(page=name):
                self.show(name)
                self.run_js("document.querySelector('[data-map]:checked')?.click()")
                kinds = self.run_js("[...document.querySelectorAll('[data-class]')]"
                                    ".map(i => Number(i.dataset.class))")
                self.assertGreater(len(kinds), 1)
                ghosts = self.run_js("viewer.scene.meshes.filter(m => m.ghost).map(m => "
                                     "m.kinds[0])")
                for kind in kinds:
                    best = {"own": 0, "opaque": 0, "any": 0}
                    for variant in self.variants()[:2] or [None]:
                        if variant:
                            self.press_button("variant", variant)
                        self.run_js(f"only([{kind}])")
                        found = self.run_js(f"drawn({kind})")
                        best = max(best, found, key=lambda f: f["any"])
                        self.run_js("only([])")
                        self.assertEqual(self.run_js("drawn(null)")["any"], 0)
                    label = self.run_js(f"viewer.scene.classes[{kind}].name")
                    self.assertGreater(best["any"], 8, label)
                    if kind in ghosts:
                        self.assertEqual(best["opaque"], 0, label)  # one sees through
                    else:
                        self.assertGreater(best["own"], 0.9 * best["opaque"], label)
                        self.assertGreater(best["own"], 3, label)
                self.quiet()

    def test_the_map_colors_faces_by_their_values(self):
        for name, kind in (("measure", 0), ("slide", 0)):
            with self.subTest(page=name):
                self.show(name)
                self.run_js(f"only([{kind}])")
                self.assertLess(self.run_js(f"drawn({kind})")["own"],
                                self.run_js("drawn(null)")["opaque"] / 2)
                self.run_js("document.querySelector('[data-map]').click()")
                found = self.run_js(f"drawn({kind})")
                self.assertGreater(found["own"], 0.9 * found["opaque"])

    def test_what_the_map_colors_has_its_colors_in_the_legend_until_it_is_switched_off(self):
        for name, mapped in (("weld_cloud", "dropped"), ("measure", "high.ply")):
            self.show(name)
            kind = self.run_js(f"viewer.scene.classes.findIndex((c) => c.name === '{mapped}')")
            swatch = f"getComputedStyle(document.querySelector('[data-class=\"{kind}\"]')" \
                     ".parentNode.querySelector('.swatch')).backgroundImage"
            self.assertIn("gradient", self.run_js(swatch))
            self.run_js("document.querySelector('[data-map]').click()")
            self.assertEqual(self.run_js(swatch), "none")

    def test_the_band_is_green_until_it_is_switched_off(self):
        self.show("band")
        self.run_js("only([0])")
        green = "(viewer.draw(), viewer.pixels().reduce((n, v, i, p) => n + (i % 4 === 0 " \
                "&& p[i + 3] === 255 && p[i + 1] > 1.3 * v && p[i + 1] > 1.3 * p[i + 2]), 0))"
        on = self.run_js(green)
        self.run_js("document.querySelector('[data-band]').click()")
        self.assertGreater(on, 500)
        self.assertEqual(self.run_js(green), 0)

    def test_a_pixel_is_green_where_the_value_that_is_picked_is_in_the_band(self):
        self.show("band")
        self.run_js("only([0])")
        # at the cube
        self.run_js("Object.assign(viewer.camera, { turn: 3 * Math.PI / 4, tilt: 0.6155 })")
        rows = self.run_js("""(() => {
            const view = document.querySelector('canvas'), found = [];
            const face = (x, y) =>
                (viewer.pick(x, y), document.querySelector('.picked').dataset.number);
            for (let i = 0; i < 225; ++i) {
                const x = Math.floor(view.width * (0.3 + 0.4 * (i % 15) / 15)) + 0.5;
                const y = Math.floor(view.height * (0.15 + 0.7 * Math.floor(i / 15) / 15)) + 0.5;
                const around = [face(x - 1, y), face(x + 1, y), face(x, y - 1), face(x, y + 1)];
                if (around.some((n) => n !== face(x, y))) continue;  // a pixel of one face alone
                const value = /signed distance ([-0-9.e]+)/.exec(
                    document.querySelector('.picked').textContent);
                const at = 4 * (Math.floor(x) + view.width * (view.height - 1 - Math.floor(y)));
                if (value) found.push([Number(value[1]), at]);
            }
            viewer.pick(-1, -1);  // without the outline
            viewer.draw();
            const pixels = viewer.pixels();
            return found.map(([value, at]) => [value, ...pixels.slice(at, at + 4)]);
        })()""")
        green = [(value, g > 1.3 * r and g > 1.3 * b) for value, r, g, b, a in rows if a == 255]
        sure = [pair for pair in green if min(abs(pair[0] + 0.1), abs(pair[0] - 0.2)) > 0.001]
        self.assertGreater(sum(is_green for _, is_green in sure), 2)
        self.assertGreater(len(sure), 50)
        self.assertEqual([pair for pair in sure if pair[1] != (-0.1 <= pair[0] <= 0.2)], [])

    def test_pictures_are_as_they_were(self):
        for name in PAGES:
            with self.subTest(page=name):
                self.show(name)
                data = base64.b64decode(self.run_js("small()"))
                kept = HERE / "pictures" / (name + ".png")
                if os.environ.get("KEEP_PICTURES"):
                    kept.parent.mkdir(exist_ok=True)
                    kept.write_bytes(data)
                self.assertLess(len(data), 20_000)
                (w, h, now), (_, _, then) = read_png(data), read_png(kept.read_bytes())
                far = sum(max(abs(a - b) for a, b in zip(r[i:i + 3], s[i:i + 3])) > 48
                          for r, s in zip(now, then) for i in range(0, 3 * w, 3))
                self.assertLess(far, 0.01 * w * h)


def distance_of_plane(point, corners):
    """How far a point is from the plane of a face."""
    u, v = ([c - a for a, c in zip(corners[0], corner)] for corner in corners[1:])
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    size = sum(n * n for n in normal) ** 0.5
    return abs(sum(n * (p - a) for n, p,
                   a in zip(normal, point, corners[0]))) / size if size else 0.0


class Numbers(PageTest):
    def picked_texts(self, steps):
        """What is said where the view is clicked, so many places across and down."""
        return self.run_js(f"""(() => {{
            const view = document.querySelector('canvas'), texts = new Set(), steps = {steps};
            for (let i = 0; i < steps * steps; ++i) {{
                const x = (i % steps + 0.5) / steps, y = (Math.floor(i / steps) + 0.5) / steps;
                viewer.pick(x * view.width, y * view.height);
                texts.add(document.querySelector('.picked').textContent);
            }}
            return [...texts];
        }})()""")

    def test_what_is_picked_lies_in_the_face_of_the_file_that_has_the_number(self):
        at = r" at (\S+), (\S+), (\S+)$"
        files = {"two_spheres.stl": SPHERES, "cube.stl": CUBE, "dirty.stl": DIRTY}
        for name, pattern, least in (
                ("selfintersect", r"face (?P<face>\d+)(?: \(.*\))?" + at, 90),
                ("boolean", r"face \d+ of the result \(from (?P<file>\S+), in face (?P<face>\d+)\)"
                 + at, 90),
                ("repair", r"face \d+ of the result \(.*in face (?P<face>\d+)\)" + at, 45),
                ("repair_check", r"face (?P<face>\d+)(?: \(.*\))?" + at, 45),
                ("touch", r"face (?P<face>\d+) of (?P<file>cube\.stl)(?: \(.*\))?" + at, 9)):
            with self.subTest(page=name):
                self.show(name)
                self.press_button("view", "front")
                own = "two_spheres.stl" if name == "selfintersect" else "dirty.stl"
                seen = set()
                for picked in filter(None, (re.match(pattern, text)
                                            for text in self.picked_texts(40))):
                    file = files[picked.groupdict().get("file") or own]
                    corners = triangles_of_stl(file)[int(picked["face"])]
                    point = [float(v) for v in picked.groups()[-3:]]
                    self.assertLess(distance_of_plane(point, corners), 2e-5, picked[0])
                    seen.add(picked[0])
                self.assertGreater(len(seen), least)

    def test_a_face_is_picked_with_its_number_in_the_file(self):
        report = self.show("selfintersect")["files"][0]
        found = {f for pair in report["list"] for f in pair[:2]}
        seen, marked = 0, 0
        self.press_button("view", "front")
        for number, corners in enumerate(triangles_of_stl(SPHERES)):
            center = [sum(c[axis] for c in corners) / 3 for axis in range(3)]
            text, at = self.run_js(f"""(() => {{
                viewer.pick(...project({center}));
                const box = document.querySelector('.picked');
                return [box.textContent, box.dataset.number ?? null];
            }})()""")
            if at is None:
                continue
            place = [float(v) for v in text.rsplit(" at ", 1)[1].split(", ")]
            if max(abs(a - b) for a, b in zip(place, center)) > 1e-5:
                continue  # another face is in front of it
            self.assertEqual(int(at), number, text)
            self.assertEqual("crossing, region 0" in text, number in found, text)
            seen, marked = seen + 1, marked + (number in found)
        self.assertGreater(seen, 100)
        self.assertGreater(marked, 5)
        self.quiet()

    def test_faces_of_a_clash_are_picked_with_the_numbers_of_the_report(self):
        report = self.show("clash")["files"][0]
        faces = {"two_spheres": triangles_of_stl(SPHERES), "cube/model": triangles_of_stl(CUBE)}
        found = {(pair[side], face) for pair in report["pairs"] for region in pair["regions"]
                 for side in "ab" for face in region["faces_" + side]}
        self.press_button("view", "front")
        texts = self.picked_texts(60)
        seen = marked = 0
        for text in texts:
            picked = re.match(r"face (\d+) of (\S+)(?: \((.*)\))? at (\S+), (\S+), (\S+)$", text)
            if not picked or picked[2] not in faces:
                continue
            number, part = int(picked[1]), picked[2]
            self.assertEqual((part, number) in found, picked[3] is not None, text)
            at, corners = [float(v) for v in picked.groups()[3:]], faces[part][number]
            for axis in range(3):
                low, high = (f(c[axis] for c in corners) for f in (min, max))
                self.assertTrue(low - 0.05 <= at[axis] <= high + 0.05, (text, corners))  # at a rim
            seen, marked = seen + 1, marked + (picked[3] is not None)
        self.assertGreater(marked, 5)
        self.assertGreater(seen - marked, 5)

    def test_points_are_picked_with_their_numbers_and_what_became_of_them(self):
        self.show("weld_cloud")
        self.assertEqual(self.run_js("viewer.scene.dots.reduce((n, d) => n + d.count, 0)"), 642)
        for row in (0, 7, 100):
            text = self.run_js(f"""(() => {{
                const dots = viewer.scene.dots[1];
                const p = dots.positions.subarray(3 * {row}, 3 * {row} + 3);
                viewer.camera.turn = Math.atan2(p[0], -p[1]);
                viewer.camera.tilt = Math.asin(p[2] / Math.hypot(...p));
                viewer.draw();
                viewer.pick(...project(viewer.scene.toFile([...p])));
                return [document.querySelector('.picked').textContent, dots.numbers[{row}],
                        dots.groups[{row}]];
            }})()""")
            self.assertIn(f"point {text[1]} (dropped, now point {text[2]}, moved by 0.1", text[0])

    def test_open_edges_have_numbers_and_lengths(self):
        self.show("repair_check")
        self.assertEqual(self.run_js("viewer.scene.lines[0].count"), 12)
        self.run_js("Object.assign(viewer.camera, { turn: Math.PI / 4, tilt: 0.6155 })")
        for edge in range(3, 9):  # of the hole in front
            text = self.run_js(f"""(() => {{
                const e = viewer.scene.lines[0].positions.subarray(6 * {edge}, 6 * {edge} + 6);
                const middle = [0, 1, 2].map((i) => (e[i] + e[3 + i]) / 2);
                viewer.pick(...project(viewer.scene.toFile(middle)));
                return document.querySelector('.picked').textContent;
            }})()""")
            self.assertRegex(text, rf"^open edge {edge} \(open edges, length 0\.\d+\) at ")
        self.assertIn("0",
                      self.run_js("[...document.querySelectorAll('.tags span')].map(t => "
                                  "t.textContent)"))

    def test_lengths_stand_beside_their_lines_and_arrows(self):
        tags = "[...document.querySelectorAll('.tags span')].map(t => t.textContent)"
        travel = self.show("slide")["files"][0]["travel"]
        self.assertTrue(any(abs(float(t) - travel) < 1e-4 for t in self.run_js(tags)),
                        self.run_js(tags))
        distance = self.show("measure")["files"][0]["distance"]
        self.assertTrue(any(abs(float(t) - distance) < 1e-5 for t in self.run_js(tags)))
        self.show("pack")
        self.assertLessEqual({"high", "plate 0"}, set(self.run_js(tags)))
        self.run_js("document.querySelector('[data-labels]').click()")
        self.browser.settle()
        self.assertEqual(self.run_js(tags), [])

    def test_a_unit_stands_behind_lengths(self):
        page = self.path("mm.html")
        self.tool = PLACE
        self.run_tool("drop", SPHERE, "--bed", "5", "-o", "high.ply", status=0)
        self.run_tool("measure", "high.ply", "--fixed", CUBE, "--units", "mm", "--html", page)
        self.open(page)
        self.assertEqual(self.run_js("document.querySelector('.tags span').textContent"), "4 mm")
        self.assertEqual(self.run_js("document.querySelector('.unit').textContent"), "unit: mm")

    def test_a_histogram_has_all_values_and_the_tolerance(self):
        self.show("weld_cloud")
        bars = self.run_js("[...document.querySelectorAll('.histogram title')]"
                           ".map(t => Number(t.textContent.split(': ')[1].replaceAll(',', '')))")
        self.assertEqual(sum(bars), 642)
        self.assertEqual(self.run_js("document.querySelector('text.mark').textContent"),
                         "tolerance 0.15")

    def test_tables_have_the_numbers_of_the_report(self):
        report = self.show("boolean")
        cells = self.run_js("[...document.querySelectorAll('td')].map(t => t.textContent)")
        for source in report["files"][0]["inputs"]:
            self.assertIn(f"{source['volume']:.7g}", cells)
        steps = self.show("repair")["files"][0]["repair"]["steps"]
        cells = self.run_js("[...document.querySelectorAll('tr')].map(r => [...r.cells].map(c => "
                            "c.textContent))")
        self.assertIn(["orient", "flipped", str(steps["orient"]["flipped"])], cells)
        self.assertIn(["fill", "holes", str(steps["fill"]["holes"])], cells)

    def test_texts_of_files_stay_texts(self):
        name = self.path("<img src=x onerror=alert(1)>.obj")
        write(name, support.TWO_CUBES)
        self.tool = TOOL
        self.run_tool(name, "--html", self.path("t.html"), status=1)
        self.open(self.path("t.html"))
        self.assertEqual(self.run_js("document.images.length"), 0)
        self.assertIn("<img src=x", self.run_js("document.querySelector('h1').textContent"))
        self.quiet()


class Frames(PageTest):
    def test_a_page_in_a_frame_that_is_shown_later_is_drawn(self):
        page = pathlib.Path(self.make("selfintersect")).read_text()
        host = self.path("host.html")
        pathlib.Path(host).write_text(f'<iframe style="display: none; width: 600px; height: 500px" '
                                      f'srcdoc="{html.escape(page)}"></iframe>')
        self.browser.open(host)
        self.run_js("document.querySelector('iframe').style.display = 'block'")
        self.browser.settle()
        drawn = self.run_js("""new Promise((done) => requestAnimationFrame(() => {
            const { viewer } = frames[0];
            viewer.draw();
            done(viewer.pixels().reduce((n, v, i) => n + (i % 4 === 3 && v > 0), 0));
        }))""")
        self.assertGreater(drawn, 20_000)
        self.quiet()

    def test_a_page_in_a_sandbox_is_drawn_as_notebooks_have_it(self):
        page = pathlib.Path(self.make("selfintersect")).read_text()
        host = self.path("host.html")
        pathlib.Path(host).write_text('<iframe sandbox="allow-scripts" style="width: 100%; height: '
                                      '560px" '
                                      f'srcdoc="{html.escape(page)}"></iframe>')
        self.browser.open(host)
        with self.browser.in_frame():
            self.run_js(HELPERS)
            self.browser.settle()
            self.assertGreater(self.run_js("drawn(null)")["opaque"], 20_000)
            self.assertEqual(self.run_js("origin"), "null")
        self.quiet()


class Controls(PageTest):
    def differ(self, scripts):
        sums = [self.run_js(f"({script}, 0)") or self.browser.settle() or self.run_js("sum()")
                for script in scripts]
        self.assertEqual(len(set(sums)), len(sums), scripts)

    def test_six_views_and_the_oblique_one_show_different_sides(self):
        self.show("repair")
        self.differ(f"document.querySelector('[data-view={v}]').click()" for v in
                    ("front", "back", "left", "right", "top", "bottom", "oblique"))
        axes = {"front": [0, -1, 0], "right": [1, 0, 0], "top": [0, 0, 1], "left": [-1, 0, 0]}
        for name, back in axes.items():
            self.press_button("view", name)
            for a, b in zip(self.run_js("viewer.camera.axes().back"), back):
                self.assertAlmostEqual(a, b, 9)

    def test_keys_do_what_the_help_says(self):
        self.show("repair")
        before = self.run_js("sum()")
        for key in ("1", "ArrowLeft", "ArrowUp", "+", "s", "[", "e", "v", "g", "0", "-"):
            self.browser.press(key)
            now = self.run_js("sum()")
            self.assertNotEqual(now, before, key)
            before = now
        self.browser.press("?")
        self.assertGreater(self.run_js("document.querySelectorAll('.help tr').length"), 10)
        self.browser.press("Escape")
        self.assertIsNone(self.run_js("document.querySelector('.help')?.textContent ?? null"))
        color = "getComputedStyle(document.body).backgroundColor"
        self.assertEqual(self.run_js(color), "rgb(255, 255, 255)")
        self.browser.press("d")
        self.assertEqual(self.run_js(color), "rgb(22, 24, 28)")
        target = self.run_js("viewer.camera.target")
        for _ in range(3):
            self.browser.press("n")
        self.assertNotEqual(self.run_js("viewer.camera.target"), target)
        self.assertEqual(self.run_js("document.querySelector('tr.current').dataset.row"), "2")
        self.browser.press("p")
        self.assertEqual(self.run_js("document.querySelector('tr.current').dataset.row"), "1")
        self.quiet()

    def test_the_mouse_turns_shifts_zooms_and_picks(self):
        self.show("selfintersect")
        x, y = self.run_js("(() => { const r = "
                           "document.querySelector('canvas').getBoundingClientRect();"
                           "return [r.left + r.width * 0.4, r.top + r.height * 0.55]; })()")
        camera = "({ ...viewer.camera, whole: 0 })"
        first = self.run_js(camera)
        self.browser.drag(x, y, 60, 30)
        turned = self.run_js(camera)
        self.assertLess(turned["turn"], first["turn"])
        self.assertGreater(turned["tilt"], first["tilt"])
        self.assertEqual(turned["target"], first["target"])
        self.browser.drag(x, y, 60, 30, modifiers=8)
        shifted = self.run_js(camera)
        self.assertEqual(shifted["turn"], turned["turn"])
        self.assertNotEqual(shifted["target"], turned["target"])
        self.browser.wheel(x, y, -200)
        self.assertLess(self.run_js("viewer.camera.distance"), shifted["distance"])
        self.run_js("document.querySelector('[data-home]').click()")
        self.browser.settle()
        self.browser.click(x, y)
        self.assertRegex(self.run_js("document.querySelector('.picked').textContent"),
                         r"^face \d+ ")
        self.quiet()

    def test_before_after_and_wipe_show_the_same_places(self):
        self.show("repair")
        sums = {}
        for name in self.variants():
            self.press_button("variant", name)
            sums[name] = self.run_js("sum()")
        self.assertEqual(len(set(sums.values())), 4)
        for at, name in ((0, "after"), (1, "before")):
            self.run_js(f"(() => {{ const s = document.querySelector('[data-wipe]'); "
                        f"s.value = {at}; "
                        "s.dispatchEvent(new Event('input', { bubbles: true })); })()")
            self.assertEqual(self.run_js("sum()"), sums[name])

    def test_a_section_leaves_one_side_or_the_other(self):
        self.show("selfintersect")
        self.run_js("only([0])")
        whole = self.run_js("drawn(null)")["opaque"]
        for axis in "123":
            self.run_js(f"(() => {{ const s = document.querySelector('[data-section]'); "
                        f"s.value = {axis}; "
                        "s.dispatchEvent(new Event('change', { bubbles: true })); })()")
            shares = []
            for depth in (-1, 0, 1):
                self.run_js(f"document.querySelector('[data-depth]').value = {depth}")
                shares.append(self.run_js("drawn(null)")["opaque"])
            self.assertLess(shares[0], 0.02 * whole)
            self.assertTrue(0.1 * whole < shares[1] < whole, shares)
            self.assertGreater(shares[2], 0.98 * whole)
            self.run_js("document.querySelector('[data-flip]').click()")
            self.assertLess(self.run_js("drawn(null)")["opaque"], 0.02 * whole)
            self.run_js("document.querySelector('[data-flip]').click()")

    def test_rows_fly_to_their_places(self):
        page = self.make("selfintersect")
        self.open(page, "#region=0")
        self.assertEqual(self.run_js("document.querySelector('tr.current').dataset.row"), "0")
        self.browser.settle()
        for a, b in zip(self.run_js("viewer.scene.toFile(viewer.camera.target)"), [0.5, 0.125, 0]):
            self.assertLess(abs(a - b), 0.01)  # spheres of one size meet halfway
        self.run_js("document.querySelector('[data-home]').click()")
        self.browser.settle()
        whole = self.run_js("viewer.camera.distance")
        self.run_js("document.querySelector('tr[data-row]').click()")
        self.browser.settle()
        self.assertNotEqual(self.run_js("viewer.camera.distance"), whole)

    def test_what_was_found_is_seen_through_what_hides_it(self):
        self.show("selfintersect")
        before = self.run_js("drawn(1)")["own"]
        self.run_js("document.querySelector('[data-glass]').click()")
        self.assertGreater(self.run_js("drawn(1)")["own"], 1.2 * before)

    def test_every_switch_changes_what_is_seen(self):
        kinds = {"class", "glass", "edges", "labels", "up", "map", "band", "flip"}
        changing = set()
        for name in ("repair", "selfintersect", "band", "slide"):
            self.show(name)
            self.run_js("(() => { const s = document.querySelector('[data-section]'); s.value = 1;"
                        "s.dispatchEvent(new Event('change', { bubbles: true })); })()")
            for at, kind in enumerate(self.run_js("[...document.querySelectorAll('#view "
                                                  "[type=checkbox]')]"
                                                  ".map(i => Object.keys(i.dataset)[0])")):
                state = "[sum(), document.querySelector('.tags').textContent].join()"
                press = f"document.querySelectorAll('#view [type=checkbox]')[{at}].click()"
                before = self.run_js(state)
                self.run_js(press)
                self.browser.settle()
                if self.run_js(state) != before:
                    changing.add(kind)
                self.run_js(press)
                self.browser.settle()
                self.assertEqual(self.run_js(state), before, (name, kind))
            self.quiet()
        self.assertEqual(changing, kinds)

    def test_every_control_is_used_without_a_complaint(self):
        for name in PAGES:
            with self.subTest(page=name):
                self.show(name)
                count = self.run_js("""(() => {
                    let used = 0;
                    for (const button of document.querySelectorAll('#view button')) {
                        button.click();
                        ++used;
                    }
                    for (const input of document.querySelectorAll('#view input, #view select')) {
                        if (input.type === 'checkbox') { input.click(); input.click(); }
                        else if (input.tagName === 'SELECT') { input.selectedIndex = 2; }
                        else { input.value = 0.3; }
                        input.dispatchEvent(new Event('input', { bubbles: true }));
                        input.dispatchEvent(new Event('change', { bubbles: true }));
                        ++used;
                    }
                    document.querySelectorAll('tr[data-row]').forEach(
                        (row) => { row.click(); ++used; });
                    viewer.draw();
                    return used;
                })()""")
                self.assertGreater(count, 12)
                self.browser.settle()
                self.quiet()


class Framing(PageTest):
    def test_long_rods_begin_where_they_meet(self):
        rods = together(rod((-500, 0, 0), (1000, 1, 1)), rod((0.3, -500, 0.3), (1, 1000, 1)))
        write(self.path("rods.obj"), rods)
        self.tool = TOOL
        self.run_tool("rods.obj", "--html", self.path("rods.html"), status=1)
        self.open(self.path("rods.html"))
        near = self.run_js("drawn(null)")["opaque"]
        self.run_js("document.querySelector('[data-home]').click()")
        self.browser.settle()
        self.assertGreater(near, 10 * self.run_js("drawn(null)")["opaque"])

    def test_a_whole_model_fills_the_view(self):
        for name in ("selfintersect", "weld", "pack"):
            self.show(name)
            rows = self.run_js("""(() => {
                viewer.draw();
                const p = viewer.pixels(), c = document.querySelector('canvas');
                let low = c.height, high = 0, left = c.width, right = 0;
                for (let i = 0; i < p.length; i += 4) if (p[i + 3]) {
                    const x = i / 4 % c.width, y = Math.floor(i / 4 / c.width);
                    low = Math.min(low, y); high = Math.max(high, y);
                    left = Math.min(left, x); right = Math.max(right, x);
                }
                return [low, c.height - 1 - high, left, c.width - 1 - right, c.height];
            })()""")
            self.assertGreater(min(rows[:4]), 0, name)
            self.assertLess(rows[0] + rows[1], 0.5 * rows[4], name)

    def test_coordinates_may_be_huge_or_far_away(self):
        self.tool = TOOL
        for name, scale, shift in (("huge.obj", 1e300, 0), ("far.obj", 1, 4512345.25)):
            points, faces = support.TWO_CUBES
            write(self.path(name), ([tuple(scale * v + shift for v in p) for p in points], faces))
            self.run_tool(name, "--html", self.path("page.html"), "-f", status=1)
            self.open(self.path("page.html"))
            self.assertGreater(self.run_js("drawn(null)")["opaque"], 20_000)
            self.run_js("viewer.pick(...project(viewer.scene.toFile([0, 0, 0])))")
            self.assertRegex(self.run_js("document.querySelector('.picked').textContent"),
                             r"^face \d+ ")
            self.quiet()

    def test_much_context_is_thinned_out_and_findings_never(self):
        write(self.path("big.stl"), together(support.grid(350), support.grid(40, 0.5),
                                             rod((3.2, 3.2, -1), (0.5, 0.5, 3))))
        self.tool = TOOL
        report = self.report("big.stl", "--html", self.path("big.html"), status=1)["files"][0]
        self.open(self.path("big.html"))
        mesh = "viewer.scene.meshes[0]"
        self.assertEqual(self.run_js(f"{mesh}.kinds.filter((k, i) => i % 3 === 0 && k > 0).length"),
                         report["faces_hit"])
        self.assertLessEqual(self.run_js(f"{mesh}.faces"), 200_000 + report["faces_hit"])
        self.assertIn("Not drawn", self.run_js("document.body.textContent"))
        self.quiet()


if __name__ == "__main__":
    support.main()
