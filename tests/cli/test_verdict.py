"""Verdicts, kinds, and the options that say what counts."""

from support import *


class Verdict(ToolTest):
    def model(self, mesh, name="part.obj"):
        return write(self.path(name), mesh)

    def kinds(self, mesh, *options, name="part.obj"):
        counts = self.counts(self.model(mesh, name), *options)
        return {kind: n for kind, n in counts.items() if n}

    def test_a_clean_mesh_is_0_and_says_so(self):
        run = self.run_tool(self.model(CLEAN), status=0)
        self.assertEqual(run.text, f"{self.path('part.obj')}: no self-intersections in 12 faces\n")
        self.assertEqual(run.err, "")

    def test_a_crossing_is_1_and_told_in_words(self):
        run = self.run_tool(self.model(CROSSING), status=1)
        self.assertEqual(run.text, f"{self.path('part.obj')}: 1 self-intersecting pair of 2 faces: "
                                   "1 crossing, in 1 region\n")

    def test_every_kind_is_told_apart(self):
        self.assertEqual(self.kinds(CROSSING, "--touching"), {"crossing": 1})
        self.assertEqual(self.kinds(OVERLAP, "--touching"), {"overlap": 1})
        self.assertEqual(self.kinds(FOLD, "--touching"), {"fold": 1})
        self.assertEqual(self.kinds(DUPLICATE, "--touching"), {"duplicate": 1})
        self.assertEqual(self.kinds(PIERCE, "--touching"), {"pierce": 1})
        self.assertEqual(self.kinds(TOUCHING, "--touching"), {"touching": 1})
        self.assertEqual(self.kinds(DEGENERATE, "--touching"), {"degenerate": 1})

    def test_touching_counts_only_when_asked_for(self):
        part = self.model(TOUCHING)
        self.run_tool(part, status=0)
        self.run_tool(part, "--touching", status=1)
        self.assertIsNone(self.counts(part)["touching"])
        self.assertEqual(self.counts(part, "--touching")["touching"], 1)

    def test_degenerate_pairs_are_counted_apart(self):
        part = self.model(DEGENERATE)
        run = self.run_tool(part, status=0)
        self.assertIn("1 pair with a degenerate face not counted", run.text)
        entry = self.report(part, status=0)["files"][0]
        self.assertEqual(entry["pairs"]["degenerate"], 1)
        self.assertEqual(entry["skipped"]["degenerate"], 1)
        self.assertEqual((entry["list"], entry["regions"], entry["faces_hit"]), ([], [], 0))
        self.run_tool(part, "--touching", status=1)

    def test_no_overlap_leaves_out_what_is_coplanar(self):
        for mesh in (OVERLAP, FOLD, DUPLICATE):
            part = self.model(mesh)
            self.run_tool(part, status=1)
            self.run_tool(part, "--no-coplanar", status=0)
        self.run_tool(self.model(CROSSING), "--no-coplanar", status=1)
        self.assertIsNone(self.counts(self.model(FOLD), "--no-coplanar")["fold"])

    def test_between_and_within_split_the_pairs(self):
        mesh = together(PIERCE, ([(2, 0.5, -1), (2, 0.5, 1), (3, 0.5, 1)], [(0, 1, 2)]))
        part = self.model(mesh)
        whole = self.counts(part)
        between = self.counts(part, "--between")
        within = self.counts(part, "--within")
        self.assertEqual((whole["crossing"], whole["pierce"]), (1, 1))
        self.assertEqual((between["crossing"], between["pierce"]), (1, 0))
        self.assertEqual((within["crossing"], within["pierce"]), (0, 1))
        self.run_tool(part, "--between", "--within", status=2)

    def test_corners_of_stl_are_one_where_they_are_equal(self):
        self.run_tool(self.model(CLEAN, "part.stl"), "--touching", status=0)
        run = self.run_tool(self.path("part.stl"), "--touching", "--vertices", "file", status=1)
        self.assertIn("touching", run.text)

    def test_corners_of_obj_are_one_where_their_numbers_are(self):
        points, faces = CLEAN
        soup = ([points[c] for f in faces for c in f],
                [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(len(faces))])
        part = self.model(soup)
        self.run_tool(part, "--touching", status=1)
        self.run_tool(part, "--touching", "--vertices", "equal", status=0)
        self.run_tool(part, "--vertices", "none", status=2)

    def test_the_tolerance_is_inclusive_and_joins_corners(self):
        gap = 0.25  # exact in binary
        points, faces = grid(1)
        apart = ([points[0], points[1], points[3], (gap, 0.0, 0.0), points[3], points[2]],
                 [(0, 1, 2), (3, 4, 5)])
        part = self.model(apart)
        found = self.counts(part, "--touching", "--vertices", "equal")
        self.assertEqual(sum(n or 0 for n in found.values()), 1)
        self.run_tool(part, "--touching", "-t", gap, status=0)
        entry = self.report(part, "-t", gap)["files"][0]
        self.assertEqual(entry["tolerance"], {"given": "0.25", "used": 0.25, "joined": 1})
        below = self.report(part, "-t", "0.2499999999999999")["files"][0]
        self.assertEqual(below["tolerance"]["joined"], 0)

    def test_a_tolerance_in_percent_is_a_share_of_the_diagonal(self):
        part = self.model(([(0, 0, 0), (3, 0, 0), (0, 4, 0)], [(0, 1, 2)]))
        used = self.report(part, "-t", "10%", status=0)["files"][0]["tolerance"]["used"]
        self.assertAlmostEqual(used, 0.5, places=15)
        for alias in ("--eps", "--threshold", "--tolerance"):
            self.run_tool(part, alias, "0.5", status=0)
        for bad in ("-1", "x", "1mm", "nan", "inf", "", "5%%"):
            self.run_tool(part, "-t", bad, status=2)

    def test_nearly_equal_corners_are_hinted_at(self):
        points, faces = FOLD
        part = self.model((points + [(4, 1e-9, 0)], faces + [(0, 4, 2)]))
        warnings = self.report(part)["files"][0]["warnings"]
        self.assertEqual([w["code"] for w in warnings], ["near-corners"])

    def test_a_hint_says_which_tolerance_closes_the_surface(self):
        points, faces = cube()
        def hint(gap):  # a cube in a cube that is open by `gap` along a corner
            apart = [tuple(x + gap * (p == points[7]) for x in p) for p in points]
            odd = (points + [apart[7]], [tuple(8 if c == 7 and f == faces[11] else c for c in f)
                                         for f in faces])
            part = self.model(together(odd, cube((0.5, 0.5, 0.5))))
            entry = self.report(part)["files"][0]
            return part, [w["text"] for w in entry["warnings"]]
        for gap, step in ((1e-6, "0.0001%"), (1e-5, "0.001%"), (1e-4, "0.01%")):
            part, texts = hint(gap)
            self.assertEqual(len(texts), 1)
            self.assertTrue(texts[0].startswith("1 vertex lies within "), msg=texts[0])
            self.assertTrue(texts[0].endswith(f"; -t {step} joins them and closes the surface"))
            self.run_tool("--repair", part, "-t", step, "-n", status=0)
            self.run_tool("--repair", part, "-n", status=1)
        self.assertEqual(hint(1e-3)[1], [])
        # What is open for another reason is not said to become closed.
        fold = self.model((FOLD[0] + [(4, 1e-9, 0)], FOLD[1] + [(0, 4, 2)]))
        warning, = self.report(fold)["files"][0]["warnings"]
        self.assertTrue(warning["text"].endswith("; -t 0.0001% joins them"))

    def test_the_box_takes_the_faces_that_meet_it(self):
        part = self.model(together(CROSSING, ([(p[0] + 100, p[1], p[2]) for p in CROSSING[0]],
                                              CROSSING[1])))
        self.assertEqual(self.counts(part)["crossing"], 2)
        self.assertEqual(self.counts(part, "--box", "-1,-1,-2,50,5,2")["crossing"], 1)
        self.assertEqual(self.counts(part, "--box", "40,0,0,50,1,1")["crossing"], 0)
        # a face whose box overlaps the given one, but which passes by its corner
        self.assertEqual(self.report(part, "--box", "3.5,3.5,0,4,4,0")["files"][0]["searched"], 0)
        self.assertEqual(self.report(part, "--box", "2,2,0,4,4,0")["files"][0]["searched"], 1)
        for bad in ("1,2,3", "0,0,0,-1,1,1", "a,b,c,d,e,f", "0,0,0,1,1,1,"):
            self.run_tool(part, "--box", bad, status=2)

    def test_first_stops_at_one(self):
        part = self.model(TWO_CUBES)
        run = self.run_tool(part, "--first", status=1)
        self.assertIn("stopped at the first", run.text)
        entry = self.report(part, "--first")["files"][0]
        self.assertEqual((entry["listed"], entry["complete"]), (1, False))
        self.assertTrue(self.report(part)["files"][0]["complete"])
        self.assertTrue(self.report(self.model(CLEAN), "--first")["files"][0]["complete"])

    def test_the_limit_shortens_the_list_and_nothing_else(self):
        part = self.model(TWO_CUBES)
        whole = self.report(part)["files"][0]
        short = self.report(part, "--limit", "3")["files"][0]
        self.assertEqual(short["list"], whole["list"][:3])
        self.assertEqual((short["listed"], short["truncated"]), (3, True))
        self.assertEqual((whole["listed"], whole["truncated"]), (len(whole["list"]), False))
        for key in ("pairs", "regions", "faces_hit"):
            self.assertEqual(short[key], whole[key])
        self.run_tool(part, "--limit", "-1", status=2)

    def test_faces_that_are_not_finite_are_left_out_and_counted(self):
        points, faces = CROSSING
        mesh = (points + [(float("nan"), 0.0, 0.0)], [(0, 1, 6)] + faces)
        part = self.path("part.stl")
        write(part, mesh)
        entry = self.report(part, status=1)["files"][0]
        self.assertEqual(entry["skipped"]["non_finite"], 1)
        self.assertEqual(entry["list"], [[1, 2, "crossing", 0]])  # numbers of the file
        self.assertEqual([w["code"] for w in entry["warnings"]][:1], ["non-finite"])

    def test_exit_zero_gives_0_for_found_only(self):
        self.run_tool(self.model(CROSSING), "--exit-zero", status=0)
        self.run_tool(self.path("missing.obj"), "--exit-zero", status=3)

    def test_polygons_keep_the_face_numbers_of_the_file(self):
        text = ("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 3 3 -1\nv 3 3 1\nv 4 3 1\n"
                "f 1 2 3 4\nf 5 6 7\n")
        with open(self.path("quad.obj"), "w") as file:
            file.write(text)
        entry = self.report("quad.obj", status=1)["files"][0]
        self.assertEqual((entry["faces"], entry["triangles"]), (2, 3))
        self.assertTrue(all(pair[:2] == [0, 1] for pair in entry["list"]))


if __name__ == "__main__":
    main()
