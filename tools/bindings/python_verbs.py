"""The functions of the Python package, each with the C++ call that it makes. Everything else is
generated from the C++ headers, as described in `python_functions.py`. Functions without a call are
implemented in `src/*.cpp`; those with a `body`, in Python."""

from __future__ import annotations

from python_language import Function

_MOVES = {"transform_a": "(4, 4) an affine transform applied to `a` first.",
          "transform_b": "(4, 4) an affine transform applied to `b` first."}
_POSES = {"transform_a": "an affine transform of `a`, (4, 4), or several, (n, 4, 4). With several,"
                         " the result is an array (n,).",
          "transform_b": "likewise for `b`."}
_PLANE = {"normal": "(3,) the normal of the plane, of any length.",
          "at": "(3,) a point on the plane."}
_HEIGHTS = {"heights": "(K,) the distances of K parallel planes from this plane, measured along "
                       "its unit normal. None: this plane only."}
_RAYS = {"origins": "(n, 3) the start points of the rays; (1, 3) for all.",
         "directions": "(n, 3) of any length; (1, 3) for all.",
         "t_min": "ignore hits before origin + t_min * direction.",
         "t_max": "ignore hits beyond origin + t_max * direction."}
_ALL_RAYS = "rays(origins, directions, t_min, t_max)"
_PIECE = f"mesh.prepared(), {_ALL_RAYS}.piece(begin, end)"
_MESHES = {"meshes": "each argument is a mesh or a list of meshes."}
_VOLUMES = {"volumes": "compute the volumes of the two operands, of their union and of their "
                       "intersection."}
_FILL_RULE = {"fill_rule": "'nonzero', 'even_odd' or 'positive': the winding numbers that count "
                           "as inside."}
_SOLIDS = _VOLUMES | _FILL_RULE | {
    "merge_coplanar": "merge all coplanar faces of the result, also those not cut; but never faces "
                      "with different materials or values, nor those whose corners differ in "
                      "texture coordinates or normals."}
_WELD = {
    "same": "vertex properties that must agree for points to be merged, each with the largest "
            "difference allowed.",
    "keep_seams": "merge only points with equal normals, texture coordinates and colors, except "
                  "for those in `ignored_seams`.",
    "chain": "merge all points that are connected by a chain of points, each within the tolerance"
             " of the next. By default, a point is dropped if it is within the tolerance of an "
             "earlier point that is kept.",
    "keep": "which point of a group is kept: 'first', 'last', 'mean', or the one with the "
            "'lowest' or 'highest' value of `keep_by`.",
    "keep_by": "a vertex property.",
    "order_by": "a vertex property: visit the points in ascending order of its values. Requires "
                "`keep` 'first'. Empty: in the order of their numbers.",
    "highest_first": "visit the points in descending order of `order_by`.",
    "ignored_seams": "properties that `keep_seams` ignores."}
_WELD_STREAM = _WELD | {
    "files": "one or several files of points, read as one cloud; or one file of a "
             "mesh.",
    "tolerance": "as for `weld`.",
    "keep_degenerate": "keep faces that have the same vertex more than once.",
    "as_las": "if `out` is a LAS file: round the coordinates, and means of "
              "coordinates, to the resolution of that file before they are compared.",
    "memory": "memory limit of the process, in bytes; 0: three quarters of the "
              "memory of the machine.",
    "columns": "as for `read`.",
    "mixed": "allow LAS files with different coordinate reference systems or time "
             "types. The output has those of the first file."}
_SEARCH = {"kinds": "as for `self_intersections`.",
           "vertices": "None: 'by_coordinates' for STL, otherwise 'by_index'."}
_IN_STEPS = ("`{}` in steps, for many processes on one machine or on several that share a folder, "
             "such as those of Dask, Slurm or `multiprocessing`.\n\nAll processes create it with "
             "the same arguments. One process calls `scatter`; then each calls `{}` for some of "
             "the tiles; when all tiles are finished, one calls `finish` and `remove_folder`. "
             "Tiles that are finished are not {} again.")
_FIXED = "a fixed body, or a list of them."
_BODIES = "`a` and `b` are each a mesh or a cloud (n, 3). Points of a cloud count as faces."

#: A set operation by its name.
def _operation(name: str, what: str, leave: str = "gap",
               docs: dict[str, str] = {}) -> Function:  # noqa: B006
    return Function(f"{name}(*meshes: Operands, options: boolean_options) -> BooleanResult",
                    doc=what, leave=leave, docs=_MESHES | _SOLIDS | docs,
                    cpp="boolean", check="solids",
                    body=f'combined("{name}", meshes, how, progress)')


def _from(library: str, takes: str, doc: str) -> Function:
    return Function(f"from_{library}(mesh: {takes}) -> Mesh", body="as_mesh(mesh)", doc=doc,
                    progress=False)


def _of_others(own: str) -> str:
    "Options that only some placement functions have, except for `own`."
    return " ".join(sorted({"bed", "effort", "flip", "max_angle", "tolerance"} - {*own.split()}))


def _placed(signature: str, call: str, own: str = "", **more: dict[str, str]) -> Function:
    words = {"direction": "axis"} if "axis:" in signature else {}
    return Function(f"{signature} -> Placement", call, "moving",
                    leave=_of_others(own) + (" max_travel" if "axis:" in signature else ""),
                    words=words, **more)


FUNCTIONS = [
    # _booleans
    _operation("union", "The union of solids: `union(a, b, ...)`, or `union([a, b, "
                                 "...])` as in trimesh. The union of a single mesh is the solid "
                                 "that it encloses, without self-intersections. See `boolean`.",
               "", {
                   "gap": "fill gaps of at most this width between faces of different solids that"
                          " face each other. The faces that bound a filled gap come last; their "
                          "`face_source` is the face at the end of the gap, or the one opposite. "
                          "`filled_faces` of `statistics` counts the faces at filled gaps. Not "
                          "together with `volumes`."}),
    _operation("intersection", "The intersection of solids: the region that all "
                                               "of them share. If a single mesh was read from a "
                                               "file with several objects, these are the "
                                               "operands, as in `difference`. See `boolean`."),
    _operation("difference", "The first solid minus all others: `difference(a, b, "
                                           "c)`, or `difference(a, [b, c])`. If a single mesh was"
                                           " read from a file with several objects "
                                           "(`attributes.parts`), the other objects are "
                                           "subtracted from the first, as in tf-boolean; "
                                           "`face_source` and `vertex_source` then have the "
                                           "number of the object and the number within it. From a"
                                           " single mesh without such objects, nothing is "
                                           "subtracted. See `boolean`."),
    _operation("symmetric_difference", "The symmetric difference (exclusive or) of solids:"
                                              " the region inside an odd number of them. If a "
                                              "single mesh was read from a file with several "
                                              "objects, these are the operands, as in "
                                              "`difference`. See `boolean`."),
    Function("boolean(expression: str, *operands: Operands, options: boolean_options, "
             "**meshes: Mesh) -> BooleanResult",
             body="by_formula(expression, operands, meshes, how, progress)",
             check="solids", leave="gap",
             also="Attributes of the operands are carried over. A face gets the values of the "
                  "operand face that it lies in; a new vertex on a cut gets interpolated values. "
                  "The value is 0 or NaN if an operand does not have the attribute. Coplanar "
                  "faces are merged only if their values are equal; faces whose corners differ in "
                  "texture coordinates or normals are never merged, and if vertices have values, "
                  "faces are merged only with `merge_coplanar`.",
             docs=_SOLIDS | {
                   "expression": "a formula of `operands`, named `a`, `b`, `c`, ..., and of "
                                 "`meshes` by their names: `+` or `|` for union, `*` or `&` for "
                                 "intersection, `-` for difference, `^` for exclusive or, and "
                                 "parentheses. `*` and `&` are evaluated first, the others from "
                                 "left to right."}),
    Function("clip(sheet: Mesh, *solids: Operands, keep: str = \"outside\", options: "
             "boolean_options)"
             " -> BooleanResult", body="clipped(sheet, solids, keep, how, progress)",
             check="solids", leave="gap min_volume merge_coplanar volumes",
             doc="Trims an open surface with solids, given one by one or as a list: returns the "
                 "parts of `sheet` outside all of them, or inside all of them. The sheet may have"
                 " any border, may intersect itself, and may even be closed. The result is an "
                 "open surface, so its edges are not checked.",
             docs=_FILL_RULE | {
                   "keep": "'outside' or 'inside'. Parts on the surface of a solid count as "
                           "inside it. So for one solid, the two results together are the whole "
                           "sheet."}),
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
             leave="fill_rule keep_cuts merge_coplanar volumes min_volume gap"),
    Function("check_operand(mesh: Mesh) -> Certificate",
             'require_faces(mesh, "mesh"), tf::check_operand(mesh.view(), report)'),
    # _cuts
    Function("section(mesh: Mesh, normal: Vector = (0, 0, 1), at: Vector = (0, 0, 0), *, "
             "heights: Heights = None) -> Section",
             "tf::section($mesh, {$at, $normal}, $heights, report)", docs=_PLANE | _HEIGHTS),
    Function("layer_heights(mesh: Mesh, thickness: float, normal: Vector = (0, 0, 1), "
             "at: Vector = (0, 0, 0)) -> Floats",
             "tf::oriented_plane{$at, $normal}.layer_heights(mesh.view().points, thickness)",
             doc="(K,) heights for `section`: the middle of each layer of this thickness, from "
                 "the lowest vertex to the highest. The first height is half a thickness above "
                 "the lowest vertex. Vertices that are not finite are ignored.", docs=_PLANE),
    Function("cut(mesh: Mesh, normal: Vector = (0, 0, 1), at: Vector = (0, 0, 0), *, "
             "heights: Heights = None, options: cut_options) -> CutPieces",
             "tf::cut($mesh, {$at, $normal}, $heights, options)", "attributes of mesh",
             check="solid", docs=_PLANE | _HEIGHTS,
             also="One plane cuts a solid into the piece below and the piece above it; K "
                  "`heights` give K + 1 pieces, from bottom to top. A piece may be empty."),
    Function("cut_to_fit(mesh: Mesh, size: Vector, options: cut_options)"
             " -> CutPieces", "tf::cut_to_fit($mesh, $size, options)",
             "attributes of mesh", check="solid",
             docs={"size": "(3,) the size of the box, such as the build volume of a printer."}),
    Function("cut_along(mesh: Mesh, values: Numbers, levels: Levels)"
             " -> CutPieces",
             "tf::cut_along($mesh, $values, $levels, {.progress = report})", "attributes of mesh",
             check="mesh",
             docs={"values": "(V,) a value for each vertex, interpolated linearly over each face.",
                   "levels": "(K,) the values to cut at."}),
    Function("components(mesh: Mesh, *, min_volume: float = 0.0, largest: int = 0)"
             " -> list[MeshPart]", "tf::components($mesh, min_volume, largest)",
             "attributes of mesh",
             docs={"min_volume": "ignore components with a smaller volume, in cubic units.",
                   "largest": "return only this many of the largest components; 0: all."}),
    Function("submesh(mesh: Mesh, faces: Chosen) -> MeshPart", "tf::submesh($mesh, $faces)",
             "attributes of mesh", also="Vertices keep their attributes.",
             docs={"faces": "(n,) face numbers, or a boolean mask (F,)."}),
    Function("mass_properties(mesh: Mesh) -> Optional[MassProperties]",
             "tf::find_mass_properties(mesh.view())"),
    Function("concatenate(meshes: Iterable[MeshLike]) -> Mesh", body="joined(meshes, progress)",
             also="Their attributes are concatenated as well."),
    Function("transformed(mesh: Mesh, matrix: Matrix) -> Mesh", cpp="transform_mesh",
             words={"by": "matrix"},
             also="Attributes are kept, and normals are transformed as well.",
             docs={"matrix": "(4, 4) an affine transform."}),
    # _shapes
    Function("offset(mesh: Mesh, distance: float, options: offset_options) -> OffsetResult",
             "tf::offset($mesh, distance, options)", kind="long_work", check="solid",
             leave="offset shift"),
    Function("hollow(mesh: Mesh, wall: float, *, drains: Drains = (), options: offset_options) "
             "-> OffsetResult",
             "tf::hollow($mesh, wall, with_drains(options, $drains))", kind="long_work",
             check="solid",
             leave="offset shift",
             docs={"drains": "(n, 4) drain holes through the wall: for each, a point and a "
                             "diameter. The hole is at the surface point nearest to that point."}),
    Function("thicken(mesh: Mesh, thickness: float, options: offset_options) -> OffsetResult",
             "tf::thicken($mesh, thickness, options)", kind="long_work", check="mesh",
             leave="offset",
             docs={"shift": "move the surface by this distance before thickening: toward its "
                            "front if positive, toward its back if negative. By default, half of "
                            "the thickness is added on each side; with half of the thickness as "
                            "`shift`, all of it is added on the front."}),
    Function("simplify(mesh: Mesh, max_distance: float, *, face_groups: Groups = None, "
             "options: simplify_options) -> SimplifyResult",
             "attributes.simplify($mesh, max_distance, $face_groups, options)",
             "attributes of mesh", kind="long_work", check="mesh", cpp="simplify",
             also="Values of vertices and corners are interpolated. Seams, and borders between "
                  "faces with different materials or values, are preserved.",
             docs={"face_groups": "(F,) a group number for each face; borders between groups are "
                                  "preserved, too."}),
    Function("wall_thickness(mesh: Mesh, by: thickness_by = \"ray\") -> Thickness",
             "tf::wall_thickness($mesh, $by, report)",
             docs={"by": "'ray': along the inward normal from the center of each face; 'sphere': "
                         "the diameter of the largest inscribed sphere that touches the center of"
                         " the face."}),
    Function("oriented_box(points: Cloud) -> Optional[OrientedBox]",
             "tf::find_oriented_box($points)", docs={"points": "points (n, 3), or a mesh."}),
    Function("isolines(mesh: Mesh, values: Numbers, levels: Levels) -> Isolines",
             "tf::isolines($mesh, $values, $levels, report)",
             docs={"values": "(V,) a value for each vertex, interpolated linearly over each face.",
                   "levels": "(K,) the values of the lines."}),
    # _repair
    Function("resolve_self_intersections(mesh: Mesh, mode: resolve_mode = \"outer\", "
             "options: resolve_options) -> RepairResult",
             "tf::resolve_self_intersections($mesh, $mode, options)", "attributes of mesh",
             check="solid",
             docs=_FILL_RULE | {
                   "mode": "'outer' cuts faces along their intersections and keeps those that "
                           "bound the solid; 'split' keeps all pieces; 'remove', for surfaces "
                           "that do not bound a solid, deletes intersecting faces and fills the "
                           "holes."}),
    Function("repair(mesh: Mesh, *, steps: Iterable[str] = STEPS, options: repair_options)"
             " -> RepairResult", "tf::repair($mesh, options)", "attributes of mesh",
             check="repaired", given="**steps_of(steps)", leave="join orient fill resolve detach",
             docs={"steps": "the steps to perform. 'join' removes degenerate and duplicate faces "
                            "and closes cracks; 'orient' orients faces consistently and outward; "
                            "'fill' fills holes; 'resolve' removes self-intersections; 'detach' "
                            "separates parts that touch only at an edge or a vertex.",
                   "keep_cuts": "as in `boolean`; faces that fill holes are only merged with each"
                                " other.",
                   "fill_rule": "'nonzero', 'even_odd' or 'positive': the winding numbers that "
                                "count as inside. None: 'positive' if all shells are oriented "
                                "outward, otherwise 'nonzero'; if faces are inconsistent, inside "
                                "and outside are determined by a minimum cut."}),
    Function("wrap(mesh: Mesh, size: float, options: offset_options) -> OffsetResult",
             "tf::wrap($mesh, size, options)", kind="long_work", check="mesh",
             leave="resolution shift",
             docs={"offset": "the distance of the wrap's vertices from the mesh, in its length "
                             "unit. None: a thirtieth of `size`."}),
    Function("convex_hull(points: Cloud) -> ConvexHull", "tf::convex_hull($points, report)",
             "points_of(points)",
             docs={"points": "points (n, 3), or a mesh."}),
    Function("rounded(points: Points, precision: precision = \"float32\") -> Floats",
             "tf::rounded($points, $precision)",
             doc="(n, 3) the points with each coordinate rounded to the nearest value of this "
                 "precision, as float64; infinite if it is out of range.",
             docs={"precision": "'float32' or 'float64'."}),
    Function("find_rounding_defects(mesh: Mesh, placed: Points) -> tuple[int, int]",
             "tf::find_rounding_defects(mesh.view(), $placed, report)",
             docs={"placed": "(V, 3) the rounded vertices."},
             doc="The number of faces that become degenerate, and the number of pairs of faces "
                 "that newly meet (all kinds except touching and degenerate), when the vertices "
                 "of `mesh` become `placed`. Exact. Distances are not compared, so `placed` may "
                 "also be moved and rotated."),
    Function("join_equal_points(mesh: Mesh) -> Mesh"),
    # _properties
    Function("bounds(mesh: Mesh) -> Optional[Floats]", "tf::bounding_box(mesh.view().points)"),
    Function("signed_volume(mesh: Mesh) -> float", "tf::signed_volume(mesh.view())"),
    Function("surface_area(mesh: Mesh) -> float", "tf::surface_area(mesh.view())"),
    Function("find_invalid_faces(mesh: Mesh) -> InvalidFaces",
             "tf::find_invalid_faces(mesh.view())"),
    Function("count_topology(mesh: Mesh) -> Topology",
             "tf::count_topology(mesh.view().points.size(), mesh.view().faces)"),
    Function("face_components(mesh: Mesh) -> Ids",
             "tf::face_components(mesh.view().points.size(), mesh.view().faces)"),
    Function("count_inside_out(mesh: Mesh) -> int", "tf::count_inside_out(mesh.view())"),
    Function("find_features(mesh: Mesh, kind: feature_kind = \"plane\", options: feature_options)"
             " -> list[Feature]", "tf::find_features(mesh.view(), $kind, options)",
             docs={"kind": "'plane' for flat regions, 'axis' for cylindrical ones."}),
    Function("find_solid_defects(mesh: Mesh) -> SolidDefects",
             "tf::find_solid_defects($mesh, report)", cpp="find_solid_defects in repair"),
    # _intersections
    Function("self_intersections(mesh: Mesh, options: face_pair_options) -> FacePairs",
             "tf::self_intersections($mesh, options)", leave="transform_a transform_b",
             also="The defaults differ from those of the tool tf-selfintersect. Here, touching and "
                  "degenerate pairs are included, and corners with equal coordinates are one "
                  "vertex; the tool leaves out such pairs, and uses the vertex numbers of the "
                  "file, if it has any. `kinds` and `vertices` change this.",
             docs={"kinds": "the kinds to search for, from `KINDS`; None: all. 'crossing': the "
                            "faces pass through each other and share no vertex; 'pierce': "
                            "likewise, with one shared vertex; 'overlap': coplanar, with a common"
                            " area; 'fold': coplanar, on the same side of a shared edge; "
                            "'duplicate': the same three vertices; 'touching': contact without "
                            "crossing; 'degenerate': a face has no area."}),
    Function("mesh_intersections(a: Mesh, b: Mesh, options: face_pair_options) -> "
             "FacePairs",
             "tf::mesh_intersections($a, $b, options)", leave="vertices",
             docs=_MOVES | {"kinds": "the kinds to search for, from `KINDS`; None: all."}),
    Function("faces_in_box(mesh: Mesh, min: Vector, max: Vector) -> Ids",
             "tf::faces_in_box(mesh.view(), $min, $max)",
             docs={"min": "(3,) the lower corner of the box.",
                   "max": "(3,) the upper corner of the box."}),
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
             doc="The curves along which pairs of faces intersect, each (n, 3); a closed curve "
                 "repeats its first point at the end. Segments are found exactly; their points "
                 "are rounded to nearest. A segment common to several pairs appears only once. "
                 "Degenerate pairs have no curve.",
             docs={"found": "pairs of faces of `mesh`."}),
    Function("write_curve_file(path: File, mesh: Mesh, pairs: PairIds, kinds: Kinds, format: str)"
             " -> None",
             "tf::write_curves(path, mesh.view(), pairs_of(pairs, kinds), {}, format)",
             kind="writes"),
    Function("write_curves(path: Path, mesh: MeshLike, found: FacePairs, format: str = \"\")"
             " -> None",
             body="_core.write_curve_file(path_of(path), held(mesh), *pairs_of(found),\n"
                  "                           "
                  "_arrays.word(format, \"format\"), progress=progress)",
             cpp="write_curves", words={"pairs": "found"},
             doc="Writes the curves along which pairs of faces intersect as polylines, joined as "
                 "in `intersection_curves`. Degenerate pairs have single segments.",
             docs={"path": "the path of the file; \"-\" is standard output.",
                   "found": "pairs of faces of `mesh`.",
                   "format": "'obj' (`v` and `l`) or 'ply' (text, with an element `edge`); empty: "
                             "the extension of `path`."}),
    Function("self_intersections_of_file(path: Path, options: file_search_options, "
             "communicator: Communicator = None) -> FilePairs",
             body="in_communicator(communicator, lambda all: _core.self_intersections_of_file(\n"
                  "        path_of(path), how, all, progress=progress))",
             docs=_SEARCH | {
                   "folder": "the folder for temporary tiles; empty: a folder next to the input. "
                             "If a run was interrupted, the same call resumes it.",
                   "communicator": "processes that share the work, as for `weld_stream`. Rank 0 "
                                   "gets the result, all others an empty one."}),
    Function("SharedSearch(path: Path, options: file_search_options) -> None",
             steps="SearchInSteps",
             doc=_IN_STEPS.format("self_intersections_of_file", "search_tile", "searched"),
             also="The folder is locked until `close`, the end of a `with` block, or the end of "
                  "the object. Pickling stores only the arguments. Steps in the wrong order raise "
                  "FileError, invalid tiles IndexError.",
             docs=_SEARCH | {
                 "path": "the path of the file.",
                 "folder": "the folder for the tiles; empty: the name of the input with "
                           "\".search-tiles\"."}),
    # _files
    Function("read(path: Path | IO[bytes], format: str = \"\", *, join: bool = True, "
             "options: read_options) -> Mesh", body="read_from(path, format, join, how, progress)",
             also="Each of `Attributes.warnings` is also a warning of Python (`warnings.warn`). "
                  "Polygons are triangulated (`Attributes.face_of_triangle`). A point cloud has no "
                  "faces. DAE and some other formats require a build with assimp. If the file "
                  "does not exist, the FileError is also a FileNotFoundError, and likewise for "
                  "other system errors.",
             docs={"path": "the path of the file, or a binary file object, such as BytesIO.",
                   "format": "a file extension without its dot; empty: determined by the content,"
                             " then by the extension.",
                   "join": "for formats that have no vertex numbers (STL) or repeat vertices "
                           "(GLB), merge corners with equal coordinates into one vertex, which "
                           "has the attributes of the first of them. Faces keep their numbers in "
                           "the file; in other formats, so do vertices.",
                   "columns": "for XYZ, PTS and CSV, which column of the file to use for which "
                              "property: {'x': 'E', 'y': 'N', 'z': 'H'}; columns can also be "
                              "given by number, from 1.",
                   "drop_non_finite": "drop points with a NaN or infinite coordinate, and their "
                                      "faces."}),
    Function("file_parts(mesh: Mesh, *, combine_patches: bool = False) -> dict[str, Mesh]",
             doc="The parts of a mesh that was read from a file, by name: the objects, groups or "
                 "nodes of the file. Each has its own vertices and faces, and their attributes. "
                 "Parts without a name are \"1\", \"2\", ... For the connected parts of any mesh, "
                 "see `components`.",
             docs={"combine_patches": "combine parts with a common vertex, or whose open edges "
                                      "coincide: the patches of one surface."}),
    Function("write(path: Path | IO[bytes], mesh: PartsLike, options: write_options(format))"
             " -> Written", body="written(path, mesh, format, how, progress)",
             words={"file": "mesh"},
             also="A result that is not certified is refused (NotCertifiedError, NotClosedError): "
                  "pass its `mesh` to write that. "
                  "Names of material and texture files are relative to the folder of `path`; in "
                  "a file object, as in the input. Each of `Written.warnings` is also a warning "
                  "of Python (`warnings.warn`).",
             docs={"path": "the path of the file, or a binary file object, such as BytesIO, with "
                           "`format`.",
                   "mesh": "a mesh, or a cloud (n, 3); or several meshes, which become parts of "
                           "the file, named \"1\", \"2\", ...; or a dict of names and meshes. "
                           "3MF and OBJ can store parts; in other formats they become one mesh, "
                           "with a warning. With several meshes, columns of vertices and faces "
                           "are not written.",
                   "rename": "new names for columns of points: {'old': 'new'}.",
                   "las_offset": "likewise.",
                   "round": "allow rounding certified coordinates (`Mesh.certificate`) to the "
                            "precision of the file. The rounded mesh may no longer have the "
                            "certified properties, so this is an error by default: compute the "
                            "result with `precision='float32'` instead."}),
    # _from_others
    _from("trimesh", "HasFaces", "A Mesh with the arrays of a `trimesh.Trimesh`, or of any other "
                                 "object that is accepted as a mesh."),
    _from("open3d", "HasTriangles | HasTensors", "A Mesh with the arrays of a TriangleMesh of "
                                                 "`open3d.geometry` or `open3d.t.geometry`."),
    _from("pyvista", "HasFaces | HasCells", "A Mesh with the triangles of a `pyvista.PolyData` or "
                                            "grid; each quad is cut into two triangles."),
    _from("vtk", "HasPolys", "A Mesh with the triangles of a `vtkPolyData`; each quad is cut into "
                             "two triangles."),
    _from("meshio", "HasCells", "A Mesh with the triangles of a `meshio.Mesh`; each quad is cut "
                                "into two triangles."),
    # _robots
    Function("read_urdf(path: File, *, package_folders: Folders = (), visual: bool = False)"
             " -> Robot",
             doc="Reads a robot from a URDF file, with its meshes. Joints are fixed, revolute, "
                 "continuous or prismatic. Boxes are exact. Cylinders and spheres become triangles "
                 "around them, at most 0.13 % of the radius too large, so that no collision is "
                 "missed. Faces that are not finite are dropped, and equal vertices merged.",
             docs={"path": "the path of the file.",
                   "package_folders": "where to look for packages: `package://name/rest` is "
                                      "FOLDER/name/rest or FOLDER/rest, otherwise relative to the "
                                      "folder of the file or one above it.",
                   "visual": "use the visual meshes instead of the collision meshes."}),
    # _weld
    Function("count_nearly_equal(points: Points, distance: float) -> int",
             "tf::count_nearly_equal($points, distance)"),
    Function("weld(mesh_or_points: MeshOrCloud, options: weld_options(tolerance), "
             "label: Groups = None) -> WeldResult",
             docs=_WELD | {
                 "mesh_or_points": "a mesh, points (n, 3), or an object with `points` or "
                                   "`vertices` and no faces.",
                 "label": "(n,) a label for each point; points with different labels are never "
                          "merged."}),
    Function("weld_stream(files: Path | Iterable[Path], out: Path, "
             "options: weld_stream_options(tolerance), removed: Path = \"\", label: str = \"\", "
             "withhold: bool = False, columns: Columns = None, mixed: bool = False, "
             "communicator: Communicator = None) -> WeldStreamResult",
             body="streamed(inputs_of(files, columns, mixed), how, out, removed, label, "
                  "withhold,\n"
                  "                    communicator, progress)",
             words={"inputs": "files", "welded": "out"},
             also="The outputs are the same, byte for byte, as those of `weld` for the whole "
                  "input.",
             docs=_WELD_STREAM | {
                 "folder": "the folder for temporary tiles; empty: a folder next to the first "
                           "input. If a run was interrupted, the same call resumes it.",
                 "removed": "a file for the dropped points.",
                 "label": "write all points, with the number of their group as a property of this"
                          " name.",
                 "withhold": "write all points, and set the LAS flag \"withheld\" for those "
                             "dropped.",
                 "communicator": "processes that share the work, in a folder that all can access:"
                                 " an object with `rank`, `size` and `allgather`, such as "
                                 "`mpi4py.MPI.COMM_WORLD`. All processes make the same call. If "
                                 "one fails or is interrupted, all others raise an error at their"
                                 " next collective call."}),
    Function("SharedWeld(files: Path | Iterable[Path], options: weld_stream_options(tolerance), "
             "columns: Columns = None, mixed: bool = False) -> None", steps="WeldInSteps",
             doc=_IN_STEPS.format("weld_stream", "weld_tile", "welded"),
             also="The folder is locked until `close`, the end of a `with` block, or the end of "
                  "the object; `finish` requires that all others have unlocked it. Pickling stores "
                  "only the arguments. Steps in the wrong order raise FileError, invalid tiles "
                  "IndexError. After Cancelled, create a new object.",
             docs=_WELD_STREAM | {
                 "folder": "the folder for the tiles; empty: the name of the first input with "
                           "\".tiles\"."}),
    # _nearness
    Function("closest_point(mesh: MeshOrCloud, points: Points, *, radius: float = np.inf)"
             " -> ClosestPoints", "tf::closest_point(mesh.prepared(), $points.subspan(begin, end - "
             "begin), radius)", pieces="$points.size()",
             doc="The point on the surface nearest to each of `points` (n, 3). The error of a "
                 "distance is at most 16 u L, where u = 2^-53 and L is the larger of the distance"
                 " and the diagonal of the bounding box of the face. If several faces have the "
                 "same computed distance, the one with the lowest number is returned. A Mesh "
                 "keeps the index for later calls.",
             docs={"radius": "ignore points on the surface that are farther away than this."}),
    Function("raycast(mesh: Mesh, origins: Points, directions: Points, *, t_min: float = 0.0, "
             "t_max: float = np.inf) -> RayHits", f"finite(tf::raycast({_PIECE}))",
             pieces=f"{_ALL_RAYS}.size()", docs=_RAYS),
    Function("raycast_any(mesh: Mesh, origins: Points, directions: Points, *, t_min: float = 0.0, "
             "t_max: float = np.inf) -> Bytes", f"tf::raycast_any({_PIECE})",
             pieces=f"{_ALL_RAYS}.size()", made="NDArray[np.bool_]", value="{}.view(np.bool_)",
             doc="(n,) bool: whether each ray hits any face. Exact.", docs=_RAYS),
    Function("deviation(a: MeshOrCloud, b: MeshOrCloud, options: deviation_options) "
             "-> Optional[Deviation]",
             "tf::deviation(a.prepared(), b.prepared(), options)",
             missing="a has no points, or b no faces",
             also="`a` and `b` are each a mesh or a cloud (n, 3).",
             docs={"band": "the lowest and highest signed distance that are within tolerance."}),
    Function("locate_points(mesh: Mesh, points: Points) -> tuple[Bytes, NDArray[np.int32]]",
             "tf::locate(mesh.prepared(), $points.subspan(begin, end - begin))",
             pieces="$points.size()"),
    Function("contains(mesh: MeshLike, points: ArrayLike) -> NDArray[np.bool_]",
             body="np.asarray(located(mesh, points, progress)[0] != OUTSIDE)",
             doc="(n,) bool: whether each of `points` (n, 3) is inside a closed mesh or on its "
                 "surface. A point is inside if its winding number is not 0. Exact for every "
                 "point. Raises NotClosedError if the mesh is open. For other errors and the cost,"
                 " see `locate`."),
    Function("locate(mesh: MeshLike, points: ArrayLike) -> NDArray[np.int8]",
             body="np.array([-1, 1, 0], np.int8)[located(mesh, points, progress)[0]]",
             also="Returns (n,) int8: 1 for points strictly inside, 0 for points on the surface, "
                  "-1 for points outside. The error for an open mesh is a NotClosedError.",
             docs={"points": "(n, 3) the points to locate."}),
    Function("winding_number(mesh: MeshLike, points: ArrayLike) -> NDArray[np.int32]",
             body="np.asarray(located(mesh, points, progress)[1])",
             doc="(n,) int32: the winding number of a closed mesh around each of `points` (n, 3);"
                 " 0 for points on the surface. Exact. Raises NotClosedError if the mesh is open."),
    Function("signed_distance(mesh: MeshLike, points: ArrayLike) -> Floats",
             body="distances(mesh, points, progress)",
             doc="(n,) the signed distance of each of `points` (n, 3) from the surface of a "
                 "closed mesh: positive inside, as in trimesh, negative outside, and exactly 0 on"
                 " the surface. The sign is exact. `deviation` uses the opposite sign, as "
                 "metrology does. Raises NotClosedError if the mesh is open. For other errors and "
                 "the cost, see `closest_point` and `locate`."),
    Function("raycast_all(mesh: Mesh, origins: Points, directions: Points, *, t_min: float = 0.0, "
             "t_max: float = np.inf) -> AllRayHits",
             body="all_hits(mesh, origins, directions, t_min, t_max, progress)", docs=_RAYS),
    # _placement
    _placed("slide(moving: MeshOrCloud, fixed: Bodies, direction: Vector, options: "
            "placement_options(clearance))", "tf::slide($moving, $fixed, $direction, options)",
            "bed", docs={"fixed": _FIXED,
                         "direction": "(3,) the direction of motion, of any length.",
                         "bed":
                         "z of a bed, which also stops the mesh: points resting on the bed have "
                         "exactly this z (for float32, the smallest value not below it), and no "
                         "point is below it."}),
    _placed("drop(moving: MeshOrCloud, fixed: Bodies = None, *, direction: Vector = (0, 0, -1), "
            "options: placement_options)",
            "fixed.empty() ? tf::drop($moving, options, $direction) : "
            "tf::drop($moving, $fixed, options, $direction)", "bed",
            doc="Moves `moving` down until it rests on the bed or on one of `fixed`. A mesh "
                "below the bed moves up to it, against the direction; but with `fixed`, it has no "
                "place.",
            docs={"fixed": _FIXED, "direction": "(3,) the downward direction, of any length.",
                  "bed": "z of the bed. None: no bed if there are fixed bodies, otherwise a bed "
                         "at 0.",
                  "clearance": "as for `slide`.", "max_travel": "as for `slide`.",
                  "precision": "as for `slide`."}),
    _placed("mate(moving: MeshOrCloud, fixed: Bodies, options: placement_options)",
            "tf::mate($moving, $fixed, options)", docs={"fixed": _FIXED}),
    _placed("separate(moving: MeshOrCloud, fixed: Bodies, options: placement_options(clearance))",
            "tf::separate($moving, $fixed, options)", "effort", docs={
                "fixed": _FIXED,
                "effort": "limit for the number of pairs of faces that the search examines, where"
                          " a pair in motion counts as two; 0: 20 million, plus 200 for each "
                          "face. Distance computations for a clearance are not counted."}),
    _placed("turn(moving: MeshOrCloud, fixed: Bodies, axis: Vector, "
            "origin: Vector = (0.0, 0.0, 0.0), options: placement_options)",
            "tf::turn($moving, $fixed, $origin, $axis, options)", "max_angle tolerance",
            docs={"fixed": _FIXED, "axis": "(3,) the direction of the axis, of any length.",
                  "origin": "(3,) a point on the axis.",
                  "max_angle": "the largest rotation, in degrees; greater than 0 and at most 360.",
                  "tolerance": "the largest gap, beyond the clearance, that counts as contact; "
                               "greater than 0. None: 2^-32 of the largest distance of a point "
                               "from the axis."}),
    Function("measure(a: MeshOrCloud, b: MeshOrCloud, options: measure_options) "
             "-> Optional[Measure]",
             "tf::measure(a.prepared(), b.prepared(), options)",
             doc="The relation of two bodies (disjoint, touching or penetrating), their distance,"
                 " and the nearest points. Each body is a mesh or a cloud (n, 3). Returns None if"
                 " a mesh has no faces, or if the bodies are farther apart than `radius`. The "
                 "relation is exact, and so is whether the distance is 0. Other distances are "
                 "rounded as in `distance`.",
             leave="directions effort",
             docs={"radius": "ignore bodies farther apart than this; inclusive.",
                   "vertices": "'by_coordinates': vertices with equal coordinates are the same "
                               "vertex; 'by_index': only those with the same number."}),
    Function("penetration_depth(a: MeshOrCloud, b: MeshOrCloud, options: measure_options) "
             "-> Optional[Depth]",
             "tf::penetration_depth(a.prepared(), b.prepared(), options)",
             leave="radius vertices",
             docs={"directions": "the number of directions, spread over the sphere, to try in "
                                 "addition to the normals of intersecting faces.",
                   "effort": "limit for the number of pairs of faces that the search examines, "
                             "where a pair in motion counts as two; 0: 20 million, plus 200 for "
                             "each face."}),
    Function("time_of_impact(a: MeshOrCloud, b: MeshOrCloud, motion: Vector, options: "
             "impact_options) -> Impact",
             "tf::time_of_impact(a.prepared(), b.prepared(), $motion, options)",
             also=_BODIES,
             docs=_MOVES | {"motion": "(3,) the translation of `a` in one unit of time."}),
    Function("lay_flat(mesh: Mesh, options: lay_flat_options) -> Optional[LaidFlat]",
             "tf::lay_flat(mesh.prepared(), options)", "mesh",
             missing="no flat side: fewer than three points, or all on a line"),
    Function("align(moving: MeshOrCloud, fixed: MeshOrCloud, *, scale: bool | "
             "tuple[float, float] = False, options: align_options) -> Alignment",
             "tf::align(moving.prepared(), fixed.prepared(), options)", "moving",
             given="**scale_of(scale)", leave="scale least_scale most_scale",
             docs={"scale": "also find a uniform scale; a pair gives its lower and upper bound, "
                            "relative to the scale of `start`."}),
    Function("mate_features(moving: MeshOrCloud, fixed: Bodies, of_moving: Feature, of_fixed: "
             "Feature, options: placement_options) -> Placement",
             "tf::mate_features($moving, $fixed, of_moving, of_fixed, options)", "moving",
             leave=_of_others("flip"),
             docs={"fixed": _FIXED, "of_moving": "a plane or an axis found by `find_features`.",
                   "of_fixed": "one of the same kind.",
                   "flip": "make the normals of the planes point in the same direction instead of"
                           " in opposite directions; for axes, reverse the direction."}),
    Function("pack(parts: Parts, size: ArrayLike, options: pack_options) -> Packing",
             "tf::pack($parts, options)", "parts", "long_work",
             given="size=extent_of(size)", leave="size",
             docs={"size": "(2,) or (3,) the width, depth and height of a plate."}),
    # _assembly
    Function("intersects(a: MeshOrCloud, b: MeshOrCloud, *, transform_a: Poses = None, "
             "transform_b: Poses = None) -> Bytes",
             cpp="intersects in intersections", also=_BODIES, docs=_POSES, made="Any",
             value="one_or_all({}.view(np.bool_), transform_a, transform_b)"),
    Function("distance(a: MeshOrCloud, b: MeshOrCloud, *, transform_a: Poses = None, "
             "transform_b: Poses = None, radius: float = np.inf) -> Floats",
             cpp="distance in distance", made="Any", also=_BODIES,
             docs=_POSES | {"radius": "larger distances are returned as infinite."},
             value="one_or_all({}, transform_a, transform_b)"),
    Function("closest_pair(a: MeshOrCloud, b: MeshOrCloud, *, transform_a: Matrix = None, "
             "transform_b: Matrix = None, radius: float = np.inf) -> Optional[ClosestPair]",
             "tf::closest_pair(a.prepared(), b.prepared(), {$transform_a, $transform_b, radius})",
             also=_BODIES,
             docs=_MOVES | {"radius": "return None if the meshes are farther apart than this."}),
    Function("clash_parts(parts: Parts, options: clash_options, ignored: Pairs) -> ClashResult",
             "(options.ignored = $ignored, tf::clash(borrowed(parts), options))"),
    Function("clash_in_poses(parts: Parts, poses: Poses, options: clash_options, ignored: Pairs)"
             " -> PoseClashes",
             "(options.ignored = $ignored, tf::check_poses(borrowed(parts), $poses, options))"),
    Function("clash(parts: Parts, options: clash_options(clearance), poses: ArrayLike = None, "
             "ignored: PartPairs = ()) -> ClashResult",
             body="clashes(parts, poses, how, ignored, progress)", leave="first_only",
             docs={"poses": "(N, 4, 4) an affine transform for each of the N parts. Transformed "
                            "vertices are rounded to float64; everything after that is exact. The"
                            " result refers to the transformed parts. For many poses of all "
                            "parts, use `check_poses`.",
                   "ignored": "pairs of part numbers to ignore."}),
    Function("check_poses(parts: Parts, poses: Numbers, options: clash_options(clearance), "
             "ignored: PartPairs = ()) -> PoseClashes",
             body="clashes_in_poses(parts, poses, how, ignored, progress)",
             leave="volumes depths limit",
             doc="The clashes in each of many poses. All pairs are tested, also of parts that do "
                 "not move: if such a pair meets, every pose is in collision, unless `ignored` has "
                 "it. `in_collision` includes pairs that are too close; `distance` is that of "
                 "pairs closer than the clearance, 0 if they touch or penetrate.",
             also="Exact, like `clash` and `measure`, for the moved corners, rounded to double. "
                  "Two parts are only copied and indexed again for a pose if they touch, if a "
                  "corner of one is so near the surface of the other that rounding might change "
                  "its side, or if a transform is not a rigid motion.",
             docs={"poses": "(P, N, 4, 4) for each of P poses, an affine transform for each of "
                            "the N parts; or (P, 4, 4), to move only the first part.",
                   "ignored": "pairs of part numbers to ignore."}),
]
