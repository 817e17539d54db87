"""Every option of tf-weld in tiles on the disk: the bytes, maps and reports that memory gives."""

from weld_support import *

import random

COLUMNS = "<dddBfqd"
HEAD = ("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty double x\nproperty "
        "double y\n"
        "property double z\nproperty uchar kind\nproperty float shade\nproperty int64 stamp\n"
        "property double range\nend_header\n")
NAN = float("nan")


def families(rng, count):
    """Clouds that are hard in one way each."""
    unit = lambda scale=1.0: tuple(scale * rng.random() for _ in range(3))
    yield "uniform", [unit() for _ in range(count)]
    yield "lattice", [tuple(0.05 * rng.randrange(12) for _ in range(3)) for _ in range(count)]
    yield "heap", [(0.5, 0.5, 0.5) if i % 3 else unit() for i in range(count)]
    yield "crowd", [unit(0.06) if i % 2 else unit() for i in range(count)]
    yield "line", sorted((3 * rng.random(), 0.001 * rng.random(), 0.0) for _ in range(count))
    yield "plane", [(rng.random(), rng.random(), 0.25) for _ in range(count)]
    yield "broken", [(NAN, 0.0, 1.0) if i % 50 == 0 else
                     (-0.0, 0.0, i % 7 * 0.1) if i % 9 == 0 else unit() for i in range(count)]


def ply(points, rng):
    rows = b"".join(struct.pack(COLUMNS, *p, rng.randrange(3),
                                NAN if rng.random() < 0.05 else rng.randrange(4) * 0.25,
                                (1 << 60) + rng.randrange(3),
                                rng.choice((0.0, -0.0, 1.5, -2.0, NAN)))
                    for p in points)
    return (HEAD % len(points)).encode() + rows


RULES = ("first", "chain")
CONDITIONS = ([], ["--same", "kind"], ["--same", "kind,stamp"], ["--same", "shade=0.25"],
              ["--same", "kind,range=1.5,x=0.04"])
CHOICES = ([], ["--order", "range"], ["--order", "max:stamp"], ["--order", "z"],
           ["--keep", "last"], ["--keep", "mean"], ["--keep", "min:range"], ["--keep", "max:stamp"])


class Tiles(WeldTest):
    def setUp(self):
        super().setUp()
        self.rng = random.Random(4)

    def check(self, *command, size, out="out.ply",
              also=("--removed", "gone.ply", "--map", "map.csv")):
        """Whether all that the command writes is the same in memory and in tiles."""
        found = []
        for tiled in ([], ["--tile-points", size]):
            entry = self.entry(*command, "-o", out, *also, "-f", *tiled, status=0)
            entry["tiles"] = 0
            found.append([entry] + [self.read_bytes(n) for n in (out, *also[1::2])])
            for name in (out, *also[1::2]):
                os.remove(self.path(name))
        self.assertEqual(found[0][0], found[1][0])
        for memory, tiles in zip(found[0][1:], found[1][1:]):
            self.assertTrue(memory == tiles, msg=f"bytes differ: {command}")
        self.assertFalse(any("tiles" in n for n in self.listing()))
        return found[0][0]

    def test_orders_choices_and_conditions_give_the_bytes_that_memory_gives(self):
        options = [(r, c, w) for r in RULES for c in CONDITIONS for w in CHOICES]
        self.rng.shuffle(options)
        for name, points in families(self.rng, 700):
            self.write("in.ply", ply(points, self.rng))
            for rule, same, which in options[:len(options) // 7 + 4]:
                tolerance, size = self.rng.choice((("0", 60), ("0.03", 90), ("0.1", 50),
                                                   ("3%", 300)))
                with self.subTest(family=name, rule=rule, same=same, which=which, t=tolerance):
                    self.check("in.ply", "-t", tolerance, "--rule", rule, *same, *which, size=size)
            options = options[len(options) // 7:] + options[:len(options) // 7]

    def test_coordinates_get_the_types_that_memory_gives_them(self):
        rng = self.rng
        quarter = lambda: rng.randrange(40) / 4
        clouds = {
            "some.ply": ("float float float", [(round(10 * rng.random(), 4), quarter(), 0)
                                               for _ in range(900)]),
            "whole.ply": ("int float short", [(rng.randrange(20), quarter(), rng.randrange(3))
                                              for _ in range(900)]),
            # What has more digits goes, or stays.
            "last.ply": ("float float float", [(0, 0, 0), *((quarter(), quarter(), 0)
                                                            for _ in range(900)), (0.1, 0.1, 0.1)]),
            "first.ply": ("float float float", [(0.1, 0.1, 0.1), *((quarter(), quarter(), 0)
                                                                   for _ in range(900)),
                                                (0, 0, 0)]),
        }
        for name, (types, rows) in clouds.items():
            self.write(name, ply_text([f"{t} {a}" for t, a in zip(types.split(), "xyz")], rows))
        inputs = [[name] for name in clouds]
        inputs += [["some.ply", "last.ply", "--join"], ["whole.ply", "some.ply", "--join"]]
        for command in inputs:
            for keep in ("first", "mean"):
                for out, gone in (("out.ply", "gone.pcd"), ("out.pcd", "gone.ply"),
                                  ("out.las", "gone.ply")):
                    for text in ([], ["--ascii"]):
                        weld = [*command, "-t", "0.3", "--keep", keep, *text]
                        self.check(*weld, size=200, out=out, also=("--removed", gone))
        for name in () if NO_MPI else clouds:
            self.run_tool(name, "-t", "0.3", "-o", "memory.ply", "-f", status=0)
            self.mpi(3, name, "-t", "0.3", "--tile-points", 200, "-o", "out.ply", "-f")
            self.assertEqual(self.read_bytes("memory.ply"), self.read_bytes("out.ply"))

    def test_labels_and_flags_are_those_of_memory(self):
        self.write("in.ply", ply(list(families(self.rng, 600))[0][1], self.rng))
        self.run_tool("in.ply", "-o", "in.las", status=0)
        for rule in RULES:
            for which in ([], ["--order", "max:range"], ["--same", "kind"]):
                command = ["-t", "0.06", "--rule", rule, *which]
                self.check("in.ply", *command, "--label", "group", size=80,
                           also=("--map", "map.bin"))
                self.check("in.las", *command, "--label", "group", size=80, out="out.laz", also=())
                entry = self.check("in.las", *command, "--withhold", size=80, out="out.las",
                                   also=())
                self.assertGreater(entry["withheld"], 10)

    def test_any_number_of_files_is_one_cloud(self):
        points = list(families(self.rng, 900))[3][1]
        for i in range(9):
            self.write(f"{i}.ply", ply(points[100 * i:100 * i + 100], self.rng))
        self.write("none.ply", ply([], self.rng))
        names = [f"{i}.ply" for i in range(5)] + ["none.ply"] + [f"{i}.ply" for i in range(5, 9)]
        for rule in RULES:
            for which in ([], ["--order", "range"], ["--keep", "mean"], ["--same", "kind"]):
                entry = self.check(*names, "--join", "-t", "0.05", "--rule", rule, *which, size=110)
                self.assertEqual([s["points"] for s in entry["sources"]],
                                 5 * [100] + [0] + 4 * [100])

    def test_files_with_other_columns_and_formats_are_joined_as_in_memory(self):
        points = [tuple(round(64 * x) / 64 for x in p) for p in list(families(self.rng, 400))[0][1]]
        self.write("a.ply", ply(points[:150], self.rng))
        self.write("b.ply", ply_text(["float x", "float y", "float z", "int kind", "float more"],
                                     [(*p, i % 3 - 1, i) for i, p in enumerate(points[150:300])]))
        self.cloud("c.xyz", points[300:])
        for names in (["a.ply", "b.ply", "c.xyz"], ["c.xyz", "a.ply"], ["b.ply", "c.xyz", "b.ply"]):
            for which in ([], ["--same", "kind"] if "a.ply" in names else []):
                entry = self.check(*names, "--join", "-t", "0.05", *which, size=70)
                self.assertIn("missing-property", [w["code"] for w in entry["warnings"]])

    def test_las_of_other_steps_is_rounded_before_anything_is_decided(self):
        points = list(families(self.rng, 500))[0][1]
        self.write("a.ply", ply([tuple(round(100 * x) / 100 for x in p) for p in points[:250]],
                                self.rng))
        self.write("b.ply", ply([tuple(round(1000 * x) / 1000 for x in p) for p in points[250:]],
                                self.rng))
        for name in "ab":
            self.run_tool(f"{name}.ply", "-o", f"{name}.las", status=0)
        for which in ([], ["--keep", "mean"], ["--order", "x"]):
            self.check("a.las", "b.las", "--join", "-t", "0.05", *which, size=70,
                       out="out.las", also=("--removed", "gone.laz"))
            entry = self.check("a.las", "b.las", "--join", "-t", "0.05", *which, "--las-scale",
                               "0.02", size=70, out="out.las", also=("--removed", "gone.laz"))
            self.assertIn("las-grid", [w["code"] for w in entry["warnings"]])
        self.check("a.las", "b.las", "--join", "-t", "0.05", size=70,
                   also=("--removed", "gone.csv"))

    def to_las(self, name, *which, size=70, removed="gone.ply"):
        return self.check(name, "-t", "0.05", *which, size=size, out="out.las",
                          also=("--removed", removed, "--map", "map.csv"))

    def test_las_of_other_formats_has_the_steps_that_memory_chooses(self):
        draw = lambda scale, digits: [tuple(round(scale * self.rng.random(), digits)
                                            for _ in range(3)) for _ in range(400)]
        shifted = lambda points, by: [tuple(x + by for x in p) for p in points]
        exact = {"coarse": draw(3, 2), "fine at last": draw(3, 1) + draw(3, 5)[:40] + draw(3, 3),
                 "none": list(families(self.rng, 400))[3][1],
                 "beyond 32 bits": draw(1e7, 3) + draw(1, 6), "far": shifted(draw(1, 3), 4e9),
                 "huge": shifted(draw(1e13, 0), 1e15), "one": 70 * [(0.1, 0.25, -3.0)],
                 "tiny": [tuple(1e-9 * x for x in p) for p in draw(1, 6)]}
        moved = {}
        for name, points in exact.items():
            self.rng.shuffle(points) if name != "fine at last" else None
            self.write("in.ply", ply(points, self.rng))
            for which in ([], ["--keep", "mean"], ["--order", "z"]):
                with self.subTest(name=name, which=which):
                    entry = self.to_las("in.ply", *which)
                    moved[name] = "las-grid" in [w["code"] for w in entry["warnings"]]
        self.assertTrue(moved["none"] and moved["huge"])

    def test_las_of_floats_and_texts_is_that_of_memory(self):
        for digits in (1, 3, 9):  # steps of floats are floats, or not
            points = [tuple(round(x, digits) for x in p)
                      for p in list(families(self.rng, 500))[0][1]]
            points += [(p[0] + 3, 0.5, 1.0) for p in points[:20]]
            rows = [(*p, i % 3, i % 7) for i, p in enumerate(points)]
            self.write("in.ply", ply_text(["float x", "float y", "float z", "uchar return_number",
                                           "float shade"], rows))
            self.cloud("in.xyz", points)
            for which in ([], ["--keep", "mean"], ["--rule", "chain"]):
                for name in ("in.ply", "in.xyz"):
                    self.to_las(name, *which)
                    self.to_las(name, *which, removed="gone.laz")
            self.check("in.ply", "-t", "0.05", "--label", "group", size=80, out="out.laz", also=())
            self.check("in.ply", "-t", "0.05", "--withhold", size=80, out="out.las", also=())

    def test_las_has_the_format_that_holds_what_is_written(self):
        points = [(0.25 * (i // 2), 0.0, 0.0) for i in range(200)]  # pairs
        for rank in (0, 1):
            values = [40 if i == 2 * 50 + rank else i % 30 for i in range(200)]
            self.write("in.ply", ply_text(["double x", "double y", "double z",
                                           "uchar classification"],
                                          [(*p, v) for p, v in zip(points, values)]))
            formats = []
            for which in ([], ["--keep", "last"], ["--keep", "max:classification"],
                          ["--order", "min:classification"]):
                entry = self.to_las("in.ply", *which, size=30, removed="gone.las")
                self.run_tool("in.ply", "-t", "0.05", *which, "--tile-points", 30, "-o", "out.las",
                              "-f", status=0)
                formats.append(self.read_bytes("out.las")[104])
            self.assertEqual(formats, [[6, 0, 6, 0], [0, 6, 6, 0]][rank])
            self.check("in.ply", "-t", "0.05", "--label", "classification", size=30, out="out.las",
                       also=())

    def test_what_the_format_has_no_place_for_counts_when_points_are_looked_at_again(self):
        points = [tuple(round(2 * self.rng.random(), 3) for _ in range(3)) for _ in range(600)]
        rows = [(*p, self.rng.randrange(2)) for p in points]
        self.write("in.ply", ply_text([*XYZ, "uchar kind"], rows))
        for keep in ("mean", "max:z"):
            entry = self.check("in.ply", "-t", "0.3", "--same", "kind", "--keep", keep, size=90,
                               out="out.xyz", also=())
            self.assertGreater(entry["output"]["within_tolerance"], 0)

    def test_values_count_as_in_the_input_when_points_are_looked_at_again(self):
        places = [(0.1 * i, 0.1 * j, 0.1 * k) for i in range(8) for j in range(8) for k in range(4)]
        rows = [(*p, self.rng.choice(("0", "0.1", "0.2", "0.3"))) for p in places]
        self.write("in.ply", ply_text([*XYZ, "float kind"], rows))
        for keep in ("mean", "last", "max:z"):  # text has no floats, and other ties
            self.check("in.ply", "-t", "0.1", "--same", "kind=0.1", "--keep", keep, size=60,
                       out="out.csv", also=())

    def test_rounding_to_float_is_looked_at_again(self):
        points = [(1e5 + x, y, z) for x, y, z in list(families(self.rng, 500))[0][1]]
        self.write("in.ply", ply(points, self.rng))
        entry = self.check("in.ply", "-t", "0.08", "--precision", "float", size=80, also=())
        self.assertGreater(entry["output"]["within_tolerance"], 0)
        entry = self.check("in.ply", "-t", "0.1", "--keep", "mean", size=80, also=())
        self.assertGreater(entry["output"]["within_tolerance"], 0)

    def test_a_folder_that_is_left_or_of_no_use_is_named(self):
        self.write("in.ply", ply(list(families(self.rng, 300))[0][1], self.rng))
        os.symlink("/dev/full", self.path("full.ply"))
        command = ["in.ply", "-t", "0.05", "--tile-points", 50, "--work", "tiles"]
        run = self.run_tool(*command, "-o", "full.ply", status=4)
        self.assertIn("tiles: contains the tiles; the same command resumes", run.err)
        run = self.run_tool(*command, "-o", "full.ply", "-v", status=4)
        self.assertIn("finished earlier", run.err)
        run = self.run_tool(*command, "-o", "full.ply", "--order", "z", status=4)
        self.assertIn("are not of this input and these options", run.err)
        self.run_tool(*command, "-o", "out.ply", status=0)
        self.assertEqual(self.listing(), ["full.ply", "in.ply", "out.ply"])
        run = self.run_tool(*command[:3], "--work", "tiles", "-o", "out.ply", "-f", status=0)
        self.assertIn("--work is not used", run.err)
        self.write("cube.obj", obj_bytes(cube()))
        for option in (["--tile-points", 2], ["--work", "tiles"]):
            entry = self.entry("cube.obj", *option, "-n", status=0)
            self.assertIn("in-memory", [w["code"] for w in entry["warnings"]])
            self.assertIsNone(entry["tiles"])

    def test_what_is_wrong_with_a_property_is_said_as_in_memory(self):
        self.write("in.ply", ply([(0.0, 0.0, float(i)) for i in range(40)], self.rng))
        for option, value in (("--same", "none"), ("--order", "none"), ("--keep", "min:none"),
                              ("--ignore-seams", "none")):
            said = [self.run_tool("in.ply", option, value, "-o", "out.ply", *tiled, status=3).err
                    for tiled in ([], ["--tile-points", 10])]
            self.assertEqual(*said)
            self.assertEqual(self.listing(), ["in.ply"])


if __name__ == "__main__":
    main()
