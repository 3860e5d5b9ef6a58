"""Rules of shaders. Compiled ones keep two rules of SPIR-V that spirv-val knows since 2025, and so does the validation
layer: whatever spirv-val a machine has. scripts/validate-shaders asks the newest. Sources name specialisation constants
by the ids of shaders/shared/constants.h, and modules by the names of shaders/modules.def.
Include guards are named after paths.

    shaders_test.py MODULES      compiled modules, separated by semicolons
"""

import re
import struct
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODULES = [Path(name) for name in sys.argv[1].split(";")]
STAGES = (".comp", ".vert", ".tesc", ".tese", ".frag")

# A module of the table; a definition that a source asks for; the name of a shader's file in C++.
SHADER_MODULE = re.compile(r'^SHADER_MODULE\((\w+), "([^"]*)", "([^"]*)"\)$', re.MULTILINE)
ASKED = re.compile(r"^#\s*(?:ifdef|ifndef)\s+([A-Z_]+)$|\bset = ([A-Z_]+)\b|\b(STORED_FORMAT)\b", re.MULTILINE)
SHADER_FILE = re.compile(r'"[^"\n]*\.(?:comp|vert|tesc|tese|frag)"')

# The guard of what is included: before anything but comments.
GUARD = re.compile(r"(?:\s*//.*\n)*\s*#ifndef (\w+)\n#define \1\n")

# A declared id; its use by a constant of GLSL, which may be the size of a work-group; a literal in C++.
DECLARED_ID = re.compile(r"\bSHARED_CONST uint (id[A-Z]\w*) = (\d+)u;")
CONSTANT = re.compile(r"\bconstant_id\s*=\s*(\w+)\s*\)\s*const\s+(\w+)\s+(\w+)")
CONSTANT_ID = re.compile(r"\b(?:constant|local_size_[xyz])_id\s*=\s*(\w+)")
GIVEN_ID = re.compile(r"\.id\s*=\s*(?:\w+::)*(\w+)")

# Opcodes, by the specification's names.
TYPE_INT, TYPE_FLOAT, TYPE_VECTOR, TYPE_MATRIX, TYPE_ARRAY, TYPE_RUNTIME_ARRAY = 21, 22, 23, 24, 28, 29
TYPE_STRUCT, TYPE_POINTER, VARIABLE, LOAD, STORE, COPY_MEMORY, DECORATE, MEMBER_DECORATE = 30, 32, 59, 61, 62, 63, 71, 72
# What yields a pointer, with its type and its id first.
YIELDS = {VARIABLE, LOAD, 55, 57, 65, 66, 67, 81, 83, 120, 124, 169, 245}
ARRAY_STRIDE, OFFSET, ALIGNED = 6, 35, 2
PRIVATE, WORKGROUP, FUNCTION, PHYSICAL_STORAGE_BUFFER = 6, 4, 7, 5349


class Module:
    """The instructions of a module: (opcode, operands)."""

    def __init__(self, data):
        words = struct.unpack(f"<{len(data) // 4}I", data)
        assert words[0] == 0x07230203, "no SPIR-V"
        self.instructions, place = [], 5
        while place < len(words):
            length = words[place] >> 16
            self.instructions.append((words[place] & 0xFFFF, words[place + 1:place + length]))
            place += length
        self.types = {o[0]: (code, o[1:]) for code, o in self.instructions if TYPE_INT <= code <= TYPE_POINTER}
        self.type_of = {o[1]: o[0] for code, o in self.instructions if code in YIELDS}
        self.laid_out = {o[0] for code, o in self.instructions
                         if (code == DECORATE and o[1] == ARRAY_STRIDE) or (code == MEMBER_DECORATE and o[2] == OFFSET)}

    def pointed(self, pointer):
        """Storage class and type of what an id points to."""
        code, operands = self.types[self.type_of[pointer]]
        assert code == TYPE_POINTER
        return operands

    def parts(self, type_):
        code, operands = self.types.get(type_, (0, ()))
        if code == TYPE_STRUCT:
            return operands
        return operands[:1] if code in (TYPE_VECTOR, TYPE_MATRIX, TYPE_ARRAY, TYPE_RUNTIME_ARRAY) else ()

    def has_layout(self, type_):
        return type_ in self.laid_out or any(map(self.has_layout, self.parts(type_)))

    def largest_scalar(self, type_):
        """[bytes]"""
        code, operands = self.types.get(type_, (0, ()))
        if code in (TYPE_INT, TYPE_FLOAT):
            return operands[0] // 8
        return 8 if code == TYPE_POINTER else max(map(self.largest_scalar, self.parts(type_)), default=0)

    def variables_with_layout(self):
        """Ids of variables outside of buffers whose type has the layout of a buffer (VUID-StandaloneSpirv-None-10684)."""
        return [o[1] for code, o in self.instructions if code == VARIABLE and
                o[2] in (PRIVATE, WORKGROUP, FUNCTION) and self.has_layout(self.pointed(o[1])[1])]

    def accesses(self):
        """Pointer and memory operands of each access to memory."""
        for code, operands in self.instructions:
            if code == LOAD:
                yield operands[2], operands[3:]
            elif code == STORE:
                yield operands[0], operands[2:]
            elif code == COPY_MEMORY:
                yield operands[0], operands[2:]
                yield operands[1], operands[2:]

    def misaligned(self):
        """Pointers into buffers by address whose accesses state less than the size of the largest scalar
        (VUID-StandaloneSpirv-PhysicalStorageBuffer64-06314)."""
        found = []
        for pointer, how in self.accesses():
            storage, type_ = self.pointed(pointer)
            stated = how[1] if how and how[0] & ALIGNED else 0
            if storage == PHYSICAL_STORAGE_BUFFER and stated < self.largest_scalar(type_):
                found.append(pointer)
        return found


def texts(*tops, suffixes):
    """The sources below some folders, by path."""
    files = sorted(file for top in tops for file in (ROOT / top).rglob("*") if file.suffix in suffixes)
    return {file.relative_to(ROOT).as_posix(): file.read_text(encoding="utf-8") for file in files}


def wrong_ids(declarations, glsl, cpp):
    """What is wrong with the ids of specialisation constants: in the text of constants.h, and in sources by path."""
    declared = DECLARED_ID.findall(declarations)
    names = {name for name, _ in declared}
    found = [f"{name}: the number {number} is used twice" for i, (name, number) in enumerate(declared)
             if number in [other for _, other in declared[:i]]]
    shaders, types = set(), {}
    for path, text in glsl.items():
        for name in CONSTANT_ID.findall(text):
            shaders.add(name)
            if name not in names:
                found.append(f"{path}: '{name}' is no id of constants.h")
        for name, type_, constant in CONSTANT.findall(text):
            if name in names and name != "id" + constant[0].upper() + constant[1:]:
                found.append(f"{path}: '{constant}' has the id '{name}'")
            if types.setdefault(name, type_) != type_:
                found.append(f"{path}: '{constant}' has two types")
    pipelines = set()
    for path, text in cpp.items():
        for name in GIVEN_ID.findall(text):
            pipelines.add(name)
            if name.isdigit():
                found.append(f"{path}: '.id = {name}' is a literal")
    for name in sorted(names):
        found += [f"{name}: no {side} uses it" for side, used in (("shader", shaders), ("pipeline", pipelines))
                  if name not in used]
    return found


def wrong_modules(table, glsl, cpp):
    """What is wrong with the table of modules: its text, and sources by path, those of GLSL below shaders/."""
    modules = SHADER_MODULE.findall(table)
    found = [f"{line}: not a name, a source and definitions" for line in table.splitlines()
             if line and not line.startswith("//") and not SHADER_MODULE.match(line)]
    names = [name for name, _, _ in modules]
    found += [f"{name}: used twice" for name in sorted(set(names)) if names.count(name) > 1]
    kinds = [(source, tuple(sorted(definitions.split()))) for _, source, definitions in modules]
    found += [f"{source}: compiled twice in one way" for source, _ in sorted({k for k in kinds if kinds.count(k) > 1})]
    found += [f"{path}: no module has this source" for path in glsl
              if path.endswith(STAGES) and path not in {source for source, _ in kinds}]
    asked = {name for text in glsl.values() for pair in ASKED.findall(text) for name in pair}
    found += [f"{name}: no source asks for {key}" for name, _, definitions in modules
              for key in (one.split("=")[0] for one in definitions.split()) if key not in asked]
    used = {name for text in cpp.values() for name in re.findall(r"\bshader::(\w+)", text)}
    found += [f"{name}: no pipeline uses it" for name in sorted(set(names) - used)]
    found += [f"{path}: {literal} is the name of a shader's file" for path, text in cpp.items()
              for literal in SHADER_FILE.findall(text)]
    return found


def assembled(*instructions):
    words = [0x07230203, 0x00010600, 0, 100, 0]
    for code, *operands in instructions:
        words += [(len(operands) + 1) << 16 | code, *operands]
    return Module(struct.pack(f"<{len(words)}I", *words))


class Shaders(unittest.TestCase):
    def test_only_buffers_have_the_layout_of_buffers(self):
        # glslang gives two arrays of one element type and length one type, decorated for the first that needs it.
        found = {path.name: ids for path in MODULES if (ids := Module(path.read_bytes()).variables_with_layout())}
        self.assertEqual(found, {})

    def test_addresses_are_read_at_multiples_of_their_size(self):
        modules = {path.name: Module(path.read_bytes()) for path in MODULES}
        self.assertEqual({name: ids for name, module in modules.items() if (ids := module.misaligned())}, {})
        counts = [sum(module.pointed(pointer)[0] == PHYSICAL_STORAGE_BUFFER for pointer, _ in module.accesses())
                  for module in modules.values()]
        self.assertGreater(sum(counts), 1000)

    def test_the_check_sees_a_shared_array_with_a_stride(self):
        types = (TYPE_INT, 1, 32, 0), (43, 1, 2, 7), (TYPE_ARRAY, 3, 1, 2), (TYPE_POINTER, 4, WORKGROUP, 3)
        self.assertEqual(assembled(*types, (VARIABLE, 4, 5, WORKGROUP)).variables_with_layout(), [])
        stride = (DECORATE, 3, ARRAY_STRIDE, 4)
        self.assertEqual(assembled(stride, *types, (VARIABLE, 4, 5, WORKGROUP)).variables_with_layout(), [5])

    def test_the_check_sees_an_address_read_as_words(self):
        types = ((TYPE_INT, 1, 32, 0), (TYPE_POINTER, 2, PHYSICAL_STORAGE_BUFFER, 1), (TYPE_STRUCT, 3, 1, 1, 2),
                 (TYPE_POINTER, 4, PHYSICAL_STORAGE_BUFFER, 3), (55, 4, 5))
        self.assertEqual(assembled(*types, (LOAD, 3, 6, 5, ALIGNED, 8)).misaligned(), [])
        for how in ((ALIGNED, 4), ()):
            self.assertEqual(assembled(*types, (LOAD, 3, 6, 5, *how)).misaligned(), [5])
            self.assertEqual(assembled(*types, (STORE, 5, 6, *how)).misaligned(), [5])


class SpecialisationConstants(unittest.TestCase):
    def test_each_id_is_declared_once_and_means_one_constant(self):
        declarations = (ROOT / "shaders/shared/constants.h").read_text(encoding="utf-8")
        self.assertGreater(len(DECLARED_ID.findall(declarations)), 20)
        self.assertEqual(wrong_ids(declarations, texts("shaders", suffixes=(".glsl",) + STAGES),
                                   texts("src", suffixes=(".cpp", ".h"))), [])

    def test_the_check_sees_each_wrong_id(self):
        two = "SHARED_CONST uint idRole = 3u;\nSHARED_CONST uint idSize = 4u;\n"
        glsl = "layout(constant_id = idRole) const uint role = 0u;\nlayout(local_size_x_id = idSize) in;\n"
        cpp = "{{.id = shared::idRole, .value = 1}, {.id = shared::idSize, .value = 2}}"
        self.assertEqual(wrong_ids(two, {"a": glsl}, {"b": cpp}), [])
        planted = [
            (two.replace("4u", "3u"), glsl, cpp, "idSize: the number 3 is used twice"),
            (two, glsl + "layout(constant_id = 7) const bool is = true;", cpp, "a: '7' is no id of constants.h"),
            (two, glsl + "layout(local_size_y_id = 2) in;", cpp, "a: '2' is no id of constants.h"),
            (two, glsl + "layout(constant_id = idRole) const uint part = 0u;", cpp, "a: 'part' has the id 'idRole'"),
            (two, glsl + "layout(constant_id = idRole) const bool role = true;", cpp, "a: 'role' has two types"),
            (two, glsl, cpp + "{.id = 3, .value = 1}", "b: '.id = 3' is a literal"),
            (two + "SHARED_CONST uint idMore = 5u;", glsl, cpp + "{.id = idMore}", "idMore: no shader uses it"),
            (two, glsl, cpp.replace("idSize", "idRole"), "idSize: no pipeline uses it"),
        ]
        for declarations, shader, pipeline, reason in planted:
            with self.subTest(reason=reason):
                self.assertEqual(wrong_ids(declarations, {"a": shader}, {"b": pipeline}), [reason])


class Guards(unittest.TestCase):
    def test_each_guard_is_the_path(self):
        found = {path: guard[1] if (guard := GUARD.match(text)) else None
                 for path, text in texts("shaders", suffixes=(".glsl", ".h")).items()}
        self.assertGreater(len(found), 60)
        wanted = {path: "SWARD_" + re.sub(r"\W", "_", path.removeprefix("shaders/")).upper() for path in found}
        self.assertEqual({path: guard for path, guard in found.items() if guard != wanted[path]}, {})


class Modules(unittest.TestCase):
    def test_the_table_has_all_modules_and_each_is_used(self):
        table = (ROOT / "shaders/modules.def").read_text(encoding="utf-8")
        glsl = {path.removeprefix("shaders/"): text
                for path, text in texts("shaders", suffixes=(".glsl",) + STAGES).items()}
        self.assertEqual(wrong_modules(table, glsl, texts("src/render", "src/apps", suffixes=(".cpp", ".h"))), [])
        built = {path.stem for path in MODULES}
        self.assertLessEqual({name for name, _, _ in SHADER_MODULE.findall(table)}, built)

    def test_the_check_sees_each_wrong_module(self):
        table = 'SHADER_MODULE(one, "a/one.comp", "")\nSHADER_MODULE(two, "a/one.comp", "SIZE=2")\n'
        glsl = {"a/one.comp": "#ifdef SIZE\n"}
        cpp = "shader::one, render::shader::two"
        self.assertEqual(wrong_modules(table, glsl, {"b": cpp}), [])
        planted = [
            (table + "SHADER_MODULE(one)", {}, cpp, "SHADER_MODULE(one): not a name, a source and definitions"),
            (table.replace("(two", "(one"), {}, cpp, "one: used twice"),
            (table.replace("SIZE=2", ""), {}, cpp, "a/one.comp: compiled twice in one way"),
            (table, {"a/more.frag": ""}, cpp, "a/more.frag: no module has this source"),
            (table.replace("SIZE=2", "SIZE=2 SIZES"), {}, cpp, "two: no source asks for SIZES"),
            (table, {}, "shader::one", "two: no pipeline uses it"),
            (table, {}, cpp + '"one.comp"', 'b: "one.comp" is the name of a shader\'s file'),
        ]
        for modules, more, pipeline, reason in planted:
            with self.subTest(reason=reason):
                self.assertEqual(wrong_modules(modules, {**glsl, **more}, {"b": pipeline}), [reason])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
