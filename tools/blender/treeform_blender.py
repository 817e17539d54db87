# SPDX-License-Identifier: Apache-2.0
"""Exact booleans, self-intersection check and repair in Blender, with the Python package treeform.

Blender's coordinates are float32, so results are requested in float32: the coordinates that are
verified are those that are stored. See README.md."""

import textwrap
from contextlib import contextmanager

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, StringProperty

try:
    import treeform
except ImportError:  # the panel says so
    treeform = None

bl_info = {
    "name": "treeform: exact mesh operations",
    "author": "treeform",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > treeform; Object > treeform",
    "description": "Exact booleans, self-intersection check and repair",
    "category": "Mesh",
}

NONE = 0xFFFFFFFF  # stands for no element
MOST_UV_LAYERS = 8  # limit of Blender


class Refused(Exception):
    """A message for the user, a sentence."""


# ---- from Blender ----

def column(rows, name, width=1, kind=np.float32):
    """The property `name` of each row, (n,) or (n, width)."""
    values = np.empty(len(rows) * width, kind)
    rows.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


class Triangles:
    """The triangles of a mesh, with their polygons and attributes."""

    def __init__(self, mesh, move=None):
        """move: (4, 4) float64, applied to the vertices."""
        mesh.calc_loop_triangles()
        triangles, polygons = mesh.loop_triangles, mesh.polygons
        self.vertices = column(mesh.vertices, "co", 3).astype(np.float64)
        self.faces = column(triangles, "vertices", 3, np.int32).astype(np.uint32)
        self.loops = column(triangles, "loops", 3, np.int32)
        self.mirrored = move is not None and np.linalg.det(move[:3, :3]) < 0
        if move is not None:
            self.vertices = np.ascontiguousarray(self.vertices @ move[:3, :3].T + move[:3, 3])
        if self.mirrored:  # still counter-clockwise from outside
            self.faces, self.loops = self.faces[:, ::-1].copy(), self.loops[:, ::-1].copy()
        if not (finite := np.isfinite(self.vertices).all(axis=1)).all():
            raise Refused(f"vertex {finite.argmin()} has a coordinate that is not finite")
        self.polygon = column(triangles, "polygon_index", 1, np.int32)
        self.loop_count = len(mesh.loops)
        self.start = column(polygons, "loop_start", 1, np.int32)
        self.total = column(polygons, "loop_total", 1, np.int32)
        self.material = column(polygons, "material_index", 1, np.int32)
        self.smooth = column(polygons, "use_smooth", 1, bool)
        self.uvs = {layer.name: column(layer.data, "uv", 2) for layer in mesh.uv_layers}
        self.cut = self.total == 3  # polygons that are triangles in results

    def arrays(self):
        return self.vertices, self.faces


def triangles_as_seen(context, object, move=None):
    """The triangles of an object, with its modifiers and shape keys applied."""
    evaluated = object.evaluated_get(context.evaluated_depsgraph_get())
    try:
        return Triangles(evaluated.to_mesh(), move)
    except Refused as refused:
        raise Refused(f"{object.name}: {refused}") from None
    finally:
        evaluated.to_mesh_clear()


def matrix_between(object, active):
    """The transform from the space of `object` to that of `active`, in double precision; None if
    they are the same."""
    here, there = (np.array(one.matrix_world, np.float64) for one in (object, active))
    if np.array_equal(here, there):
        return None
    try:
        return np.linalg.inv(there) @ here
    except np.linalg.LinAlgError:
        raise Refused(f"{active.name} has a scale of zero") from None


def materials_of(object):
    return [slot.material for slot in object.material_slots] or [None]


# ---- what results keep of their operands ----

def weights_in_source(corners, triangle):
    """(n, 3, 3) for each corner of faces (n, 3, 3), its barycentric coordinates in the triangles
    (n, 3, 3) that contain the faces."""
    u, v = (triangle[:, None, k] - triangle[:, None, 0] for k in (1, 2))
    w = corners - triangle[:, None, 0]
    normal = np.cross(u, v)
    square = (normal * normal).sum(axis=-1)
    square[square == 0] = np.inf
    b = (np.cross(w, v) * normal).sum(axis=-1) / square
    c = (np.cross(u, w) * normal).sum(axis=-1) / square
    weights = np.clip(np.stack([1 - b - c, b, c], axis=-1), 0, 1)  # rounding moves points outside
    return weights / weights.sum(axis=-1, keepdims=True)


def whole_polygons(operand, source, faces, same):
    """Polygons that are unchanged in a result.

    source (n,): the triangle that each of `faces` lies in; same (n, 3, 3): which of its corners is
    which of that one. Returns the polygons, whether they are turned over, and the vertex of the
    result that is at each loop."""
    corner = same.argmax(axis=-1)
    loops = np.take_along_axis(operand.loops[source], corner, axis=1)
    whole = same.any(axis=-1).all(axis=-1)
    vertex = np.zeros(operand.loop_count, np.int64)
    vertex[loops[whole]] = faces[whole]
    whole &= (vertex[loops] == faces).all(axis=1)
    turned = (corner[:, 1] - corner[:, 0]) % 3 == 2
    found = []
    for side in (False, True):
        count = np.bincount(operand.polygon[source[whole & (turned == side)]],
                            minlength=len(operand.total))
        found.append(np.flatnonzero((count == operand.total - 2) & ~operand.cut))
    return np.concatenate(found), np.repeat([False, True], [len(one) for one in found]), vertex


class Faces:
    """Faces of a result, with the attributes from their operands."""

    def __init__(self, mesh, face_source, vertex_source, operands):
        """face_source, vertex_source: (n, 2), an operand and its face or vertex. Faces without a
        source have material 0 and UV 0."""
        names = dict.fromkeys(name for one in operands for name in one.uvs)
        self.uvs = {name: [] for name in list(names)[:MOST_UV_LAYERS]}
        self.corners, self.totals, self.operand, self.polygon = [], [], [], []
        self.material, self.smooth = [], []
        self.add_lost(mesh.faces[face_source[:, 1] == NONE])
        for k, operand in enumerate(operands):
            rows = np.flatnonzero((face_source[:, 0] == k) & (face_source[:, 1] != NONE))
            source, faces = face_source[rows, 1], mesh.faces[rows]
            old, came = operand.faces[source], vertex_source[faces]
            same = (came[:, :, :1] == k) & (came[:, :, 1:] == old[:, None, :])
            polygons, turned, vertex = whole_polygons(operand, source, faces, same)
            rest = ~np.isin(operand.polygon[source], polygons)
            source, faces, old, same = (one[rest] for one in (source, faces, old, same))
            weights = weights_in_source(mesh.vertices[faces], operand.vertices[old])
            weights = np.where(same.any(axis=-1, keepdims=True), same, weights)
            self.add(k, operand, operand.polygon[source], faces.ravel(), np.full(len(faces), 3),
                     lambda uv: (weights @ uv[operand.loops[source]]).reshape(-1, 2))
            loops = self.loops_of(operand, polygons, turned != operand.mirrored)
            self.add(k, operand, polygons, vertex[loops], operand.total[polygons],
                     lambda uv: uv[loops])
        for name, values in vars(self).items():
            if name != "uvs":
                setattr(self, name, np.concatenate(values).astype(np.int32))
        self.uvs = {name: np.concatenate(values) for name, values in self.uvs.items()}

    @staticmethod
    def loops_of(operand, polygons, turned):
        """The loops of polygons. Those of flipped ones are reversed and begin with the same loop,
        so that Blender cuts quads along the same diagonal."""
        total = operand.total[polygons]
        place = np.arange(total.sum()) - np.repeat(np.cumsum(total) - total, total)
        size = np.repeat(total, total)
        place = np.where(np.repeat(turned, total), (size - place) % size, place)
        return np.repeat(operand.start[polygons], total) + place

    def add_lost(self, faces):
        """Adds faces that are not in a face of an operand."""
        zeros = np.zeros(len(faces))
        for values, more in ((self.corners, faces.ravel()), (self.totals, zeros + 3),
                             (self.operand, zeros), (self.polygon, zeros - 1),
                             (self.material, zeros), (self.smooth, zeros)):
            values.append(more)
        for values in self.uvs.values():
            values.append(np.zeros((faces.size, 2)))

    def add(self, k, operand, polygons, corners, totals, uvs_of):
        """Adds faces that are in these polygons."""
        for values, more in ((self.corners, corners), (self.totals, totals),
                             (self.operand, np.full(len(polygons), k)), (self.polygon, polygons),
                             (self.material, operand.material[polygons]),
                             (self.smooth, operand.smooth[polygons])):
            values.append(more)
        for name, values in self.uvs.items():
            uv = operand.uvs.get(name)
            values.append(np.zeros((len(corners), 2)) if uv is None else uvs_of(uv))

    def give_slots(self, slots_of_operands):
        """Renumbers materials by the slots of the first operand, followed by those of the others.
        Returns all materials."""
        all_slots = list(slots_of_operands[0])
        for k, slots in enumerate(slots_of_operands):
            rows = self.operand == k
            # Blender, too, takes the last slot for numbers beyond it.
            number = np.clip(self.material, 0, len(slots) - 1)
            for old in np.unique(number[rows]):
                if k > 0 and slots[old] not in all_slots:
                    all_slots.append(slots[old])
                new = old if k == 0 else all_slots.index(slots[old])
                self.material[rows & (number == old)] = new
        return all_slots


def changeable(object):
    if object.library or object.data.library:
        raise Refused(f"{object.name} is linked from another file and cannot be changed")


def own_mesh(object):
    """The mesh of the object, made single-user, without shape keys and modifiers."""
    if object.data.users > 1:
        object.data = object.data.copy()
    if object.data.shape_keys:
        object.shape_key_clear()
    object.modifiers.clear()
    return object.data


def fill(data, vertices, faces):
    """Replaces the vertices and faces of a mesh."""
    data.clear_geometry()
    data.vertices.add(len(vertices))
    data.loops.add(len(faces.corners))
    data.polygons.add(len(faces.totals))
    data.vertices.foreach_set("co", vertices.astype(np.float32).ravel())
    data.loops.foreach_set("vertex_index", faces.corners)
    data.polygons.foreach_set("loop_start", np.cumsum(faces.totals, dtype=np.int32) - faces.totals)
    data.polygons.foreach_set("loop_total", faces.totals)
    data.polygons.foreach_set("material_index", faces.material)
    data.polygons.foreach_set("use_smooth", faces.smooth.astype(bool))
    for name, values in faces.uvs.items():
        layer = data.uv_layers.new(name=name, do_init=False)
        layer.data.foreach_set("uv", values.astype(np.float32).ravel())
    data.update(calc_edges=True)


def edge_and_corner(triangles, vertices):
    """A number for the edge that starts at the lowest corner of each triangle, and the third
    corner."""
    first = triangles.argmin(axis=1)[:, None]
    a, b, c = np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1).astype(np.uint64).T
    return a * np.uint64(vertices) + b, c


def are_missing(some, triangles, vertices):
    """(n,) for each of some triangles, whether it is not among `triangles`, in which each directed
    edge occurs only once."""
    edges, corners = edge_and_corner(triangles, vertices)
    order = np.argsort(edges)
    wanted, corner = edge_and_corner(some, vertices)
    at = order[np.minimum(np.searchsorted(edges, wanted, sorter=order), len(order) - 1)]
    return (edges[at] != wanted) | (corners[at] != corner)


def store(object, made, sources, operands, slots):
    """Replaces the mesh of the object by that of `made`, and removes its modifiers.

    Unchanged polygons are kept if Blender cuts them into the triangles that were verified."""
    data = own_mesh(object)
    layer = data.uv_layers.active.name if data.uv_layers.active else ""
    while True:
        faces = Faces(made.mesh, *sources, operands)
        materials = faces.give_slots(slots)
        fill(data, made.vertices, faces)
        stored = Triangles(data)
        whole = np.flatnonzero(faces.totals[stored.polygon] > 3)
        missing = are_missing(stored.faces[whole], made.faces, len(made.vertices))
        if not missing.any():
            break
        for face in np.unique(stored.polygon[whole[missing]]):
            operands[faces.operand[face]].cut[faces.polygon[face]] = True
    if materials != [None]:
        for material in materials[len(data.materials):]:
            data.materials.append(material)
    if layer in data.uv_layers:
        data.uv_layers.active = data.uv_layers[layer]


def select_faces(mesh, polygons):
    """Selects only these polygons, with their edges and vertices."""
    chosen = np.zeros(len(mesh.polygons), bool)
    chosen[polygons] = True
    loop_chosen = np.repeat(chosen, column(mesh.polygons, "loop_total", 1, np.int32))
    for rows, name in ((mesh.vertices, "vertex_index"), (mesh.edges, "edge_index")):
        touched = np.zeros(len(rows), bool)
        touched[column(mesh.loops, name, 1, np.int32)[loop_chosen]] = True
        rows.foreach_set("select", touched)
    mesh.polygons.foreach_set("select", chosen)
    mesh.update()


# ---- what the operators do ----

def have_values(operands, objects):
    """Whether faces have UVs, or differ in material or shading: merged faces would lose these."""
    looks = {(slots[min(material, len(slots) - 1)], smooth)
             for one, slots in zip(operands, map(materials_of, objects))
             for material, smooth in zip(one.material.tolist(), one.smooth.tolist())}
    return any(one.uvs for one in operands) or len(looks) > 1


def combine(context, operation, active, others, progress=None):
    """Performs a set operation, and stores its certified result in `active`, in its space."""
    changeable(active)
    objects = [active, *others]
    operands = [triangles_as_seen(context, one, matrix_between(one, active)) for one in objects]
    try:
        made = getattr(treeform, operation)(*(one.arrays() for one in operands),
                                            precision="float32", progress=progress,
                                            keep_cuts=have_values(operands, objects))
    except treeform.NotClosedError as error:
        names = " and ".join(objects[k].name for k in np.unique(error.faces[:, 0]))
        raise Refused(f"Not closed, {error.certificate.open_count} open edges: {names}. "
                      "Close the surface, or use Repair first") from None
    store(active, made, (made.face_source, made.vertex_source), operands,
          [materials_of(one) for one in objects])
    return made


def find_pairs(mesh, progress=None):
    """(n, 2) the pairs of intersecting polygons of a mesh, ascending, and (n,) their kinds."""
    triangles = Triangles(mesh)
    found = treeform.self_intersections(triangles.arrays(), progress=progress)
    pairs = np.sort(triangles.polygon[found.pairs].reshape(-1, 2), axis=1)
    pairs, first = np.unique(pairs[order := np.argsort(found.kinds, kind="stable")], axis=0,
                             return_index=True)
    return pairs, found.kinds[order][first]


def mend(context, object, sheet=False, progress=None):
    """Repairs an object; None if there was nothing to do."""
    changeable(object)
    before = triangles_as_seen(context, object)
    made = treeform.repair(before.arrays(), sheet=sheet, precision="float32", progress=progress,
                           keep_cuts=have_values([before], [object]))
    if np.array_equal(made.faces, before.faces) and np.array_equal(made.vertices, before.vertices):
        return None
    sources = [np.stack([np.zeros_like(one), one], axis=1)
               for one in (made.face_source, made.vertex_source)]
    store(object, made, sources, [before], [materials_of(object)])
    return made


# ---- operators ----

@contextmanager
def progress_shown(context, part=0, parts=1):
    """A callback for `progress=` in `part` of `parts`, which shows the share at the pointer."""
    manager = context.window_manager
    manager.progress_begin(0, 100)
    try:
        yield lambda share: manager.progress_update(int(100 * (part + share) / parts))
    finally:
        manager.progress_end()


class Operator(bpy.types.Operator):
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if treeform is None:
            cls.poll_message_set("Blender's Python does not find the package treeform")
            return False
        if context.mode not in cls.modes:
            cls.poll_message_set("Leave this mode first")
            return False
        return any(one.type == "MESH" for one in context.selected_objects)

    def execute(self, context):
        try:
            return self.work(context)
        except (Refused, ValueError, treeform.Error) as error:
            return self.fail(context, str(error))
        except MemoryError:
            return self.fail(context, "There is not enough memory")

    def fail(self, context, sentence):
        self.say(context, sentence, "ERROR")
        return {"CANCELLED"}

    def say(self, context, sentence, level="INFO"):
        """Shows a message in the status line and in the panel."""
        sentence = sentence[0].upper() + sentence[1:] + "."
        context.window_manager.treeform_said = sentence
        self.report({level}, sentence)


OPERATIONS = (
    ("union", "Union", "The active object becomes the union of all selected objects"),
    ("difference", "Difference",
     "The other selected objects are subtracted from the active object"),
    ("intersection", "Intersection",
     "The active object becomes the intersection of all selected objects"),
)


class TREEFORM_OT_boolean(Operator):
    """Exact set operation: the active object becomes the result"""
    bl_idname = "object.treeform_boolean"
    bl_label = "Exact Boolean"
    modes = ("OBJECT",)

    operation: EnumProperty(name="Operation", items=OPERATIONS)
    keep: BoolProperty(name="Keep the others", default=False,
                       description="Leave the other objects in the scene")

    @classmethod
    def description(cls, _, properties):
        return next(text for name, _, text in OPERATIONS if name == properties.operation)

    def work(self, context):
        active = context.active_object
        others = [one for one in context.selected_objects if one != active]
        if active is None or not active.select_get() or not others:
            raise Refused("Select two objects or more, the one to change last")
        if wrong := [one.name for one in (active, *others) if one.type != "MESH"]:
            raise Refused(f"Not a mesh: {', '.join(wrong)}")
        with progress_shown(context) as progress:
            made = combine(context, self.operation, active, others, progress)
        if not self.keep:
            for one in others:
                bpy.data.objects.remove(one)
        if not len(made.faces):
            self.say(context, f"Nothing is left of {active.name}", "WARNING")
        else:
            self.say(context,
                     f"{active.name} has {len(active.data.polygons):,} faces: closed, and no "
                              "two meet; checked as stored")
        return {"FINISHED"}


class TREEFORM_OT_check(Operator):
    """Select the faces that meet other faces of the same object where they should not"""
    bl_idname = "object.treeform_check"
    bl_label = "Check Self-Intersections"
    modes = ("OBJECT", "EDIT_MESH")

    def work(self, context):
        editing = context.mode == "EDIT_MESH"
        objects = context.objects_in_mode if editing else context.selected_objects
        objects = [one for one in objects if one.type == "MESH"]
        if editing:
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            found = [self.look_at(context, *job, len(objects)) for job in enumerate(objects)]
        finally:
            if editing:
                bpy.ops.object.mode_set(mode="EDIT")
        found = [text for text in found if text]
        self.say(context, "; ".join(found) or "No faces meet", "WARNING" if found else "INFO")
        return {"FINISHED"}

    @staticmethod
    def look_at(context, part, object, parts):
        """The message about an object, whose intersecting faces are selected."""
        with progress_shown(context, part, parts) as progress:
            try:
                pairs, kinds = find_pairs(object.data, progress)
            except Refused as refused:
                raise Refused(f"{object.name}: {refused}") from None
        select_faces(object.data, np.unique(pairs))
        if len(pairs) == 0:
            return ""
        how = ", ".join(f"{count:,} {treeform.KINDS[kind]}"
                        for kind, count in zip(*np.unique(kinds, return_counts=True)))
        meet = "1 pair of faces meets" if len(pairs) == 1 else f"{len(pairs):,} pairs of faces meet"
        return f"{object.name}: {meet} ({how})"


class TREEFORM_OT_repair(Operator):
    """Make a closed solid without self-intersections of each selected object"""
    bl_idname = "object.treeform_repair"
    bl_label = "Repair"
    modes = ("OBJECT",)

    sheet: BoolProperty(name="Open surface", default=False,
                        description="The object is an open surface, and its border stays")

    def work(self, context):
        objects = [one for one in context.selected_objects if one.type == "MESH"]
        done, failed = [], []
        for part, one in enumerate(objects):
            with progress_shown(context, part, len(objects)) as progress:
                try:
                    if mend(context, one, self.sheet, progress):
                        done.append(one.name)
                except (Refused, ValueError, MemoryError, treeform.Error) as error:
                    failed.append(self.why(one, error))
        if failed and not done:
            return self.fail(context, "; ".join(failed))
        text = f"Repaired: {', '.join(done)}" if done else "Nothing to repair"
        self.say(context, "; ".join([text, *failed]), "WARNING" if failed else "INFO")
        return {"FINISHED"}

    @staticmethod
    def why(object, error):
        if isinstance(error, treeform.NotClosedError):
            return f"{object.name}: {error.certificate.open_count} edges stay open"
        text = "not enough memory" if isinstance(error, MemoryError) else str(error)
        return text if text.startswith(object.name) else f"{object.name}: {text}"


# ---- where they are found ----

def draw_operators(layout):
    for name, label, _ in OPERATIONS:
        layout.operator(TREEFORM_OT_boolean.bl_idname, text=label).operation = name
    layout.separator()
    layout.operator(TREEFORM_OT_check.bl_idname)
    layout.operator(TREEFORM_OT_repair.bl_idname)


class TREEFORM_PT_panel(bpy.types.Panel):
    bl_label = "treeform"
    bl_idname = "TREEFORM_PT_panel"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "treeform"

    def draw(self, context):
        if treeform is None:
            self.layout.label(text="The Python package treeform is missing", icon="ERROR")
        draw_operators(self.layout.column(align=True))
        lines = self.layout.column(align=True)
        letters = max(20, context.region.width // 9)
        for text in textwrap.wrap(context.window_manager.treeform_said, letters):
            lines.label(text=text)


class TREEFORM_MT_menu(bpy.types.Menu):
    bl_label = "treeform"
    bl_idname = "TREEFORM_MT_menu"

    def draw(self, context):
        draw_operators(self.layout)


def draw_menu(menu, context):
    menu.layout.menu(TREEFORM_MT_menu.bl_idname)


CLASSES = (TREEFORM_OT_boolean, TREEFORM_OT_check, TREEFORM_OT_repair, TREEFORM_PT_panel,
           TREEFORM_MT_menu)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.WindowManager.treeform_said = StringProperty(options={"SKIP_SAVE"})
    bpy.types.VIEW3D_MT_object.append(draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(draw_menu)
    del bpy.types.WindowManager.treeform_said
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
