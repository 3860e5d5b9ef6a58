"""A strict reader for the part of USD's text format that exports use, and a check of its schema.
Debian 12 has no USD; whatever is not known here is an error, so nothing passes by being overlooked."""

import re

import numpy

# Types of properties: numbers in an element, and what a number is.
TYPES = {
    "bool": (1, int), "int": (1, int), "int64": (1, int), "float": (1, float),
    "float3": (3, float), "double3": (3, float), "point3f": (3, float), "normal3f": (3, float),
    "color3f": (3, float), "texCoord2f": (2, float), "quath": (4, float),
    "token": (1, str), "string": (1, str),
}
TOKEN = re.compile(r'\s*(?:(?P<string>"(?:[^"\\\n]|\\.)*")|(?P<path><[^<>\s]*>)'
                   r"|(?P<number>-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)"
                   r"|(?P<word>[A-Za-z_][\w:.]*(?:\[\])?)|(?P<sign>[(){}\[\]=,]))")
INTEGER = r"-?\d+"
NUMBER = r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?"


class Prim:
    def __init__(self, specifier, kind, name, path):
        self.specifier, self.kind, self.name, self.path = specifier, kind, name, path
        self.metadata, self.properties, self.interpolation, self.children = {}, {}, {}, []

    def walk(self):
        yield self
        for child in self.children:
            yield from child.walk()

    def __getitem__(self, name):
        return self.properties[name][1]


class Layer:
    """The tree of prims; `prims` has each of them by its path."""

    def __init__(self, text):
        if not text.startswith("#usda 1.0\n"):
            raise ValueError("the first line is not #usda 1.0")
        self.text, self.at = text, len("#usda 1.0\n")
        self.metadata = self.read_metadata()
        self.roots = []
        while self.text[self.at:].strip():
            self.roots.append(self.read_prim(""))
        self.prims = {}
        for root in self.roots:
            for prim in root.walk():
                if prim.path in self.prims:
                    raise ValueError(f"{prim.path} is there twice")
                self.prims[prim.path] = prim

    def next(self, *wanted):
        found = TOKEN.match(self.text, self.at)
        if not found:
            raise ValueError(f"cannot read {self.text[self.at:self.at + 40]!r}")
        self.at = found.end()
        if wanted and found[found.lastgroup] not in wanted:
            raise ValueError(f"{found[found.lastgroup]!r} instead of {' or '.join(wanted)}")
        return found.lastgroup, found[found.lastgroup]

    def peek(self):
        at = self.at
        token = self.next()[1]
        self.at = at
        return token

    def word(self):
        kind, text = self.next()
        if kind != "word":
            raise ValueError(f"{text!r} is no name")
        return text

    def read_metadata(self):
        """( name = value … ), or nothing."""
        entries = {}
        if self.peek() != "(":
            return entries
        self.next("(")
        while self.peek() != ")":
            name = self.word()
            if name == "prepend":
                name += " " + self.word()
            self.next("=")
            entries[name] = self.read_dictionary() if self.peek() == "{" else self.read_plain()
        self.next(")")
        return entries

    def read_dictionary(self):
        self.next("{")
        entries = {}
        while self.peek() != "}":
            kind, name = self.word(), self.word()
            self.next("=")
            entries[name] = self.read_value(kind)
        self.next("}")
        return entries

    def read_plain(self):
        """A string, a path, a number, or a list of such."""
        if self.peek() == "[":
            self.next("[")
            values = []
            while self.peek() != "]":
                values.append(self.read_plain())
                if self.peek() == ",":
                    self.next(",")
            self.next("]")
            return values
        kind, text = self.next()
        if kind == "string":
            return text[1:-1].encode().decode("unicode_escape").encode("latin-1").decode("utf-8")
        if kind == "path":
            return text[1:-1]
        if kind == "number":
            return float(text)
        raise ValueError(f"{text!r} is no value")

    def read_value(self, kind):
        base, is_array = kind.removesuffix("[]"), kind.endswith("[]")
        if base not in TYPES:
            raise ValueError(f"the type {kind} is not known")
        width, number = TYPES[base]
        if number is str:
            value = self.read_plain()
            if isinstance(value, list) != is_array:
                raise ValueError(f"{value!r} is no {kind}")
            return value
        values = self.read_numbers(width, number, is_array)
        if base == "quath":
            values = values.astype(numpy.float16)
        return values if is_array else values[0]

    def read_numbers(self, width, number, is_array):
        """All elements at once: arrays have megabytes."""
        one = INTEGER if number is int else NUMBER
        element = one if width == 1 else r"\(" + ", ?".join([one] * width) + r"\)"
        pattern = rf"\s*\[((?:{element}(?:, ?{element})*)?)\]" if is_array else rf"\s*({element})"
        found = re.compile(pattern).match(self.text, self.at)
        if not found:
            raise ValueError(f"no {width} numbers in {self.text[self.at:self.at + 40]!r}")
        self.at = found.end()
        plain = found[1].translate({ord("("): None, ord(")"): None, ord(" "): None})
        values = numpy.array(plain.split(",") if plain else [],
                             numpy.int64 if number is int else numpy.float64)
        return values if width == 1 else values.reshape(-1, width)

    def read_prim(self, parent):
        specifier = self.next("def", "class")[1]
        kind = self.word()
        name = self.next()[1].strip('"')
        if not re.fullmatch(r"[A-Za-z_]\w*", name):
            raise ValueError(f"{name!r} is no identifier")
        prim = Prim(specifier, kind, name, f"{parent}/{name}")
        prim.metadata = self.read_metadata()
        self.next("{")
        while self.peek() != "}":
            if self.peek() in ("def", "class"):
                prim.children.append(self.read_prim(prim.path))
            else:
                self.read_property(prim)
        self.next("}")
        return prim

    def read_property(self, prim):
        kind = self.word()
        if kind == "uniform":
            kind = self.word()
        name = self.word()
        if name in prim.properties:
            raise ValueError(f"{prim.path} has {name} twice")
        value = None
        if self.peek() == "=":
            self.next("=")
            value = self.read_plain() if kind == "rel" or name.endswith(".connect") else self.read_value(kind)
        prim.properties[name] = (kind, value)
        if self.peek() == "(":
            prim.interpolation[name] = self.read_metadata()["interpolation"]


# Types that the schemas give to what exports write (UsdGeom, UsdShade).
SCHEMA = {
    "PointInstancer": {
        "extent": "float3[]", "ids": "int64[]", "orientations": "quath[]", "positions": "point3f[]",
        "protoIndices": "int[]", "prototypes": "rel", "scales": "float3[]",
        "primvars:clump": "float[]", "primvars:exposure": "float[]", "primvars:stiffness": "float[]",
        "primvars:tint": "color3f[]", "xformOp:translate": "double3", "xformOpOrder": "token[]"},
    "Mesh": {
        "doubleSided": "bool", "extent": "float3[]", "faceVertexCounts": "int[]",
        "faceVertexIndices": "int[]", "material:binding": "rel", "normals": "normal3f[]",
        "points": "point3f[]", "primvars:displayColor": "color3f[]",
        "primvars:st": "texCoord2f[]", "subdivisionScheme": "token"},
}


# What a compact layer leaves out unless asked.
OPTIONAL = ("ids", "primvars:clump")


def values_of(prim, name):
    """A primvar, one value an instance, with or without indices."""
    indices = prim.properties.get(name + ":indices")
    return prim[name] if indices is None else prim[name][indices[1]]


def complaints(layer, length_error=2e-3):
    """What breaks the schema: types, counts, ranges, paths without a target. `length_error`: of quaternions."""
    found = []
    if (layer.metadata.get("metersPerUnit"), layer.metadata.get("upAxis")) != (1.0, "Y"):
        found.append("metersPerUnit or upAxis")
    if f"/{layer.metadata.get('defaultPrim')}" not in layer.prims:
        found.append("defaultPrim has no prim")
    for path, prim in layer.prims.items():
        for name, kind in SCHEMA.get(prim.kind, {}).items():
            if name in OPTIONAL and name not in prim.properties:
                continue
            if prim.properties.get(name, (None,))[0] != kind:
                found.append(f"{path}: {name} is no {kind}")
        targets = [v for k, v in prim.properties.values() if k == "rel"]
        targets += [v for name, (_, v) in prim.properties.items() if name.endswith(".connect")]
        targets.append(prim.metadata.get("prepend references", []))
        for target in targets:
            for one in target if isinstance(target, list) else [target]:
                owner, _, output = one.partition(".")
                if owner not in layer.prims or (output and output not in layer.prims[owner].properties):
                    found.append(f"{path}: {one} does not exist")
    if not found:
        for prim in layer.prims.values():
            check = {"PointInstancer": instancer_complaints, "Mesh": mesh_complaints}.get(prim.kind)
            found += [f"{prim.path}: {text}" for text in (check(layer, prim, length_error) if check else [])]
    return found


def instancer_complaints(layer, prim, length_error):
    count = len(prim["positions"])
    for name, (kind, value) in prim.properties.items():
        if name.endswith(":indices"):
            values = prim[name.removesuffix(":indices")]
            if kind != "int[]" or (len(value) and not 0 <= value.min() <= value.max() < len(values)):
                yield f"{name} beyond the values"
        elif name.startswith("primvars:") and prim.interpolation.get(name) != "varying":
            yield f"{name} is not varying"
        is_palette = name + ":indices" in prim.properties
        if kind.endswith("[]") and name not in ("extent", "xformOpOrder") and not is_palette and len(value) != count:
            yield f"{name} has {len(value)} elements for {count} instances"
    indices = prim["protoIndices"]
    if count and not (0 <= indices.min() and indices.max() < len(prim["prototypes"])):
        yield "protoIndices beyond the prototypes"
    norms = numpy.linalg.norm(prim["orientations"].astype(float), axis=1)
    if (numpy.abs(norms - 1.0) > length_error).any():
        yield "orientations are not unit quaternions"
    low, high = prim["extent"]
    if (prim["positions"] < low).any() or (prim["positions"] > high).any():
        yield "positions beyond the extent"
    for target in prim["prototypes"]:
        if not target.startswith(prim.path + "/"):
            yield f"{target} would be drawn by itself"
        references = layer.prims[target].metadata.get("prepend references")
        held = layer.prims[references] if references else layer.prims[target]
        if [p.kind for p in held.walk()].count("Mesh") != 1:
            yield f"{target} has no mesh"


def mesh_complaints(_, prim, _length_error):
    points = len(prim["points"])
    if prim["faceVertexCounts"].sum() != len(prim["faceVertexIndices"]):
        yield "faceVertexCounts do not sum to the indices"
    if prim["faceVertexIndices"].max() >= points or prim["faceVertexIndices"].min() < 0:
        yield "an index has no point"
    for name in ("normals", "primvars:displayColor", "primvars:st"):
        if len(prim[name]) != points or prim.interpolation.get(name) != "vertex":
            yield f"{name} is not one a vertex"
