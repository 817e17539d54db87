"""The same coordinates, numbers and bytes as the tools have."""

import csv
import json
import subprocess

import numpy as np
import pytest

import treeform as tf
from support import CUBE, model, moved, needs_models, run_tool, soup, sphere, tool

ROUND = tf.read("data/sphere.ply")
PARTS = {"ball": moved(ROUND, 0.3, 0.2, 6), "near": moved(ROUND, 0.02, 0.01, 0.03),
         "inside": moved(CUBE, 0.3, 0.2, 0.4), "side": moved(CUBE, 3, 0.2, 0.4),
         "turned": tf.Mesh(ROUND.vertices[:, [1, 2, 0]] * [1, 2, 3], ROUND.faces), "cube": CUBE}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("parts")
    for name, mesh in PARTS.items():
        tf.write(made / f"{name}.off", mesh)
    return made


def by_largest_planes(a, b, **options):
    return tf.mate_features(a, b, tf.find_features(a)[0], tf.find_features(b)[0], **options)


PLACES = [
    ("drop", "ball", None, "", lambda a, b: tf.drop(a)),
    ("drop", "ball", "cube", "", tf.drop),
    ("slide", "ball", "cube", "-d 0,0,-1", lambda a, b: tf.slide(a, b, [0, 0, -1])),
    ("slide", "side", "ball", "-d -1,0,2 --clearance 0.03",
     lambda a, b: tf.slide(a, b, [-1, 0, 2], 0.03)),
    ("mate", "ball", "cube", "", tf.mate),
    ("mate", "ball", "cube", "--clearance 0.1", lambda a, b: tf.mate(a, b, clearance=0.1)),
    ("lay", "turned", None, "-t 0", lambda a, b: tf.lay_flat(a)),
    ("separate", "inside", "cube", "", tf.separate),
    ("separate", "inside", "near", "--clearance 0.2", lambda a, b: tf.separate(a, b, 0.2)),
    ("turn", "side", "cube", "--axis 0,0,1 --origin 2,0,0",
     lambda a, b: tf.turn(a, b, [0, 0, 1], [2, 0, 0])),
    ("turn", "side", "cube", "--axis 0,1,1 --origin 2,-1,0 --clearance 0.1",
     lambda a, b: tf.turn(a, b, [0, 1, 1], [2, -1, 0], clearance=0.1)),
    ("mate", "side", "cube", "--feature plane", by_largest_planes),
    ("mate", "side", "cube", "--feature plane --clearance 0.25 --flip",
     lambda a, b: by_largest_planes(a, b, clearance=0.25, flip=True)),
    ("align", "near", "cube", "", tf.align),
    ("align", "turned", "near", "--scale --overlap 0.9 --starts 4 --metric point --weights welsch",
     lambda a, b: tf.align(a, b, scale=True, overlap=0.9, starts=4, method="point_to_point",
                           robust=True)),
]


@pytest.mark.parametrize("mode, moving, fixed, options, verb", PLACES)
def test_places_are_those_of_the_tool(folder, mode, moving, fixed, options, verb):
    against = [] if fixed is None else ["--fixed", folder / f"{fixed}.off"]
    report = run_tool("tf-place", mode, folder / f"{moving}.off", *against, *options.split(),
                      "-o", folder / "tool.off", "--precision", "double")["files"][0]
    made = verb(PARTS[moving], PARTS.get(fixed))
    tf.write(folder / "own.off", made.mesh)
    assert (folder / "tool.off").read_bytes() == (folder / "own.off").read_bytes()
    assert made.matrix.tolist() == report["matrix"]
    if mode == "align":
        found = report["align"]
        for name in ("rms", "overlap", "iterations", "best_start", "scale", "inliers"):
            assert getattr(made, name) == found[name]
    elif mode != "lay":
        assert made.relation.replace("_", "-") == report["status"]
        assert made.contact_count == report["contact_count"]


@pytest.mark.parametrize("options, named", [
    ("--size 5,5", {}), ("--size 3,3 --plates 3 --spacing 0.5", {"plates": 3, "spacing": 0.5}),
    ("--size 6,6,6 --rotate 45 --seed 7", {"turns": 8, "seed": 7, "stack": True})])
def test_plates_are_those_of_the_tool(folder, options, named):
    names = ["inside", "side", "ball", "cube"]
    report = run_tool("tf-place", "pack", *options.split(), *[folder / f"{n}.off" for n in names],
                      "-o", folder / "plates.off", "--precision", "double")["files"][0]
    size = [float(number) for number in options.split()[1].split(",")]
    step = [size[0] * 1.2, 0, 0]
    made = tf.pack([PARTS[n] for n in names], size, plate_step=step, **named)
    assert (made.plates_used, made.tries, made.density) == (
        report["plates"], report["tries"], report["density"])
    for mine, theirs in zip(made.parts, report["parts"], strict=True):
        assert (mine.placed, mine.plate) == (theirs["placed"], theirs["plate"])
        assert mine.matrix.tolist() == theirs["matrix"]


@pytest.mark.parametrize("moving, fixed", [
    ("ball", "cube"), ("inside", "cube"), ("side", "cube"), ("near", "inside"), ("cube", "near")])
def test_measures_are_those_of_the_tool(folder, moving, fixed):
    report = run_tool("tf-place", "measure", folder / f"{moving}.off", "--fixed",
                      folder / f"{fixed}.off", "--distances", folder / "distances.ply",
                      "--tolerance-band=-0.1,0.1")["files"][0]
    a, b = PARTS[moving], PARTS[fixed]
    made = tf.measure(a, b)
    assert (made.relation, made.distance, made.surface_distance) == (
        report["status"], report["distance"], report["surface_distance"])
    assert tf.distance(a, b) == tf.closest_pair(a, b).distance == made.surface_distance
    for mine, face, theirs in ((made.on_a, made.face_a, report["closest"]["moving"]),
                               (made.on_b, made.face_b, report["closest"]["fixed"])):
        assert (mine.tolist(), face) == (theirs["point"], theirs["face"])
    if report["depth"]:
        depth, move, effort = tf.penetration_depth(a, b)
        assert effort._asdict() == report["depth"]["effort"]
        assert (depth, move.tolist()) == (report["depth"]["bound"], report["depth"]["move"])
    own, theirs = tf.deviation(a, b, band=(-0.1, 0.1)), report["deviation"]
    for name in ("mean", "mean_absolute", "rms", "p50", "p95", "p99", "max", "lowest", "highest"):
        assert getattr(own, name) == theirs[name], name
    hausdorff, band = theirs["hausdorff"], theirs["tolerance_band"]
    assert hausdorff == {"forward": {"sampled": own.max, "bound": own.max_bound},
                         "backward": {"sampled": own.reverse_max, "bound": own.reverse_max_bound}}
    assert own.band_counts == (band["below"], band["within"], band["above"])
    assert own.histogram.tolist() == theirs["histogram"]["counts"]
    written = tf.read(folder / "distances.ply").attributes.vertex
    column = next(name for name in written if name not in ("red", "green", "blue", "alpha"))
    assert np.array_equal(written[column], own.distances.astype(written[column].dtype))


@pytest.mark.parametrize("clearance", [0.0, 0.5, 4.0])
def test_clashes_are_those_of_the_tool(folder, clearance):
    names = ["cube", "inside", "side", "ball", "near"]
    report = run_tool("tf-place", "clash", *[folder / f"{n}.off" for n in names], "--clearance",
                      clearance)["files"][0]
    made = tf.clash([PARTS[n] for n in names], clearance)
    assert {key.replace("_", "-"): n for key, n in made.counts.items()} == report["counts"]
    for mine, theirs in zip(made.pairs, report["pairs"], strict=True):
        assert [names[mine.a], names[mine.b]] == [theirs["a"], theirs["b"]]
        assert mine.relation.replace("_", "-") == theirs["status"]
        assert (mine.distance, mine.face_pairs, mine.volume, mine.depth) == (
            theirs["distance"], theirs["face_pairs"], theirs["volume"], theirs["depth"])
        for (_, pairs, a, b), region in zip(mine.regions, theirs["regions"], strict=True):
            assert (pairs, a.tolist(), b.tolist()) == (
                region["face_pairs"], region["faces_a"], region["faces_b"])


@pytest.mark.parametrize("clearance", [0.0, 0.4])
def test_poses_are_those_of_the_tool(folder, clearance):
    names = ["cube", "inside", "near"]
    rng = np.random.default_rng(5)
    poses = np.tile(np.eye(4), (40, 3, 1, 1))
    poses[:, :, :3, 3] = rng.random((40, 3, 3)) * 3
    poses[:, 1, :3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    lines = [json.dumps(dict(zip(names, pose.tolist()))) for pose in poses]
    (folder / "poses.jsonl").write_text("\n".join(lines) + "\n")
    done = subprocess.run([tool("tf-place"), "check", *[str(folder / f"{n}.off") for n in names],
                           "--poses", str(folder / "poses.jsonl"), "--clearance", str(clearance),
                           "--results", "-"], capture_output=True, check=False)
    assert done.returncode == 1, done.stderr
    theirs = [(row["pose"], pair["a"], pair["b"], pair["status"], pair["distance"])
              for row in map(json.loads, done.stdout.splitlines()) for pair in row["pairs"]]
    made = tf.check_poses([PARTS[n] for n in names], poses, clearance)
    own = [(int(pose), names[a], names[b], tf.RELATIONS[how].replace("_", "-"), far)
           for pose, (a, b), how, far in zip(made.pose, made.parts, made.relation, made.distance)]
    assert own == theirs and 0 < made.clashing < 40


@needs_models
@pytest.mark.parametrize("rule", ["first", "chain"])
def test_streams_have_the_bytes_of_the_tool(tmp_path, rule):
    path = model("cloud/terrain_samp11_38k.ply")
    run_tool("tf-weld", path, "-t", "1", "--rule", rule, "-o", tmp_path / "tool.ply")
    made = tf.weld_stream(path, tmp_path / "own.ply", 1.0, chain=rule == "chain",
                          points_per_tile=5000)
    assert made.kept < made.points
    assert (tmp_path / "tool.ply").read_bytes() == (tmp_path / "own.ply").read_bytes()


def test_searches_of_files_are_those_of_the_tool(tmp_path):
    """Pair by pair: contacts of every kind, with a face between that is not finite."""
    points, faces = soup(3, 400)
    points = np.vstack([points, [[np.nan, 0, 0]]])
    faces = np.vstack([faces[:200], [[0, 1, len(points) - 1]], faces[200:]])
    tf.write(tmp_path / "soup.ply", tf.Mesh(points, faces))
    report = run_tool("tf-selfintersect", tmp_path / "soup.ply", "--touching", "--pairs",
                      tmp_path / "pairs.csv")["files"][0]
    found = tf.self_intersections_of_file(tmp_path / "soup.ply", faces_per_tile=100)
    with open(tmp_path / "pairs.csv", newline="") as file:
        theirs = [(int(a), int(b), kind) for a, b, kind, _ in list(csv.reader(file))[1:]]
    own = [(a, b, tf.KINDS[kind]) for (a, b),
           kind in zip(found.pairs_in_file.tolist(), found.kinds)]
    assert own == theirs and found.tiles > 3 and found.non_finite == 1
    assert {kind for _, _, kind in own} >= {"crossing", "touching", "pierce", "overlap",
                                            "degenerate"}
    assert max(b for _, b, _ in own) == 400
    assert found.counts == {kind: report["pairs"].get(kind, 0) for kind in tf.KINDS}


def test_robots_are_those_of_the_tool(folder):
    shape = "<collision><geometry><mesh filename='{}.off' scale='{}'/></geometry></collision>"
    links = "".join(f"<link name='{name}'>{shapes}</link>" for name, shapes in (
        ("base", shape.format("cube", "1 1 1")), ("none", ""),
        ("arm", shape.format("side", "0.5 1 1") + shape.format("near", "1 1 0.25")),
        ("tip", shape.format("inside", "1 1 1") + "<collision><origin xyz='0 0 1'/><geometry>"
                "<sphere radius='0.2'/></geometry></collision>")))
    (folder / "robot.urdf").write_text(
        f"<robot name='r'>{links}"
        "<joint name='weld' type='fixed'><parent link='base'/><child link='none'/></joint>"
        "<joint name='lift' type='prismatic'><parent link='none'/><child link='arm'/>"
        "<origin rpy='0.1 0.2 0.3'/><axis xyz='0 0 1'/><limit lower='0' upper='2'/></joint>"
        "<joint name='bend' type='revolute'><parent link='arm'/><child link='tip'/>"
        "<origin xyz='0.5 0 1'/><axis xyz='0 1 0'/></joint></robot>")
    robot = tf.read_urdf(folder / "robot.urdf")
    assert robot.links == ["base", "none", "arm",
                           "tip"] and robot.link_of_part.tolist() == [0, 2, 3]
    assert robot.joints[1] == ("lift", "prismatic", "none", "arm", (0.0, 2.0))
    assert robot.adjacent.tolist() == [[0, 1], [1, 2]]
    assert robot.approximated == [
        "link tip: a sphere is replaced by 5120 triangles that enclose it"]
    rng = np.random.default_rng(6)
    values = {"lift": rng.random(50) * 4, "bend": rng.random(50) * 6}
    lines = [json.dumps({"lift": lift, "bend": bend}) for lift, bend in zip(*values.values())]
    (folder / "angles.jsonl").write_text("\n".join(lines) + "\n")
    report = run_tool("tf-place", "check", folder / "robot.urdf", "--poses",
                      folder / "angles.jsonl", "--clearance", "0.2")["files"][0]
    poses = robot.poses(values)
    assert poses.shape == (50, 3, 4, 4)
    made = tf.check_poses(robot.parts, poses, 0.2, ignored=robot.adjacent)
    theirs = [(one["pose"], pair["a"], pair["b"], pair["distance"])
              for one in report["poses"]["list"] for pair in one["pairs"]]
    names = [robot.links[link] for link in robot.link_of_part]
    own = [(int(pose), names[a], names[b], far)
           for pose, (a, b), far in zip(made.pose, made.parts, made.distance)]
    assert own == theirs and 0 < made.clashing < 50
    assert np.array_equal(robot.poses({"lift": values["lift"][7], "bend": values["bend"][7]}),
                          poses[7])
    with pytest.raises(ValueError, match="weld"):
        robot.poses({"weld": 1.0})
    with pytest.raises(ValueError, match="bend: expected numbers"):
        robot.poses({"bend": "x"})
