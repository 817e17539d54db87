"""ask.py TOOLS FOLDER MODEL...: what other programs say of the solids that tf-repair makes.

For each model, table.csv in FOLDER has a row for tf-repair with what each program objects to in its
STL, and a row for each program that repairs, with what tf-repair --check finds in what that one
makes of the same model. Nothing in a cell: no objection."""

import csv
import json
import os
import re
import subprocess
import sys

LIMIT = 300                # seconds that a program may take
FACES_FOR_OPENSCAD = 3000  # more take it minutes: its numbers are exact, and slow
FIELDS = ("model", "made_by", "faces", "volume", "admesh", "prusa-slicer", "openscad", "meshlab",
          "tf-repair --check")

TOPOLOGY = """<!DOCTYPE FilterScript><FilterScript>
<filter name="Merge Close Vertices">
  <Param name="Threshold" type="RichAbsPerc" value="0" min="0" max="1"/></filter>
<filter name="Compute Topological Measures"/></FilterScript>"""
MENDING = """<!DOCTYPE FilterScript><FilterScript>
<filter name="Merge Close Vertices">
  <Param name="Threshold" type="RichAbsPerc" value="0" min="0" max="1"/></filter>
<filter name="Remove Duplicate Faces"/><filter name="Remove Zero Area Faces"/>
<filter name="Re-Orient all faces coherentely"/>
<filter name="Close Holes"><Param name="MaxHoleSize" type="RichInt" value="1000"/>
<Param name="Selected" type="RichBool" value="false"/>
<Param name="NewFaceSelected" type="RichBool" value="false"/>
<Param name="SelfIntersection" type="RichBool" value="false"/></filter>
</FilterScript>"""


def run(*words):
    """Status and all that was said; the status of what takes too long is None."""
    try:
        done = subprocess.run([str(word) for word in words], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace",
                              timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return None, "takes too long"
    return done.returncode, done.stdout


def numbers(text, pattern):
    return {name.strip(): int(value) for name, value in re.findall(pattern, text)}


def admesh(stl):
    status, text = run("admesh", stl)
    if status != 0:
        return "failed"
    wanted = ("Edges fixed", "Facets removed", "Facets added", "Facets reversed",
              "Backwards edges", "Degenerate facets", "Total disconnected facets")
    found = numbers(text, r"(?m)^([A-Z][a-z ]+?) *: +(\d+)")
    return ", ".join(f"{found[key]} {key.lower()}" for key in wanted if found.get(key, 1) != 0)


def prusa_slicer(stl):
    status, text = run("prusa-slicer", "--info", stl)
    if status != 0:
        return "failed"
    said = re.findall(r"(?m)^(open_edges|backwards_edges|edges_fixed|degenerate_facets|"
                      r"facets_removed|facets_reversed) = +(\d+)", text)
    if not re.search(r"(?m)^manifold = yes$", text):
        said.insert(0, ("not", "manifold"))
    return ", ".join(f"{key} {value}" for key, value in said)


def openscad(stl, faces, folder):
    if faces > FACES_FOR_OPENSCAD:
        return ""
    script = os.path.join(folder, "ask.scad")
    with open(script, "w") as file:
        file.write(f'intersection() {{ import("{os.path.abspath(stl)}");\n'
                   f'  translate([-5e8, -5e8, -5e8]) cube(1e9); }}\n')
    status, text = run("openscad", "-o", os.path.join(folder, "ask.off"), script)
    wrong = re.findall(r"(?m)^(?:ERROR|WARNING): (.*)$", text)
    return "; ".join(wrong) or ("" if status == 0 else "failed")


def meshlab(script, folder, *words):
    path = os.path.join(folder, "ask.mlx")
    with open(path, "w") as file:
        file.write(script)
    return run("xvfb-run", "-a", "meshlabserver", *words, "-s", path)


def meshlab_objects(stl, folder):
    status, text = meshlab(TOPOLOGY, folder, "-i", stl)
    if status != 0:
        return "failed"
    wrong = [] if re.search(r"(?m)^Mesh is two-manifold", text) else ["not two-manifold"]
    edges = re.search(r"(?m)^Boundary Edges (\d+)", text)
    if not edges or edges[1] != "0":
        wrong.append("boundary edges")
    return ", ".join(wrong)


def check(tools, path):
    """Faces, volume and defects of what another program has made."""
    if not os.path.exists(path):
        return "", "", "nothing was written"
    report = path + ".json"
    status, text = run(os.path.join(tools, "tf-repair", "tf-repair"), "--check", path, "-f", "-r",
                       report)
    if status not in (0, 1):
        return "", "", text.strip().splitlines()[-1]
    with open(report) as file:
        entry = json.load(file)["files"][0]
    said = text.strip().splitlines()[-1].split(": ", 1)[1]
    return entry["faces"], f"{entry['volume']:.6g}", said if status == 1 else ""


def others(tools, model, folder):
    """Their own repairs: (name, faces, volume, defects)."""
    stl, made = os.path.join(folder, "in.stl"), os.path.join(folder, "made.stl")
    run(os.path.join(tools, "tf-weld", "tf-weld"), model, "-o", stl, "-f", "-q")
    for name, words in (("admesh", ("admesh", "-b", made, stl)),
                        ("prusa-slicer", ("prusa-slicer", "--repair", "--export-stl", "-o", made,
                                          stl)),
                        ("meshlab", None)):
        if os.path.exists(made):
            os.remove(made)
        if words:
            run(*words)
        else:
            meshlab(MENDING, folder, "-i", stl, "-o", made)
        yield name, *check(tools, made)


def main(tools, folder, models):
    objections = 0
    with open(os.path.join(folder, "table.csv"), "w", newline="") as file:
        table = csv.DictWriter(file, FIELDS, restval="")
        table.writeheader()
        for model in models:
            stl, report = os.path.join(folder, "solid.stl"), os.path.join(folder, "solid.json")
            name = os.path.basename(model)
            status, text = run(os.path.join(tools, "tf-repair", "tf-repair"), model, "-o", stl,
                               "-f", "-r", report)
            row = {"model": name, "made_by": "tf-repair"}
            if status == 0:
                with open(report) as content:
                    made = json.load(content)["files"][0]["repair"]
                row |= {"faces": made["faces"], "volume": f"{made['volume']['after']:.6g}",
                        "admesh": admesh(stl), "prusa-slicer": prusa_slicer(stl),
                        "openscad": openscad(stl, made["faces"], folder),
                        "meshlab": meshlab_objects(stl, folder),
                        "tf-repair --check": check(tools, stl)[2]}
                wrong = [f"{key}: {row[key]}" for key in FIELDS[4:] if row[key]]
                objections += len(wrong)
                print(f"{name}: {'; '.join(wrong) or 'nobody objects'}", flush=True)
            else:
                row["tf-repair --check"] = text.strip().splitlines()[-1].split(": ", 1)[-1]
                print(f"{name}: {row['tf-repair --check']}", flush=True)
            table.writerow(row)
            for made_by, faces, volume, said in others(tools, model, folder):
                table.writerow({"model": name, "made_by": made_by, "faces": faces,
                                "volume": volume, "tf-repair --check": said})
            file.flush()
    print(f"{len(models)} models, {objections} objections to what tf-repair wrote")
    return 1 if objections else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
