"""The functions of the package, and the calls of C++ that they are. All else follows from the
headers: `python_functions.py` says how. Those without a call are in `src/*.cpp`, or of Python where
they have a `body`."""

from __future__ import annotations

from python_language import Function

_MOVES = {"move_a": "(4, 4) an affine map of `a`, applied first.", "move_b": "(4, 4) the same of "
                                                                             "`b`."}
_POSES = {"move_a": "an affine map of `a` (4, 4), or many (n, 4, 4): then the answer is an array "
                    "(n,).",
          "move_b": "the same of `b`."}
_PLANE = {"normal": "(3,) of the plane, of any length.", "at": "(3,) a point of the plane."}
_HEIGHTS = {"heights": "(K,) of planes above that one, along its normal at length 1; None is the "
                       "plane itself."}
_RAYS = {"origins": "(n, 3)", "directions": "(n, 3) of any length.",
         "t_min": "what is hit before origin + t_min direction does not count.",
         "t_max": "nor what is hit beyond this."}
_ALL_RAYS = "rays(origins, directions, t_min, t_max)"
_PIECE = f"mesh.prepared(), {_ALL_RAYS}.piece(begin, end)"
_MESHES = {"meshes": "each a mesh, or a list of meshes."}
_VOLUMES = {"volumes": "compute those of two operands, of what is in either, and of what is in "
                       "both."}
_WELD = {
    "same": "vertex properties that must agree, with the largest difference.",
    "keep_seams": "normals, texture coordinates and colors must agree, except for those in "
                  "`across`.",
    "chain": "one point of all that steps of at most the tolerance link. By default a point is "
             "dropped when an earlier kept one is within the tolerance.",
    "keep": "which point of a group stays: 'first', 'last', 'mean', 'lowest' or 'highest' of "
            "`keep_by`.",
    "keep_by": "a property of vertices.",
    "order_by": "a property of vertices: points are visited by its values, the least first; needs "
                "`keep` 'first'. '': by number.",
    "highest_first": "the greatest value of `order_by` first.",
    "across": "properties that `keep_seams` does not look at."}
_FIXED = "a fixed body, or a list of them."

#: A set operation by its name.
def _operation(name: str, what: str, leave: str = "gap",
               docs: dict[str, str] = {}) -> Function:  # noqa: B006
    return Function(f"{name}(*meshes: Operands, options: boolean_options) -> BooleanResult",
                    doc=what, leave=leave, docs=_MESHES | _VOLUMES | docs, cpp="boolean",
                    check="solids",
                    body=f'combined("{name}", meshes, how, progress)')


def _of_others(own: str) -> str:
    """The options of placements that not all of these functions have, without its own."""
    return " ".join(sorted({"bed", "effort", "flip", "max_angle", "tolerance"} - {*own.split()}))


def _placed(signature: str, call: str, own: str = "", **more: dict[str, str]) -> Function:
    words = {"fixed": "onto"} if "onto" in signature else \
        {"direction": "axis"} if "axis:" in signature else {}
    return Function(f"{signature} -> Placement", call, "moving", leave=_of_others(own),
                    words=words, **more)


FUNCTIONS = [
    # _booleans
    _operation("union", "What is in any of the solids: `union(a, b, ...)`, or `union([a, "
                                 "b, ...])` as in trimesh. Of one mesh, the solid that it winds "
                                 "around, without self-intersections. See `boolean`.", "", {
                   "gap": "the widest gap to fill between faces of different solids, where they "
                          "lie over each other. Faces of what fills it, the last, have the face "
                          "that they stand on, or lie opposite of, as `face_source`; "
                          "`filled_faces` of `statistics` counts the faces at such gaps. No "
                          "volumes then."}),
    _operation("intersection", "What is in all of the solids. Of one mesh that a "
                                               "file of several objects was read to, its objects "
                                               "are the solids, as in `difference`. See "
                                               "`boolean`."),
    _operation("difference", "The first solid without all others: `difference(a, b, "
                                           "c)`, or `difference(a, [b, c])`. One mesh that a file "
                                           "of several objects was read to (`attributes.parts`) is "
                                           "the first object without the others, as in tf-boolean; "
                                           "`face_source` and `vertex_source` count in each "
                                           "object. One mesh without such objects is one solid, "
                                           "and nothing is taken from it. See `boolean`."),
    _operation("symmetric_difference", "What is in an odd number of the solids. Of one mesh "
                                              "that a file of several objects was read to, its "
                                              "objects are the solids, as in `difference`. See "
                                              "`boolean`."),
    Function("boolean(expression: str, *operands: Operands, options: boolean_options, "
             "**meshes: Mesh) -> BooleanResult",
             body="by_formula(expression, operands, meshes, how, progress)",
             check="solids", leave="gap",
             also="Attributes of operands are carried over: a face has the values of the face that "
                  "it lies in, a new vertex on a cut interpolated ones. 0 or NaN stand where an "
                  "operand has none. Only faces of equal values are merged; where vertices have "
                  "values, only with `simplify`.",
             docs=_VOLUMES | {
                   "expression": "`a`, `b`, `c`, ... for `operands`, names of `meshes`, `+` or `|` "
                                 "union, `*` or `&` intersection, `-` difference, `^` exclusive "
                                 "or, and brackets. `*` and `&` bind tighter than the others, "
                                 "which go from left to right."}),
    Function("clip(sheet: Mesh, *solids: Operands, keep: str = \"outside\", options: "
             "boolean_options)"
             " -> BooleanResult", body="clipped(sheet, solids, keep, how, progress)",
             check="solids", leave="gap min_volume simplify volumes",
             doc="An open surface cut by solids, one by one or in a list: the pieces of `sheet` "
                 "outside all of them, or inside all. The sheet may end anywhere, overlap itself, "
                 "and even be closed. Edges are not checked, since the result is open.",
             docs={"keep": "'outside' or 'inside'. A piece on the surface of a solid is inside it, "
                           "so both together are the sheet."}),
    Function("boolean_of(meshes: Meshes, operation: str, formula: str, names: Words, "
             "options: boolean_options) -> BooleanResult",
             "(require_faces(meshes, names), tf::boolean($meshes, expression_of("
             "operation, formula, names, meshes.size()), options))", "attributes of meshes"),
    Function("clip_by(meshes: Meshes, operation: str, options: boolean_options) -> BooleanResult",
             "(require_faces(meshes, {}), tf::clip($meshes, 0, expression_of("
             "operation, {}, {}, meshes.size()), options))", "attributes of meshes"),
    Function("split(*meshes: Operands, options: boolean_options) -> BooleanResult",
             "tf::split($meshes, options)", "attributes of meshes", check="meshes",
             docs=_MESHES,
             leave="inside keep_cuts simplify volumes min_volume gap"),
    Function("check_solid(mesh: Mesh) -> Certificate",
             'require_faces(mesh, "mesh"), tf::check_solid(mesh.view(), report)'),
    # _cuts
    Function("section(mesh: Mesh, normal: Vector = (0, 0, 1), at: Vector = (0, 0, 0), *, "
             "heights: Heights = None) -> Section",
             "tf::section($mesh, {$at, $normal}, $heights, report)", docs=_PLANE | _HEIGHTS),
    Function("layer_heights(mesh: Mesh, thickness: float, normal: Vector = (0, 0, 1), "
             "at: Vector = (0, 0, 0)) -> Floats",
             "tf::oriented_plane{$at, $normal}.layer_heights(mesh.view().points, thickness)",
             doc="(K,) heights for `section`: the middles of layers of this thickness, from the "
                 "lowest vertex to the highest: half a thickness above the lowest is the first. "
                 "Vertices that are not finite do not count.", docs=_PLANE),
    Function("cut(mesh: Mesh, normal: Vector = (0, 0, 1), at: Vector = (0, 0, 0), *, "
             "heights: Heights = None, options: cut_options) -> CutPieces",
             "tf::cut($mesh, {$at, $normal}, $heights, options)", "attributes of mesh",
             check="solid", docs=_PLANE | _HEIGHTS,
             also="So a solid is cut into what is below and above a plane; with `heights`, K + 1 "
                  "pieces, from the lowest up. Some may have no faces."),
    Function("cut_to_fit(mesh: Mesh, size: Vector, options: cut_options)"
             " -> CutPieces", "tf::cut_to_fit($mesh, $size, options)",
             "attributes of mesh", check="solid",
             docs={"size": "(3,) of the box, as the bed of a printer."}),
    Function("cut_along(mesh: Mesh, values: Numbers, levels: Levels)"
             " -> CutPieces",
             "tf::cut_along($mesh, $values, $levels, {.progress = report})", "attributes of mesh",
             check="mesh",
             docs={"values": "(V,) of the vertices, linear in each face.", "levels": "(K,)"}),
    Function("components(mesh: Mesh, *, min_volume: float = 0.0, largest: int = 0)"
             " -> list[MeshPart]", "tf::components($mesh, min_volume, largest)",
             "attributes of mesh",
             docs={"min_volume": "of parts, in cubic units.", "largest": "how many; 0: all."}),
    Function("submesh(mesh: Mesh, faces: Chosen) -> MeshPart", "tf::submesh($mesh, $faces)",
             "attributes of mesh", also="Vertices keep their attributes.",
             docs={"faces": "(n,) numbers; or a mask (F,) of True and False."}),
    Function("mass_properties(mesh: Mesh) -> Optional[MassProperties]",
             "tf::find_mass_properties(mesh.view())"),
    Function("concatenate(meshes: Iterable[MeshLike]) -> Mesh", body="joined(meshes, progress)",
             also="Their attributes are put together likewise."),
    Function("transformed(mesh: Mesh, matrix: Matrix) -> Mesh", cpp="transform_mesh",
             words={"by": "matrix"},
             also="It keeps its attributes, with normals turned.",
             docs={"matrix": "(4, 4)"}),
    # _shapes
    Function("offset(mesh: Mesh, distance: float, options: offset_options) -> OffsetResult",
             "tf::offset($mesh, distance, options)", kind="long_work", check="solid",
             leave="offset shift"),
    Function("hollow(mesh: Mesh, wall: float, *, drains: Drains = (), options: offset_options) "
             "-> OffsetResult",
             "tf::hollow($mesh, wall, $drains, options)", kind="long_work", check="solid",
             leave="offset shift",
             docs={"drains": "(n, 4) holes through the wall: a point, and the diameter of the hole "
                             "at the nearest point of the surface."}),
    Function("thicken(mesh: Mesh, thickness: float, options: offset_options) -> OffsetResult",
             "tf::thicken($mesh, thickness, options)", kind="long_work", check="solid",
             leave="offset",
             docs={"shift": "how far the surface is first moved to its front; negative: to its "
                            "back. Half of the thickness leaves its back where it is."}),
    Function("simplify(mesh: Mesh, max_distance: float, *, face_groups: Groups = None, "
             "options: simplify_options) -> SimplifyResult",
             "attributes.simplify($mesh, max_distance, $face_groups, options)",
             "attributes of mesh", kind="long_work", check="mesh", cpp="simplify",
             also="Values of vertices and corners are interpolated; seams, and borders of "
                  "materials and of values of faces, are kept.",
             docs={"face_groups": "(F,) numbers; edges between faces of different ones are "
                                  "borders, too."}),
    Function("wall_thickness(mesh: Mesh, by: thickness_by = \"ray\") -> Thickness",
             "tf::wall_thickness($mesh, $by, report)",
             docs={"by": "'ray', along the normal inward from the center of a face; or 'sphere', "
                         "the diameter of the largest ball within that touches the center."}),
    Function("oriented_box(points: Cloud) -> Optional[OrientedBox]",
             "tf::find_oriented_box($points)", docs={"points": "(n, 3), or a mesh."}),
    Function("isolines(mesh: Mesh, values: Numbers, levels: Levels) -> Isolines",
             "tf::isolines($mesh, $values, $levels, report)",
             docs={"values": "(V,) of the vertices, linear in each face.", "levels": "(K,)"}),
    # _repair
    Function("resolve_self_intersections(mesh: Mesh, mode: resolve_mode = \"outer\", "
             "options: resolve_options) -> RepairResult",
             "tf::resolve_self_intersections($mesh, $mode, options)", "attributes of mesh",
             check="solid",
             docs={"mode": "'outer' cuts faces along each other and keeps what bounds the solid; "
                           "'split' keeps every piece; 'remove' deletes faces that meet and fills "
                           "the holes, for surfaces that bound no solid."}),
    Function("repair(mesh: Mesh, *, steps: Iterable[str] = STEPS, options: repair_options)"
             " -> RepairResult", "tf::repair($mesh, options)", "attributes of mesh", check="solid",
             given="**steps_of(steps)", leave="join orient fill resolve detach",
             docs={"steps": "those to take. 'join' drops degenerate and repeated faces and closes "
                            "cracks, 'orient' makes faces agree and look outward, 'fill' fills "
                            "holes, 'resolve' cuts self-intersections, 'detach' moves apart what "
                            "touches in an edge or a vertex.",
                   "keep_cuts": "as in `boolean`; faces that fill holes are merged with each other "
                                "alone.",
                   "inside": "'nonzero', 'odd' or 'positive': what is solid. By default 'positive' "
                             "where each shell looks outward, else 'nonzero', or labels."}),
    Function("wrap(mesh: Mesh, size: float, options: offset_options) -> OffsetResult",
             "tf::wrap($mesh, size, options)", kind="long_work", check="mesh",
             leave="resolution shift"),
    Function("convex_hull(points: Cloud) -> ConvexHull", "tf::convex_hull($points, report)",
             docs={"points": "(n, 3), or a mesh."}),
    Function("rounded(points: Points, precision: precision = \"float32\") -> Floats",
             "tf::rounded($points, $precision)",
             doc="(n, 3) the points with each coordinate rounded to the nearest number of the "
                 "precision, as float64; infinite beyond its range.",
             docs={"precision": "'float32' or 'float64'."}),
    Function("find_rounding_defects(mesh: Mesh, placed: Points) -> tuple[int, int]",
             "tf::find_rounding_defects(mesh.view(), $placed, report)",
             docs={"placed": "(V, 3)"},
             also="Returns the number of faces that have lost their area, and of pairs of faces "
                  "that meet now and did not before."),
    Function("join_equal_points(mesh: Mesh) -> Mesh"),
    # _properties
    Function("bounds(mesh: Mesh) -> Optional[Floats]", "tf::bounding_box(mesh.view().points)"),
    Function("signed_volume(mesh: Mesh) -> float", "tf::signed_volume(mesh.view())"),
    Function("surface_area(mesh: Mesh) -> float", "tf::surface_area(mesh.view())"),
    Function("find_defects(mesh: Mesh) -> MeshDefects", "tf::find_defects(mesh.view())"),
    Function("count_topology(mesh: Mesh) -> Topology",
             "tf::count_topology(mesh.view().points.size(), mesh.view().faces)"),
    Function("face_components(mesh: Mesh) -> Ids",
             "tf::face_components(mesh.view().points.size(), mesh.view().faces)"),
    Function("count_inside_out(mesh: Mesh) -> int", "tf::count_inside_out(mesh.view())"),
    Function("find_features(mesh: Mesh, kind: feature_kind = \"plane\", options: feature_options)"
             " -> list[Feature]", "tf::find_features(mesh.view(), $kind, options)",
             docs={"kind": "'plane' for the flat regions, 'axis' for the cylindrical ones."}),
    Function("find_solid_defects(mesh: Mesh) -> SolidDefects",
             "tf::find_solid_defects($mesh, report)", cpp="find_solid_defects in repair"),
    # _intersections
    Function("self_intersections(mesh: Mesh, options: intersection_options) -> FacePairs",
             "tf::self_intersections($mesh, options)", leave="move_a move_b",
             docs={"kinds": "those to look for, of `KINDS`; None is all. 'crossing': interiors "
                            "pass through each other, no shared corner; 'pierce': the same with "
                            "one shared corner; 'overlap': coplanar, with a common area; 'fold': "
                            "coplanar, on the same side of a shared edge; 'duplicate': the same "
                            "three corners; 'touching': contact without crossing; 'degenerate': "
                            "one of them has no area."}),
    Function("mesh_intersections(a: Mesh, b: Mesh, options: intersection_options) -> "
             "FacePairs",
             "tf::mesh_intersections($a, $b, options)", leave="vertices",
             docs=_MOVES | {"kinds": "those to look for, of `KINDS`; None is all."}),
    Function("faces_in_box(mesh: Mesh, min: Vector, max: Vector) -> Ids",
             "tf::faces_in_box(mesh.view(), $min, $max)", docs={"min": "(3,)", "max": "(3,)"}),
    Function("group_pairs(mesh: Mesh, pairs: PairIds, kinds: Kinds) -> list[Region]",
             "tf::group_pairs(mesh.view(), pairs_of(pairs, kinds))"),
    Function("intersection_paths(mesh: Mesh, pairs: PairIds, kinds: Kinds)"
             " -> tuple[Floats, list[tuple[Ids, bool]]]",
             "tf::intersection_paths(mesh.view(), pairs_of(pairs, kinds))"),
    Function("intersection_regions(mesh: MeshLike, found: FacePairs) -> list[Region]",
             body="_core.group_pairs(held(mesh), *pairs_of(found), progress=progress)",
             cpp="group_pairs", words={"pairs": "found"}),
    Function("intersection_curves(mesh: MeshLike, found: FacePairs) -> list[Floats]",
             body="curves(*_core.intersection_paths(held(mesh), *pairs_of(found), "
                  "progress=progress))",
             cpp="intersection_paths",
             doc="The curves along which pairs of faces meet, each (n, 3); the last point of a "
                 "closed curve is the first again. Which segments there are is exact; points are "
                 "rounded to nearest. A segment that several pairs have is there once.",
             docs={"found": "pairs of faces of `mesh` that are not degenerate."}),
    Function("self_intersections_of_file(path: Path, options: stream_search_options, "
             "communicator: Communicator = None) -> FilePairs",
             body="in_communicator(communicator, lambda all: _core.self_intersections_of_file(\n"
                  "        path_of(path), how, all, progress=progress))",
             docs={"kinds": "as for `self_intersections`.",
                   "vertices": "None: 'by_coordinates' for STL, else 'by_index'.",
                   "folder": "for the tiles; empty: beside the input. Where a run was killed, the "
                             "same call goes on.",
                   "communicator": "ranks that do it together, as for `weld_stream`; the first one "
                                   "gets the result, all others an empty one."}),
    # _files
    Function("read(path: Path | IO[bytes], format: str = \"\", *, join: bool = True, "
             "options: read_options) -> Mesh", body="read_from(path, format, join, how, progress)",
             also="Polygons are cut into triangles (`Attributes.stored_face`). A cloud has no "
                  "faces. DAE and others are read where treeform was built with assimp. Where "
                  "there is no such file, the error is a FileNotFoundError, too, and so on.",
             docs={"path": "of the file; or what is open for reading bytes, such as BytesIO.",
                   "format": "an extension without its dot; empty: the content decides, then the "
                             "extension.",
                   "join": "in a format that does not number its vertices (STL) or repeats them "
                           "(GLB), corners with equal coordinates become one vertex, with the "
                           "attributes of the first of them. Faces keep the order and the numbers "
                           "that they have in the file, and vertices, too, in other formats.",
                   "columns": "of XYZ, PTS and CSV, what columns are: {'x': 'E', 'y': 'N', 'z': "
                              "'H'}; a number counts them from 1.",
                   "drop_non_finite": "drop points with a NaN or infinite coordinate, and their "
                                      "faces."}),
    Function("write(path: Path | IO[bytes], mesh: PartsLike, options: write_options(format))"
             " -> Written", body="written(path, mesh, format, how, progress)",
             words={"file": "mesh"},
             docs={"path": "of the file; or what is open for writing bytes, such as BytesIO, with "
                           "`format`.",
                   "mesh": "one; or several, which become the parts of the file, named \"1\", "
                           "\"2\", ...; or a dict of names and meshes. 3MF and OBJ hold parts; in "
                           "other formats they are one mesh, and a warning says so. Of several, "
                           "columns of vertices and faces are left out.",
                   "rename": "columns of points under another name: {'old': 'new'}.",
                   "las_offset": "likewise.",
                   "round": "a mesh whose coordinates were certified (`Mesh.certificate`) may be "
                            "rounded further, which can undo what was certified. Otherwise that is "
                            "an error: ask the operation for `precision='float32'` instead."}),
    # _weld
    Function("count_nearly_equal(points: Points, distance: float) -> int",
             "tf::count_nearly_equal($points, distance)"),
    Function("weld(mesh_or_points: Body, options: weld_options(tolerance), "
             "label: Groups = None) -> WeldResult",
             docs=_WELD | {
                 "mesh_or_points": "a mesh, points (n, 3), or anything with `points` or `vertices` "
                                   "and no faces.",
                 "label": "(n,) numbers; points with different ones are never merged."}),
    Function("weld_stream(files: Path | Iterable[Path], out: Path, "
             "options: weld_stream_options(tolerance), removed: Path = \"\", label: str = \"\", "
             "withhold: bool = False, columns: Columns = None, mixed: bool = False, "
             "communicator: Communicator = None) -> WeldStreamResult",
             body="streamed(inputs_of(files, columns, mixed), how, out, removed, label, "
                  "withhold,\n"
                  "                    communicator, progress)",
             words={"inputs": "files", "welded": "out"},
             also="The bytes of the outputs are those of `weld` of the whole.",
             docs=_WELD | {
                 "files": "one or several, as one cloud; or one mesh.",
                 "tolerance": "as for `weld`.",
                 "keep_degenerate": "keep faces that repeat a corner.",
                 "as_las": "for `out` in LAS: coordinates, and means of them, are rounded to the "
                           "steps of that file before anything is decided of them.",
                 "memory": "bytes that the process may take; 0: three quarters of the machine's.",
                 "folder": "for tiles; empty: beside the first input. Where a run was killed, the "
                           "same call goes on.",
                 "removed": "a file for the dropped points.",
                 "label": "write all points, with the group of each in a property of this name.",
                 "withhold": "write all points, with LAS's flag \"withheld\" of those dropped.",
                 "columns": "as for `read`.",
                 "mixed": "LAS files may have other reference systems or time types than the "
                          "first, whose are written.",
                 "communicator": "ranks that do it together, each its share, in a folder that all "
                                 "see: anything with `rank`, `size` and `allgather`, such as "
                                 "`mpi4py.MPI.COMM_WORLD`. All call the same. Where one fails or "
                                 "is interrupted, all raise at the next collective call."}),
    # _nearness
    Function("closest_point(mesh: Mesh, points: Points, *, radius: float = np.inf)"
             " -> ClosestPoints", "tf::closest_point(mesh.prepared(), $points.subspan(begin, end - "
             "begin), radius)", pieces="$points.size()",
             doc="The point of the surface that is nearest to each of `points` (n, 3). Distances "
                 "are within 16 u L of the true ones, where u = 2^-53 and L is the larger of the "
                 "distance and the diagonal of the face's box. Of several faces at the same "
                 "computed distance, the lowest number is named. A Mesh keeps the index for the "
                 "next call.",
             docs={"radius": "what is further away is ignored; inclusive."}),
    Function("raycast(mesh: Mesh, origins: Points, directions: Points, *, t_min: float = 0.0, "
             "t_max: float = np.inf) -> RayHits", f"finite(tf::raycast({_PIECE}))",
             pieces=f"{_ALL_RAYS}.size()", docs=_RAYS),
    Function("raycast_any(mesh: Mesh, origins: Points, directions: Points, *, t_min: float = 0.0, "
             "t_max: float = np.inf) -> Bytes", f"tf::raycast_any({_PIECE})",
             pieces=f"{_ALL_RAYS}.size()", made="NDArray[np.bool_]", value="{}.view(np.bool_)",
             doc="(n,) bool: whether each ray hits any face. Exact.", docs=_RAYS),
    Function("deviation(a: Body, b: Body, options: deviation_options) -> Optional[Deviation]",
             "tf::deviation(a.prepared(), b.prepared(), options)",
             missing="a has no points, or b no faces",
             also="`a` and `b` are a mesh or a cloud (n, 3) each.",
             docs={"band": "signed distances that are within tolerance."}),
    Function("locate_points(mesh: Mesh, points: Points) -> tuple[Bytes, NDArray[np.int32]]",
             "tf::locate(mesh.prepared(), $points.subspan(begin, end - begin))",
             pieces="$points.size()"),
    Function("contains(mesh: MeshLike, points: ArrayLike) -> NDArray[np.bool_]",
             body="np.asarray(located(mesh, points, progress)[0] != OUTSIDE)",
             doc="(n,) bool: whether each of `points` (n, 3) is inside a closed mesh or on its "
                 "surface: inside is where the winding number is not 0. Exact, for every point. "
                 "Raises NotSolidError where the mesh is open. For other errors and cost, see "
                 "`locate`."),
    Function("locate(mesh: MeshLike, points: ArrayLike) -> NDArray[np.int8]",
             body="np.array([-1, 1, 0], np.int8)[located(mesh, points, progress)[0]]",
             also="Returns (n,) int8: 1 where a point is strictly inside, 0 on the surface, -1 "
                  "outside. Raises NotSolidError where the mesh is open.",
             docs={"points": "(n, 3)"}),
    Function("winding_number(mesh: MeshLike, points: ArrayLike) -> NDArray[np.int32]",
             body="np.asarray(located(mesh, points, progress)[1])",
             doc="(n,) int32: how often a closed mesh winds around each of `points` (n, 3); 0 on "
                 "the surface. Exact. Raises NotSolidError where the mesh is open."),
    Function("signed_distance(mesh: MeshLike, points: ArrayLike) -> Floats",
             body="distances(mesh, points, progress)", cpp="deviation",
             doc="(n,) the distance of each of `points` (n, 3) from the surface of a closed mesh; "
                 "positive inside, as in trimesh, and exactly 0 on the surface. The sign is exact. "
                 "`deviation` has the other sign, that of metrology: negative inside. Raises "
                 "NotSolidError where the mesh is open."),
    Function("raycast_all(mesh: Mesh, origins: Points, directions: Points, *, t_min: float = 0.0, "
             "t_max: float = np.inf) -> AllRayHits",
             body="all_hits(mesh, origins, directions, t_min, t_max, progress)", docs=_RAYS),
    # _placement
    _placed("slide(moving: Body, onto: Bodies, direction: Vector, options: "
            "placement_options(clearance))", "tf::slide($moving, $onto, $direction, options)",
            "bed", docs={"onto": _FIXED, "direction": "(3,) of any length.", "bed":
                         "z of a bed, which also stops the mesh: points that rest on it have "
                         "exactly its z (with float32, the least one not below it), and no point "
                         "is below."}),
    _placed("drop(moving: Body, onto: Bodies = None, *, direction: Vector = (0, 0, -1), "
            "options: placement_options)",
            "onto.empty() ? tf::drop($moving, options, $direction) : "
            "tf::drop($moving, $onto, options, $direction)", "bed",
            docs={"onto": _FIXED, "direction": "(3,) of any length, downward.",
                  "bed": "z of the bed; without fixed bodies, there is one at 0.",
                  "clearance": "As of `slide`.", "max_travel": "As of `slide`.",
                  "precision": "As of `slide`."}),
    _placed("mate(moving: Body, onto: Bodies, options: placement_options)",
            "tf::mate($moving, $onto, options)", docs={"onto": _FIXED}),
    _placed("separate(moving: Body, fixed: Bodies, options: placement_options(clearance))",
            "tf::separate($moving, $fixed, options)", "effort", docs={
                "fixed": _FIXED,
                "effort": "pairs of faces that the search may look at, a pair in motion counting "
                          "as two; 0: 20 million and 200 for each face. Distances for a clearance "
                          "do not count."}),
    _placed("turn(moving: Body, fixed: Bodies, axis: Vector, "
            "origin: Vector = (0.0, 0.0, 0.0), options: placement_options)",
            "tf::turn($moving, $fixed, $origin, $axis, options)", "max_angle tolerance",
            docs={"fixed": _FIXED, "axis": "(3,) of any length.",
                  "origin": "(3,) a point of the axis.",
                  "max_angle": "in degrees; greater than 0, up to 360.",
                  "tolerance": "the gap, beyond the clearance, that counts as contact; greater "
                               "than 0. None: 2^-32 of the largest distance of a point from the "
                               "axis."}),
    Function("measure(a: Body, b: Body, options: measure_options) -> Optional[Measure]",
             "tf::measure(a.prepared(), b.prepared(), options)",
             doc="How two bodies lie to each other: separate, touching or penetrating, how far "
                 "apart, and where. Each is a mesh or a cloud (n, 3). None where one has no faces, "
                 "or they are further apart than `radius`. The relation is exact, and so is "
                 "whether a distance is 0. Other distances are rounded as `distance` says.",
             leave="directions effort",
             docs={"vertices": "'by_coordinates': corners with equal coordinates are shared; "
                               "'by_index': those with the same number."}),
    Function("penetration_depth(a: Mesh, b: Mesh, options: measure_options) -> Optional[Depth]",
             "tf::penetration_depth(a.prepared(), b.prepared(), options)",
             leave="radius vertices",
             docs={"directions": "Directions spread over the sphere, tried besides normals of "
                                 "faces that meet.",
                   "effort": "Pairs of faces that the search may test, a pair in motion counting "
                             "as two; 0: 20 million plus 200 for each face."}),
    Function("time_of_impact(a: Mesh, b: Mesh, motion: Vector, options: impact_options) -> Impact",
             "tf::time_of_impact(a.prepared(), b.prepared(), $motion, options)",
             docs=_MOVES | {"motion": "(3,)"}),
    Function("lay_flat(mesh: Mesh, options: lay_flat_options) -> Optional[LaidFlat]",
             "tf::lay_flat(mesh.prepared(), options)", "mesh",
             missing="no side: fewer than three points, or all on a line"),
    Function("align(moving: Body, onto: Body, *, scale: bool | tuple[float, float] = False, "
             "options: align_options) -> Alignment",
             "tf::align(moving.prepared(), onto.prepared(), options)", "moving",
             given="**scale_of(scale)", leave="scale least_scale most_scale",
             docs={"scale": "find a uniform scale, too; a pair is its bounds, in addition to the "
                            "scale of `start`."}),
    Function("mate_features(moving: Body, onto: Bodies, of_moving: Feature, of_fixed: Feature, "
             "options: placement_options) -> Placement",
             "tf::mate_features($moving, $onto, of_moving, of_fixed, options)", "moving",
             words={"fixed": "onto"}, leave=_of_others("flip"),
             docs={"onto": _FIXED, "of_moving": "a plane or an axis of `find_features`.",
                   "of_fixed": "one of the same kind.",
                   "flip": "planes look the same way rather than at each other; axes are turned "
                           "around."}),
    Function("pack(parts: Parts, size: ArrayLike, options: pack_options) -> Packing",
             "tf::pack($parts, options)", "parts", "long_work",
             given="size=extent_of(size)", leave="size",
             docs={"size": "(2,) or (3,): length, depth and height of a plate."}),
    # _assembly
    Function("intersects(a: Mesh, b: Mesh, *, move_a: Poses = None, move_b: Poses = None) -> Bytes",
             cpp="intersects in intersections", docs=_POSES, made="Any",
             value="one_or_all({}.view(np.bool_), move_a, move_b)"),
    Function("distance(a: Mesh, b: Mesh, *, move_a: Poses = None, move_b: Poses = None, "
             "radius: float = np.inf) -> Floats", cpp="distance in distance", made="Any",
             docs=_POSES | {"radius": "beyond it, the distance is infinite."},
             value="one_or_all({}, move_a, move_b)"),
    Function("closest_points(a: Mesh, b: Mesh, *, move_a: Matrix = None, move_b: Matrix = None, "
             "radius: float = np.inf) -> Optional[NearestPoints]",
             "tf::closest_points(a.prepared(), b.prepared(), {$move_a, $move_b, radius})",
             docs=_MOVES | {"radius": "beyond it, the answer is None."}),
    Function("clash_parts(parts: Parts, options: clash_options, ignored: Pairs) -> ClashResult",
             "(options.ignored = $ignored, tf::clash(borrowed(parts), options))"),
    Function("clash_in_poses(parts: Parts, poses: Poses, options: clash_options, ignored: Pairs)"
             " -> PoseClashes",
             "(options.ignored = $ignored, tf::check_poses(borrowed(parts), $poses, options))"),
    Function("clash(parts: Parts, options: clash_options(clearance), poses: ArrayLike = None, "
             "ignored: PartPairs = ()) -> ClashResult",
             body="clashes(parts, poses, how, ignored, progress)", leave="first_only",
             docs={"poses": "(N, 4, 4) an affine map for each of the N parts: where it is. Corners "
                            "are rounded to float64 after it, and then exact; what is returned is "
                            "where the parts are. `check_poses` is for many poses of all.",
                   "ignored": "pairs of numbers of parts that are not looked at."}),
    Function("check_poses(parts: Parts, poses: Numbers, options: clash_options(clearance), "
             "ignored: PartPairs = ()) -> PoseClashes",
             body="clashes_in_poses(parts, poses, how, ignored, progress)",
             leave="volumes depths limit",
             docs={"poses": "(P, N, 4, 4) an affine map for each of the N parts, or (P, 4, 4) for "
                            "a single one beside parts that stay: then it moves the first.",
                   "ignored": "pairs of numbers of parts that are not looked at."}),
]
