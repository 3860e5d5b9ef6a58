"""The laws of the add-on, in Blender: blender -b --factory-startup -P blender_addon_checks.py -- NAME…

SWARD_PROGRAM names the program. Each function of CHECKS is one law; an exception is a failure, and so is a name that is
not there.
"""

import math
import os
import stat
import sys
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Vector
from mathutils.bvhtree import BVHTree
from mathutils.geometry import barycentric_transform

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "examples/blender"))

import addon_utils

addon_utils.enable("sward_addon", default_set=True)

import sward_addon
from sward_addon import panel, result

# Half of a diagonal step of 16 bits in a patch of 32 m, and the rounding of single precision at 200 m [m].
PLACE = 0.5 * math.sqrt(3.0) * 32.0 / 65535.0 + 4 * 200.0 * 2.0 ** -24
TURN = math.radians(0.64 + 0.05)  # of up-vectors: packing, and the rounding of normals [rad]


def settings(**values):
    for name, value in values.items():
        setattr(bpy.context.scene.sward, name, value)


def plane(size=8.0, cells=40, **place):
    bpy.ops.mesh.primitive_grid_add(size=size, x_subdivisions=cells, y_subdivisions=cells, **place)
    return bpy.context.active_object


def bake(code="FINISHED"):
    try:
        done = bpy.ops.sward.bake(wait=True)
    except RuntimeError as error:  # what an operator reports as an error
        assert panel.State.message and panel.State.message in str(error), error
        done = {"CANCELLED"}
    assert done == {code}, (done, panel.State.message)
    return result.find(bpy.context.active_object.name) if bpy.context.active_object else None


def blades_of(collection):
    """World places and up-vectors, rows of NumPy arrays, and the mesh of the points."""
    item, = collection.objects
    bpy.context.view_layer.update()
    mesh = item.data
    places = np.empty(3 * len(mesh.vertices), "f4")
    mesh.vertices.foreach_get("co", places)
    matrix = np.array(item.matrix_world, float)
    ups = np.empty_like(places)
    mesh.attributes["up"].data.foreach_get("vector", ups)
    return places.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3], ups.reshape(-1, 3), mesh


def left():
    """Folders of bakes, and what the add-on has made in the file."""
    folders = [path.name for path in Path(bpy.app.tempdir).glob("sward-*")]
    return sorted(folders), sorted(each.name for each in bpy.data.collections), len(bpy.data.meshes), len(bpy.data.objects)


def refused(*words):
    before = left()
    bake("CANCELLED")
    for word in words:
        assert word in panel.State.message, (word, panel.State.message)
    assert panel.State.job is None and left() == before, (left(), before)


def registers():
    sward_addon.register()
    sward_addon.register()
    assert hasattr(bpy.types.Scene, "sward") and bpy.app.handlers.load_pre.count(panel.before_load) == 1
    for _ in range(2):
        sward_addon.unregister()
        assert not hasattr(bpy.types.Scene, "sward") and panel.before_load not in bpy.app.handlers.load_pre
        assert not any(hasattr(bpy.types, each.__name__) for each in panel.CLASSES)
    sward_addon.register()
    assert bpy.context.scene.sward.meadow == "meadow"
    # The list of meadows is that of the program.
    assert sorted(panel.MEADOWS) == sorted(path.stem for path in (ROOT / "assets/meadows").glob("*.json"))


def stands_on_a_plane():
    plane(location=(0.0, 0.0, 3.0))
    settings(amount="COUNT", count=5000)
    places, ups, mesh = blades_of(bake())
    assert len(places) == 5000
    assert abs(places[:, 2] - 3.0).max() < PLACE and abs(places[:, :2]).max() < 4.0 + PLACE
    assert np.arccos(np.clip(ups[:, 2], -1, 1)).max() < TURN
    # Its first species is green grass.
    species = bpy.data.collections[f"Sward species: {bpy.context.active_object.name}"].objects[0].data
    colors = [tuple(each.color)[:3] for each in species.color_attributes["Color"].data]
    assert all(r < g > b for r, g, b in colors), colors
    # What is instanced stands on the point, as high as the attribute says, along the up-vector.
    height = mesh.attributes["height"].data[17].value
    graph = bpy.context.evaluated_depsgraph_get()
    tops = [max((each.matrix_world @ vertex.co)[2] for vertex in each.object.data.vertices)
            for each in graph.object_instances if each.is_instance]
    assert len(tops) == 5000 and 3.0 < min(tops) and max(tops) < 3.0 + 2.0, (len(tops), min(tops), max(tops))
    assert 0.0 < height < 2.0
    # A viewport shows the share that it is told; five standard deviations.
    item = bpy.data.objects["Sward blades"]
    result.set_input(item.modifiers["Blades"], "Viewport share", 0.3)
    item.update_tag()
    bpy.context.view_layer.update()
    shown = sum(each.is_instance for each in bpy.context.evaluated_depsgraph_get().object_instances)
    assert abs(shown - 1500) < 5 * math.sqrt(5000 * 0.3 * 0.7), shown


def stands_on_a_moved_sphere():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, location=(100.0, -52.0, 7.0),
                                         rotation=(0.3, -0.5, 1.1))
    bpy.ops.object.shade_smooth()
    item = bpy.context.active_object
    item.scale = (3.0, 2.0, -1.5)
    item.modifiers.new("finer", "SUBSURF").levels = 1  # what is evaluated counts
    settings(amount="COUNT", count=20_000)
    collection = bake()
    holder, = collection.objects
    assert all(abs(x / 32.0 - round(x / 32.0)) < 1e-6 for x in holder.location), holder.location
    places, ups, mesh = blades_of(collection)
    assert len(places) == 20_000

    evaluated = item.evaluated_get(bpy.context.evaluated_depsgraph_get())
    matrix = evaluated.matrix_world
    upward = matrix.to_3x3().inverted().transposed()
    ground = evaluated.to_mesh()
    ground.calc_loop_triangles()
    corners = [matrix @ vertex.co for vertex in ground.vertices]
    normals = [(upward @ vertex.normal) for vertex in ground.vertices]
    triangles = [tuple(each.vertices) for each in ground.loop_triangles]
    tree = BVHTree.FromPolygons(corners, triangles)
    farthest = widest = 0.0
    for place, up in zip(places, ups):
        nearest, _, face, distance = tree.find_nearest(Vector(place))
        a, b, c = triangles[face]
        normal = barycentric_transform(nearest, corners[a], corners[b], corners[c],
                                       normals[a].normalized(), normals[b].normalized(), normals[c].normalized())
        farthest = max(farthest, distance)
        widest = max(widest, Vector(up).angle(normal))
    assert farthest < PLACE, farthest
    # Beside packing, normals turn by PLACE over the least radius of curvature, 1.5² / 3 m.
    assert widest < TURN + PLACE / 0.75, math.degrees(widest)
    assert ups[places[:, 2].argmax(), 2] > 0.95 and ups[places[:, 2].argmin(), 2] < -0.95
    # Blades are instanced along the same up-vectors: the rotation attribute turns +Z to them.
    for number in range(0, 20_000, 501):
        turned = Euler(mesh.attributes["rotation"].data[number].vector).to_matrix() @ Vector((0.0, 0.0, 1.0))
        assert turned.angle(Vector(ups[number])) < 1e-3


def follows_units():
    scene = bpy.context.scene
    scene.unit_settings.scale_length = 0.01  # modelled in centimetres
    plane(size=800.0, cells=4, location=(3200.0, 0.0, 100.0))
    settings(amount="DENSITY", density=50.0)
    places, _, mesh = blades_of(bake())
    assert abs(len(places) / (64 * 50) - 1.0) < 0.1, len(places)
    assert abs(places[:, 2] - 100.0).max() < 100 * PLACE and abs(places[:, 0] - 3200.0).max() < 400.1
    assert mesh.attributes["height"].data[0].value < 2.0  # metres, whatever the unit is


def grows_by_its_mask():
    item = plane(cells=160)
    settings(amount="DENSITY", density=600.0, mask_kind="GROUP", vertex_group="grass")
    group = item.vertex_groups.new(name="grass")
    # Bare, half and full: a third each; vertices lie 5 cm apart.
    third = 8.0 / 3.0
    wanted = lambda x: min(2, int((x + 4.0) / third)) / 2.0
    for vertex in item.data.vertices:
        if wanted(vertex.co.x) > 0.0:
            group.add([vertex.index], wanted(vertex.co.x), "REPLACE")

    def counts(collection):
        x = blades_of(collection)[0][:, 0]
        edge = 0.06 + PLACE
        inner = [((x > -4 + i * third + edge) & (x < -4 + (i + 1) * third - edge)).sum() for i in range(3)]
        return [n / (600.0 * 8.0 * (third - 2 * edge)) for n in inner]

    bare, half, full = counts(bake())
    # Five standard deviations of the number of blades.
    assert bare == 0 and abs(half - 0.5) < 5 * math.sqrt(0.25 / 12_000) and abs(full - 1.0) < 0.01, (bare, half, full)
    settings(invert=True)
    bare, half, full = counts(bake())
    assert full == 0 and abs(half - 0.5) < 0.035 and abs(bare - 1.0) < 0.01, (bare, half, full)
    settings(invert=False, mask_kind="ATTRIBUTE", attribute="paint", channel="G")
    for kind, domain in (("FLOAT", "POINT"), ("FLOAT_COLOR", "CORNER"), ("BYTE_COLOR", "POINT"), ("FLOAT", "FACE")):
        paint = item.data.attributes.new("paint", kind, domain)
        xs = {"POINT": [v.co.x for v in item.data.vertices],
              "CORNER": [item.data.vertices[each.vertex_index].co.x for each in item.data.loops],
              "FACE": [each.center.x for each in item.data.polygons]}[domain]
        for each, x in zip(paint.data, xs):
            if kind == "FLOAT":
                each.value = wanted(x)
            else:
                each.color = (1.0, wanted(x), 0.0, 1.0)
        bare, half, full = counts(bake())
        assert bare == 0 and abs(half - 0.5) < 0.035 and abs(full - 1.0) < 0.01, (kind, domain, bare, half, full)
        item.data.attributes.remove(item.data.attributes["paint"])


def refuses_bad_input():
    bpy.ops.object.empty_add()
    refused("mesh object")
    item = plane()
    settings(mask_kind="GROUP", vertex_group="none such")
    refused("none such", item.name)
    settings(mask_kind="ATTRIBUTE", attribute="nor such")
    refused("nor such", item.name)
    settings(mask_kind="NONE", meadow="FILE", meadow_file=str(ROOT / "no-meadow.json"))
    refused("no-meadow.json")
    with tempfile.TemporaryDirectory() as folder:
        bad = Path(folder) / "bad.json"
        bad.write_text('{"species": 3}', encoding="utf-8")
        settings(meadow_file=str(bad))
        refused("bad.json", "species")
    settings(meadow="grass", options='--slope "0:45')
    refused("Options")
    settings(options="--no-such-option")
    refused("--no-such-option")
    settings(options="", amount="COUNT", count=2000, largest=1000)
    refused("--max-blades")
    bpy.ops.mesh.primitive_circle_add()
    refused("no faces")
    bpy.context.view_layer.objects.active = item
    preferences().program = str(ROOT / "no-program")
    refused("no-program")


def preferences():
    return bpy.context.preferences.addons["sward_addon"].preferences


def can_be_cancelled():
    """A program that never ends: Blender goes on, and nothing is left."""
    item = plane()
    with tempfile.TemporaryDirectory() as folder:
        slow = Path(folder) / "sward"
        slow.write_text("#!/bin/sh\nprintf 'sample        [#    ]   7 %%\\r' >&2\nexec sleep 600\n", encoding="utf-8")
        slow.chmod(slow.stat().st_mode | stat.S_IXUSR)
        preferences().program = str(slow)
        before = left()
        start = time.monotonic()
        assert bpy.ops.sward.bake() == {"FINISHED"}
        assert time.monotonic() - start < 5.0
        while panel.State.job.step != "sample 7 %":
            assert panel.advance() and time.monotonic() - start < 20.0
        assert not bpy.ops.sward.bake.poll() and bpy.ops.sward.cancel.poll()
        process = panel.State.job.process
        bpy.ops.sward.cancel()
        assert process.poll() is not None and panel.State.job is None and left() == before
        # A file that is opened ends a bake too.
        assert bpy.ops.sward.bake() == {"FINISHED"}
        process = panel.State.job.process
        bpy.ops.wm.read_homefile(use_empty=True)
        assert process.poll() is not None and panel.State.job is None and left()[0] == before[0]
        assert panel.tick() is None
    assert item is not None


def takes_the_place_of_the_former():
    item = plane()
    settings(amount="COUNT", count=100)
    first = bake()
    sizes = [len(each) for each in (bpy.data.collections, bpy.data.objects, bpy.data.meshes, bpy.data.materials)]
    field = first[result.FIELD]
    with tempfile.TemporaryDirectory() as folder:
        saved = Path(folder) / "a.sward"
        assert bpy.ops.sward.save(filepath=str(saved)) == {"FINISHED"}
        assert saved.read_bytes() == Path(field).read_bytes() and len(list(Path(folder).iterdir())) == 1
        # The viewer is the one beside the program, and is given the field.
        asked = Path(folder) / "asked"
        for name, text in (("sward", f'exec "{preferences().program}" "$@"'), ("sward-view", f'echo "$@" > "{asked}.tmp"; mv "{asked}.tmp" "{asked}"')):
            (Path(folder) / name).write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
            (Path(folder) / name).chmod(0o755)
        own, preferences().program = preferences().program, str(Path(folder) / "sward")
        assert bpy.ops.sward.view() == {"FINISHED"}
        end = time.monotonic() + 20.0
        while not asked.exists():
            assert time.monotonic() < end
            time.sleep(0.02)
        assert asked.read_text(encoding="utf-8").strip() == field
        preferences().program = own
    settings(count=50)
    second = bake()
    assert sizes == [len(each) for each in (bpy.data.collections, bpy.data.objects, bpy.data.meshes, bpy.data.materials)]
    assert second[result.BLADES] == 50 and second.name == f"Sward: {item.name}"
    # A bake without a blade is an empty field, not an error.
    settings(count=0)
    assert bake()[result.BLADES] == 0


CHECKS = {each.__name__: each for each in (
    registers, stands_on_a_plane, stands_on_a_moved_sphere, follows_units, grows_by_its_mask, refuses_bad_input,
    can_be_cancelled, takes_the_place_of_the_former)}


def main(names):
    preferences().program = os.environ["SWARD_PROGRAM"]
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    for name in names:
        CHECKS[name]()
        print(f"holds: {name}")


if __name__ == "__main__":
    main(sys.argv[sys.argv.index("--") + 1:])
