"""translate.py TOOLS FOLDER LIST: what is lost between formats without a word.

Each model that a line of LIST names goes through tf-weld, which merges nothing but equal points, to
each format and back to PLY. What differs from the model's own PLY, corner by corner and column by
column, has to be in the words of the tools; likewise names of parts, by way of OBJ. table.csv in
FOLDER has, for each extension, how many files treeform, assimp and MeshLab read; refused.txt has
the words for those that treeform does not read, and who else does."""

import collections
import concurrent.futures
import csv
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

from ply_rows import read_ply

np.seterr(over="ignore")  # of what is beyond float32, and stays so
LIMIT = 120  # seconds that a program may take
OF_MESHES = (("ply", ()), ("ply", ("--ascii",)), ("obj", ()), ("off", ()), ("stl", ()),
             ("stl", ("--ascii",)), ("glb", ()), ("3mf", ()), ("3mf", ("--precision", "double")))
OF_POINTS = (("ply", ()), ("ply", ("--ascii",)), ("pcd", ()), ("pcd", ("--ascii",)), ("las", ()),
             ("laz", ()), ("xyz", ()), ("csv", ()), ("obj", ()), ("off", ()), ("glb", ()))
COLORS = ("red", "green", "blue", "alpha")
NORMALS = ("nx", "ny", "nz")
IN_GROUPS = ("3mf", "glb")  # faces of an object and of a color are together
HAVE_MORE = ("las", "laz")  # fields that all points have
NO_TEXTURE = (float("nan"),) * 6
# What tools say of coordinates that are not kept, and of rows that are not.
ROUNDED = r"single precision|float32|rounded"
FEWER = r"without faces left out|dropped|not read|degenerate|holds points only"


def run(*words, limit=LIMIT):
    try:
        done = subprocess.run(list(map(str, words)), stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=limit)
    except subprocess.TimeoutExpired:
        return None, "takes too long"
    return done.returncode, done.stdout


def triangles(faces):
    """[n, 3] corners of the fans of all faces, and of each its face and its number in that."""
    lists = faces.get("vertex_indices", faces.get("vertex_index", []))
    fans = [(c[0], c[i], c[i + 1], f, i) for f, c in enumerate(lists) for i in range(1, len(c) - 1)]
    table = np.array(fans, np.int64).reshape(-1, 5)
    return table[:, :3], table[:, 3], table[:, 4]


class Model:
    """What a PLY has, for each corner of its triangles, or for each point where there are none."""

    def __init__(self, path):
        elements, header = read_ply(path)
        points, faces = elements["vertex"], elements.get("face", {})
        self.places = np.column_stack([points[a].astype(float) for a in "xyz"])
        self.stored = max(map(len, faces.values()), default=0)
        self.corners, face, number = triangles(faces)
        self.texture = None  # [n, 6]
        finite = self.places[np.isfinite(self.places).all(1)]
        self.points = len(np.unique(finite.astype(np.float32), axis=0))
        rows = self.corners.ravel() if len(self.corners) else np.arange(len(self.places))
        self.places = self.places[rows]
        self.columns = {}
        for name, column in points.items():
            if name not in "xyz" and isinstance(column, np.ndarray):
                self.columns[name.removeprefix("scalar_")] = column[rows]  # as CloudCompare says
        for name, column in faces.items():
            if name == "texcoord":
                self.texture = np.array([column[f][:2] + column[f][2 * i:2 * i + 4] or NO_TEXTURE
                                         for f, i in zip(face, number)])
            elif isinstance(column, np.ndarray):
                self.columns[name + " of faces"] = column[face]
        if "s" in self.columns and "t" in self.columns and len(self.corners):
            both = np.column_stack([self.columns.pop("s"), self.columns.pop("t")])
            self.texture = both.reshape(-1, 6) if self.texture is None else self.texture
        # A remark may come back as a comment.
        lines = [line.partition(" ") for line in header]
        self.texts = {text for word, _, text in lines if word in ("comment", "obj_info")}
        self.lines = {text for word, _, text in lines
                      if word == "obj_info" or text.startswith("TextureFile")}
        self.others = {name for name, rows in elements.items()
                       if name not in ("vertex", "face") and any(map(len, rows.values()))}

    def sort(self):
        """By places."""
        places = self.places.astype(np.float32).reshape(len(self.corners), 9)
        order = np.lexsort(places.T[::-1])
        corners = (3 * order[:, None] + np.arange(3)).ravel()
        self.places = self.places[corners]
        for name, column in self.columns.items():
            self.columns[name] = column[order if name.endswith(" of faces") else corners]
        if self.texture is not None:
            self.texture = self.texture[order]

    def volume(self):
        if not len(self.corners):
            return 0.0
        a, b, c = (self.places[i::3] - self.places[0] for i in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def same_values(a, b, is_color):
    """Text has float32 by fewer digits; colors may be shares of 1."""
    if is_color:
        a, b = (c * 255.0 if c.dtype.kind == "f" and c.max(initial=0) <= 1 else c for c in (a, b))
    if "f" in a.dtype.kind + b.dtype.kind:
        a, b = a.astype(np.float32), b.astype(np.float32)
        return np.allclose(a, b, rtol=1e-6 if is_color else 0, atol=0, equal_nan=True)
    return np.array_equal(a, b)


def names(path):
    """The parts of an OBJ, where there are several: their names and numbers of triangles."""
    parts, now = [], {}
    with open(path, errors="replace") as file:
        for line in file:
            word, _, rest = line.rstrip("\n").partition(" ")
            if word in ("o", "g", "usemtl"):
                now = {**now, word: rest} if word != "o" else {"usemtl": now.get("usemtl", ""),
                                                               "o": rest}
            elif word == "f":
                key = "/".join(filter(None, (now.get("o"), now.get("g"), now.get("usemtl"))))
                if not parts or parts[-1][0] != key:
                    parts.append([key, 0])
                parts[-1][1] += len(rest.split()) - 2
    for part in parts:  # of a GLB, where there is no name
        part[0] = re.sub(r"^nodes\[\d+\]$", "", part[0])
    return parts if len(parts) > 1 else []


def differences(before, after, words, extension):
    """What differs, and is not in the words of the tools."""
    said = lambda pattern: re.search(pattern, words) is not None
    is_named = lambda column: said(rf"\b{re.escape(column)}\b") or (
        column in COLORS and said("colors|materials")) or (
        column in NORMALS and said("normals"))
    if len(before.corners) != len(after.corners):
        if not said(FEWER):
            yield f"triangles {len(before.corners)}, {len(after.corners)}"
        return
    if before.points != after.points and not said(FEWER + "|" + ROUNDED):
        yield f"points {before.points}, {after.points}"
    if len(before.places) != len(after.places):
        return
    size = np.nanmax(np.abs(before.places), initial=0, where=np.isfinite(before.places))
    is_near = lambda: np.allclose(before.places, after.places, rtol=0, atol=2e-7 * size,
                                  equal_nan=True)
    if extension in IN_GROUPS and not is_near():
        before.sort()
        after.sort()
    if not np.array_equal(before.places, after.places, equal_nan=True):
        if not said(ROUNDED):
            yield "coordinates"
        if not is_near():
            yield "coordinates, by much"
        else:
            # Of all corners, by a half step each.
            most = abs(before.volume()) * 1e-4 + size ** 3 * 1e-5
            if abs(before.volume() - after.volume()) > most:
                yield f"volume {before.volume()}, {after.volume()}"
    for name, column in before.columns.items():
        plain = name.removesuffix(" of faces")
        if name not in after.columns:
            if not is_named(plain):
                yield f"{name} is gone"
        elif not same_values(column, after.columns[name], plain in COLORS):
            if not is_named(plain):
                yield f"{name} has other values"
    for name in sorted(after.columns.keys() - before.columns.keys()):
        plain = name.removesuffix(" of faces")
        if (extension not in HAVE_MORE and not is_named(plain)
                and not said("XYZ has no column names")):
            yield f"{name} is new"
    if before.texture is not None and not said("texture coordinates") and not is_named("s"):
        if after.texture is None or not np.allclose(
                before.texture, after.texture, atol=1e-6, equal_nan=True):
            yield "texture coordinates"
    if before.lines - after.texts and not said("texture files|remarks|materials"):
        yield f"lines {sorted(before.lines - after.texts)}"
    for name in before.others - after.others:
        if not said(f"element {name}"):
            yield f"element {name}"


def translate(tf_weld, model, folder):
    """Whether the model is read, words, and silent differences."""
    own, named = os.path.join(folder, "own.ply"), os.path.join(folder, "own.obj")
    status, words = run(tf_weld, model, "-o", own, "-f")
    if status != 0:
        return False, words, []
    before = Model(own)
    is_mesh = len(before.corners) > 0
    run(tf_weld, model, "-o", named, "-f")
    found = []
    for extension, how in OF_MESHES if is_mesh else OF_POINTS:
        there = os.path.join(folder, "there." + extension)
        back = os.path.join(folder, "back.ply")
        status, went = run(tf_weld, model, "-o", there, "-f", *how)
        title = " ".join((extension, *how))
        if status != 0:
            if not re.search("(?m)error: ", went):
                found.append(f"{title}: status {status}, {went.strip()}")
            continue
        status, came = run(tf_weld, there, "-o", back, "-f")
        if status != 0:
            found.append(f"{title}: is not read back: {came.strip()}")
            continue
        found += [f"{title}: {one}"
                  for one in differences(before, Model(back), went + came, extension)]
        if is_mesh and not re.search("names of parts|materials", went):
            run(tf_weld, there, "-o", back[:-3] + "obj", "-f")
            mine, other = names(named), names(back[:-3] + "obj")
            if extension in IN_GROUPS:
                mine, other = sorted(mine), sorted(other)
            if mine != other:
                changed = [part for part in mine if part not in other]
                found.append(f"{title}: names, such as {changed[:2]}")
    return True, words, found


def read_by_others(model, folder):
    """Whether assimp and MeshLab find points in it."""
    status, text = run("assimp", "info", model)
    found = re.search(r"Vertices: +(\d+)", text)
    assimp = status == 0 and found is not None and found[1] != "0"
    status, text = run("meshlabserver", "-i", model, limit=20)
    loaded = re.search(r"loaded has (\d+) vn", text)
    return assimp, status == 0 and loaded is not None and loaded[1] != "0"


def one(tf_weld, model):
    with tempfile.TemporaryDirectory() as folder:
        return translate(tf_weld, model, folder), read_by_others(model, folder)


def main(tools, folder, listed):
    with open(listed) as file:
        models = file.read().splitlines()
    counts, silent = collections.defaultdict(collections.Counter), 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool, \
            open(os.path.join(folder, "refused.txt"), "w") as refused:
        tf_weld = os.path.join(tools, "tf-weld", "tf-weld")
        for model, result in zip(models, pool.map(lambda m: one(tf_weld, m), models)):
            (treeform, words, found), (assimp, meshlab) = result
            row = counts[model.rsplit(".", 1)[-1].lower()]
            row.update(files=1, treeform=int(treeform), assimp=int(assimp), meshlab=int(meshlab))
            if not treeform:
                others = "assimp " * assimp + "meshlab " * meshlab
                print(f"[{others.strip()}] {words.strip()}", file=refused, flush=True)
            for difference in found:
                print(f"{model}: {difference}", flush=True)
            silent += len(found)
    fields = ("extension", "files", "treeform", "assimp", "meshlab")
    with open(os.path.join(folder, "table.csv"), "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(fields)
        for extension, row in sorted(counts.items()):
            table.writerow([extension, *(row[key] for key in fields[1:])])
        table.writerow(["all", *(sum(row[key] for row in counts.values()) for key in fields[1:])])
    print(f"{len(models)} models, {silent} differences without a word")
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3]))
