"""Ground files of every form that Sward reads, from seeds. write(folder, number) writes one and returns its name and
the options that it is read with."""

import struct
import zlib
from random import Random

import numpy as np

from gltf_files import write_gltf
from shapes import grid, grid_triangles, polygons

MESHES = ("gltf",) * 12 + ("obj",) * 4 + ("ply",) * 5 + ("off",) * 2 + ("stl",) * 1 + ("heights",) * 3


def write(folder, number):
    chance = Random(number)
    return WRITERS[MESHES[number % len(MESHES)]](folder, f"{number:04d}", chance)


# Text and binary polygons -------------------------------------------------------------------------

def write_obj(folder, name, chance):
    faces = polygons(chance)
    paint = chance.choice(("none", "vertices", "bytes", "materials", "both"))
    lines, seen = [], 0
    if paint in ("materials", "both"):
        lines.append(f"mtllib {name}.mtl")
        entries = [f"newmtl m{i}\nKd {chance.uniform(0.3, 0.9):.3f} {chance.uniform(0, 0.1):.3f} {chance.uniform(0, 1):.3f}"
                   for i in range(len(faces))]
        (folder / f"{name}.mtl").write_text("\n".join(entries) + "\n", encoding="utf-8")
    relative = chance.random() < 0.5
    for i, (corners, color) in enumerate(faces):
        for corner in corners:
            line = "v " + " ".join(f"{v:.9g}" for v in corner)
            if paint in ("vertices", "both", "bytes"):
                scale = 255 if paint == "bytes" else 1
                line += " " + " ".join(f"{v * scale:.6g}" for v in color)
            lines.append(line)
        if paint in ("materials", "both"):
            lines.append(f"usemtl m{i}")
        seen += len(corners)
        numbers = range(-len(corners), 0) if relative else range(seen - len(corners) + 1, seen + 1)
        words = [f"{n}" for n in numbers]
        if chance.random() < 0.3:
            words.insert(2, "\\\n")
        lines.append("f " + " ".join(words) + chance.choice(("", "", " # a face")))
    text = chance.choice(("", "# made by nobody\n", "\ufeff")) + "\n".join(lines) + "\n"
    (folder / f"{name}.obj").write_bytes(text.replace("\n", chance.choice(("\n", "\r\n", "\r"))).encode())
    return f"{name}.obj", {}


PLY = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
       "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4", "double": "f8", "float64": "f8"}
REALS = ("float", "float32", "double", "float64")
# What stands for 1 in a colour of each type.
FULL = {"i1": 127, "u1": 255, "i2": 32767, "u2": 65535, "i4": 255, "u4": 255, "f4": 1, "f8": 1}


def write_ply(folder, name, chance):
    strips = chance.random() < 0.25
    position = chance.choice((*REALS, "float", "double", "short", "ushort", "int", "uint32"))
    isWhole = position not in REALS
    scale, shift = (300, 9000 if PLY[position][0] == "u" else 0) if isWhole else (1, 0)
    paint = chance.choice((None, "bytes", *PLY))
    normals, coordinates = (chance.choice((None, None, *PLY)) for _ in range(2))
    vertices, faces = [], []
    if strips:
        columns, rows = chance.randint(2, 6), chance.randint(2, 6)
        color = [chance.uniform(0.05, 1.0) for _ in range(3)]
        vertices = [(p, color) for p in grid(chance, columns, rows)]
        line = []
        for j in range(rows - 1):
            line += [i for c in range(columns) for i in (j * columns + c, (j + 1) * columns + c)] + [-1]
        faces = [line[:-1] if chance.random() < 0.5 else line]
    else:
        for corners, color in polygons(chance):
            faces.append(list(range(len(vertices), len(vertices) + len(corners))))
            vertices += [(corner, color) for corner in corners]
    if isWhole:
        # Single corners: whole numbers of three stay in one plane.
        faces = faces if strips else [face[i:i + 3] for face in faces for i in range(0, len(face) - 2, 3)]
    index = chance.choice([kind for kind in PLY if PLY[kind][0] != "u"] if strips else list(PLY))
    length = chance.choice([kind for kind in PLY if PLY[kind][1] != "1" or not strips])
    extra = chance.random() < 0.3
    form = chance.choice(("ascii", "binary_little_endian", "binary_big_endian"))
    order = ">" if form == "binary_big_endian" else "<"

    def number(kind, value):
        if form == "ascii":
            return (f"{value:.9g} " if PLY[kind][0] == "f" else f"{round(value)} ").encode()
        return np.array(value if PLY[kind][0] == "f" else round(value)).astype(order + PLY[kind]).tobytes()

    end = b"\n" if form == "ascii" else b""
    body = {"vertex": b"", "face": b"", "other": b""}
    kind = "float" if paint == "bytes" else paint
    full = 255 if paint == "bytes" else FULL[PLY[paint]] if paint else None
    for point, color in vertices:
        body["vertex"] += b"".join(number(position, v * scale + shift) for v in point)
        if normals:
            body["vertex"] += b"".join(number(normals, v) for v in (0, 1, 0))
        if coordinates:
            body["vertex"] += number(coordinates, 0) + number(coordinates, 1)
        if extra:
            body["vertex"] += number("float", 0.25) + number("uchar", 1) + number("int", 7)
        if paint:
            body["vertex"] += b"".join(number(kind, v * full) for v in color)
        body["vertex"] += end
    for face in faces:
        body["face"] += (number("uchar", 9) if extra else b"") + number(length, len(face))
        body["face"] += b"".join(number(index, i) for i in face) + end
    body["other"] = number("int", 4) + end
    head = {"vertex": f"element vertex {len(vertices)}\n" + "".join(f"property {position} {axis}\n" for axis in "xyz")
            + ("".join(f"property {normals} n{axis}\n" for axis in "xyz") if normals else "")
            + (f"property {coordinates} s\nproperty {coordinates} t\n" if coordinates else "")
            + ("property float quality\nproperty list uchar int rings\n" if extra else "")
            + ("".join(f"property {kind} {c}\n" for c in ("red", "green", "blue")) if paint else ""),
            "face": f"element {'tristrips' if strips else 'face'} {len(faces)}\n" + ("property uchar flags\n" if extra else "")
            + f"property list {length} {index} {'vertex_indices' if strips else chance.choice(('vertex_indices', 'vertex_index'))}\n",
            "other": "element thing 1\nproperty int x\n"}
    names = ["vertex", "face"] + (["other"] if extra else [])
    chance.shuffle(names)
    text = f"ply\nformat {form} 1.0\ncomment from a seed\n" + "".join(head[n] for n in names) + "end_header\n"
    ending = chance.choice(("\n", "\r\n", "\r"))
    data = text.replace("\n", ending).encode()
    rest = b"".join(body[n] for n in names)
    (folder / f"{name}.ply").write_bytes(data + (rest.replace(b"\n", ending.encode()) if form == "ascii" else rest))
    return f"{name}.ply", {}


def write_off(folder, name, chance):
    faces = polygons(chance)
    paint = chance.choice((None, "bytes", "shares"))
    lines = [("COFF" if paint else "OFF") + chance.choice(("", " # a comment"))]
    counts = f"{sum(len(c) for c, _ in faces)} {len(faces)} 0"
    if chance.random() < 0.3:
        lines[0] = ("COFF " if paint else "OFF ") + counts
    else:
        lines.append(counts)
    for corners, color in faces:
        for corner in corners:
            line = " ".join(f"{v:.9g}" for v in corner)
            if paint == "bytes":
                line += " " + " ".join(f"{round(255 * v)}" for v in color) + " 255"
            elif paint:
                line += " " + " ".join(f"{v:.6f}" for v in color) + " 1.0"
            lines.append(line)
    seen = 0
    for corners, _ in faces:
        words = [f"{len(corners)}"] + [f"{seen + i}" for i in range(len(corners))]
        seen += len(corners)
        if chance.random() < 0.3:
            words.insert(2, "\n")
        lines.append(" ".join(words) + chance.choice(("", " 200 10 10", " # a face")))
        if chance.random() < 0.2:
            lines.append("# a line")
    text = "\n".join(lines) + "\n"
    (folder / f"{name}.off").write_bytes(text.replace("\n", chance.choice(("\n", "\r\n", "\r"))).encode())
    return f"{name}.off", {}


def write_stl(folder, name, chance):
    columns, rows = chance.randint(2, 8), chance.randint(2, 8)
    corners = grid(chance, columns, rows)[np.array(grid_triangles(columns, rows))].astype("<f4")
    path = folder / f"{name}.stl"
    if chance.random() < 0.5:
        rows = np.zeros(len(corners), np.dtype([("f", "<f4", 12), ("a", "<u2")]))
        rows["f"][:, 3:] = corners.reshape(-1, 9)
        head = chance.choice((b"", b"solid of a kind", b"binary"))
        path.write_bytes(head.ljust(80, b" ") + struct.pack("<I", len(corners)) + rows.tobytes())
    else:
        text = "solid some\n"
        for triangle in corners:
            text += "facet normal 0 0 0\nouter loop\n" + "".join(
                "vertex " + " ".join(f"{float(v):.9g}" for v in corner) + "\n" for corner in triangle) + "endloop\nendfacet\n"
        text += "endsolid some\n"
        text = text.upper() if chance.random() < 0.3 else text
        path.write_bytes(text.replace("\n", chance.choice(("\n", "\r\n", "\r"))).encode())
    return path.name, {}


# Heights ------------------------------------------------------------------------------------------

def write_heights(folder, name, chance):
    kind = chance.choice((".asc", ".hgt", ".r16", ".raw", ".r32", ".png"))
    columns, rows = chance.randint(2, 30), chance.randint(2, 30)
    if kind == ".hgt":
        columns = rows = chance.randint(3, 30)
    slope = chance.uniform(0.2, 3.0)
    level = np.array([[slope * (i + 0.7 * j) + chance.uniform(0, 3) for i in range(columns)] for j in range(rows)])
    gaps = np.array([[chance.random() < 0.06 for _ in range(columns)] for _ in range(rows)]) if chance.random() < 0.6 else level < -1
    gaps[:2, :2] = False
    options = {"extent": (chance.randint(10, 90), chance.randint(10, 90))}
    path = folder / (name + kind)
    if kind == ".asc":
        none = chance.choice((-9999, -1, 1e30))
        step = chance.choice((0.5, 2, 30))
        words = np.where(gaps, none, np.round(level, 3))
        keys = [f"ncols {columns}", f"nrows {rows}", "xllcorner 100.5", "yllcorner 7", f"cellsize {step}", f"NODATA_value {none}"]
        text = "\n".join(keys).upper() if chance.random() < 0.3 else "\n".join(keys)
        path.write_text(text + "\n" + "\n".join(" ".join(f"{v:.9g}" for v in row) for row in words) + "\n", encoding="ascii")
        return path.name, options if chance.random() < 0.5 else {}
    if kind == ".hgt":
        path.write_bytes(np.where(gaps, -32768, np.round(level)).astype(">i2").tobytes())
        return path.name, options
    options["endian"] = chance.choice(("little", "big"))
    if kind == ".r32":
        options["size"] = (columns, rows)
        options["no_data"] = -50.5
        level = np.where(gaps, -50.5, level) if gaps.any() else level
        if not gaps.any():
            del options["no_data"]
        path.write_bytes(level.astype((">" if options["endian"] == "big" else "<") + "f4").tobytes())
        return path.name, options
    options["height"] = (chance.uniform(-5, 0), chance.uniform(5, 40))
    words = np.round(1000 + 200 * level).astype(int)
    if gaps.any():
        options["no_data"] = 65535
        words = np.where(gaps, 65535, words)
    if kind == ".png":
        del options["endian"]
        table = b"".join(b"\0" + row.astype(">u2").tobytes() for row in words)

        def chunk(kind, body):
            return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 16, 0, 0, 0, 0))
                         + chunk(b"IDAT", zlib.compress(table)) + chunk(b"IEND", b""))
    else:
        options["size"] = (columns, rows)
        path.write_bytes(words.astype((">" if options["endian"] == "big" else "<") + "u2").tobytes())
    return path.name, options


WRITERS = {"gltf": write_gltf, "obj": write_obj, "ply": write_ply, "off": write_off, "stl": write_stl, "heights": write_heights}
