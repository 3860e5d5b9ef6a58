"""What scripts/bench-bake runs beside Sward: points on the same sphere by other programs. Prints a line of JSON.

  blender --background --factory-startup --python scripts/bench_others.py -- SPACING FACTOR
  /usr/bin/python3 scripts/bench_others.py -- COUNT

Blender distributes points at a spacing among FACTOR times as many candidates as disks of that spacing fill the sphere;
Open3D eliminates from five times as many samples until COUNT are left. `seconds` is processor time without start and mesh.
"""

import json
import math
import sys
import time

import numpy

RADIUS, SEGMENTS, RINGS = 10.0, 256, 160
DISKS = 0.6965  # points times spacing² over area where disks are thrown until none fits


def sphere():
    """Corners and triangles of a sphere of SEGMENTS × RINGS."""
    corners = [(0.0, RADIUS, 0.0)]
    for ring in range(1, RINGS):
        polar = math.pi * ring / RINGS
        for segment in range(SEGMENTS):
            around = 2.0 * math.pi * segment / SEGMENTS
            corners.append((RADIUS * math.sin(polar) * math.cos(around), RADIUS * math.cos(polar),
                            RADIUS * math.sin(polar) * math.sin(around)))
    corners.append((0.0, -RADIUS, 0.0))
    place = lambda ring, segment: 1 + (ring - 1) * SEGMENTS + segment % SEGMENTS  # noqa: E731
    triangles = []
    for segment in range(SEGMENTS):
        triangles.append((0, place(1, segment + 1), place(1, segment)))
        triangles.append((len(corners) - 1, place(RINGS - 1, segment), place(RINGS - 1, segment + 1)))
        for ring in range(1, RINGS - 1):
            a, b = place(ring, segment), place(ring, segment + 1)
            c, d = place(ring + 1, segment), place(ring + 1, segment + 1)
            triangles += [(a, b, c), (b, d, c)]
    return corners, triangles


def tell(seconds, points, triangles):
    print(json.dumps({"seconds": seconds, "points": points, "triangles": triangles}), flush=True)


def by_blender(spacing, factor):
    import bpy
    corners, triangles = sphere()
    mesh = bpy.data.meshes.new("sphere")
    mesh.from_pydata(corners, [], triangles)
    thing = bpy.data.objects.new("sphere", mesh)
    bpy.context.collection.objects.link(thing)
    group = bpy.data.node_groups.new("points", "GeometryNodeTree")
    if hasattr(group, "interface"):
        group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    come, go = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    node = group.nodes.new("GeometryNodeDistributePointsOnFaces")
    node.distribute_method = "POISSON"
    node.inputs["Distance Min"].default_value = spacing
    node.inputs["Density Max"].default_value = factor * DISKS / spacing ** 2
    group.links.new(come.outputs[0], node.inputs["Mesh"])
    group.links.new(node.outputs["Points"], go.inputs[0])
    thing.modifiers.new("points", "NODES").node_group = group
    before = time.process_time()
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    thing.evaluated_get(graph)
    seconds = time.process_time() - before
    points = next(len(one.object.data.points) for one in graph.object_instances if one.object.type == "POINTCLOUD")
    tell(seconds, points, len(triangles))


def by_open3d(count):
    import open3d
    corners, triangles = sphere()
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(numpy.array(corners)),
                                        open3d.utility.Vector3iVector(numpy.array(triangles, dtype=numpy.int32)))
    before = time.process_time()
    points = len(mesh.sample_points_poisson_disk(count, init_factor=5).points)
    tell(time.process_time() - before, points, len(triangles))


if __name__ == "__main__":
    numbers = [float(text) for text in sys.argv[sys.argv.index("--") + 1:]]
    if len(numbers) == 2:
        by_blender(*numbers)
    else:
        by_open3d(int(numbers[0]))
