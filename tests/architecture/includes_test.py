"""Who may know whom: reads every #include of libraries and shaders and fails on a forbidden arrow.

The table below is the one of ARCHITECTURE.md. A library that needs a new arrow gets it here, in the
open, or not at all.
"""

import functools
import re
import sys
import tempfile
import unittest
from fnmatch import fnmatch
from itertools import zip_longest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Where each of our libraries lives. The longest match counts.
FOLDERS = {
    "core": "src/core",
    "shared": "shaders/shared",
    "shaders": "shaders",
    "terrain": "terrain",
    "field": "src/field",
    "interchange": "src/interchange",
    "lidar": "src/lidar",
    "trace": "src/trace",
    "bake": "src/bake",
    "gpu": "src/gpu",
    "render": "src/render",
    "presentation": "src/presentation",
    "c": "src/c",
    "godot": "src/godot",
    "apps_common": "src/apps/common",
    "apps_lidar": "src/apps/lidar",
    "sward": "src/apps/sward",
    "sward_view": "src/apps/sward_view",
    "python": "src/python",
}

# What each library may include besides itself and the C++ library.
MAY_USE = {
    "core": "fmt spdlog nlohmann glm posix windows",
    "shared": "glm",
    "shaders": "shared",
    "terrain": "core fmt glm nlohmann xxhash openmesh embree tinygltf tbb stb png openexr "
               "draco meshoptimizer gdal intrinsics",
    "field": "core shared fmt glm nlohmann xxhash zstd stb",
    "interchange": "core shared field fmt glm meshoptimizer nlohmann stb xxhash",
    "lidar": "core shared field fmt glm",
    "trace": "core shared field lidar fmt glm embree tbb",
    "bake": "core shared terrain field fmt glm nlohmann tbb meshoptimizer",
    "gpu": "core fmt glm vulkan",
    "render": "core shared shaders field gpu fmt glm vulkan",
    "presentation": "core shared field render fmt glm nlohmann",
    "c": "core shared field gpu render presentation glm vulkan",
    "godot": "core shared field interchange gpu c fmt glm vulkan posix",
    "apps_common": "core fmt glm nlohmann cli11 stb openexr",
    "apps_lidar": "core shared field lidar apps_common fmt glm cli11",
    "sward": "core shared terrain field interchange lidar trace bake apps_common apps_lidar fmt glm nlohmann cli11",
    "sward_view": "core shared shaders field lidar gpu render presentation apps_common apps_lidar fmt glm nlohmann cli11 "
                  "vulkan glfw imgui stb",
    "python": "core shared terrain field interchange bake gpu render presentation apps_common sward sward_view "
              "fmt glm cli11 pybind11",
}

# Third-party headers, by pattern.
THIRD_PARTY = {
    "fmt": ["fmt/*"],
    "spdlog": ["spdlog/*"],
    "nlohmann": ["nlohmann/*"],
    "glm": ["glm/*"],
    "cli11": ["CLI/*"],
    "vulkan": ["vulkan/*"],
    "glfw": ["GLFW/*"],
    "imgui": ["imgui*", "imgui/*", "backends/imgui*"],
    "openmesh": ["OpenMesh/*"],
    "embree": ["embree3/*", "embree4/*"],
    "tinygltf": ["tiny_gltf.h"],
    "tbb": ["tbb/*", "oneapi/tbb/*", "oneapi/tbb.h"],
    "stb": ["stb/*", "stb_*.h"],
    "png": ["png.h"],
    "openexr": ["OpenEXR/*"],
    "zstd": ["zstd.h", "zstd_errors.h"],
    "xxhash": ["xxhash.h"],
    "meshoptimizer": ["meshoptimizer.h"],
    "draco": ["draco/*"],
    "gdal": ["gdal*", "ogr*", "cpl*"],
    "pybind11": ["pybind11/*"],
    "posix": ["sys/*", "unistd.h", "fcntl.h", "spawn.h", "poll.h", "dlfcn.h", "malloc.h", "pthread.h"],
    "windows": ["windows.h", "psapi.h", "shellapi.h", "io.h"],
    "intrinsics": ["*intrin.h"],
}

# Headers that only these files may see, wherever else their library would allow them; neither may
# another file see them through a header of ours.
ONLY_IN = {
    "tinygltf": ["terrain/gltf/*"],
    "openmesh": ["terrain/topology/topology*", "terrain/topology/half_edges*",
                 "terrain/mesh_files/mesh_import*", "terrain/*openmesh*"],
    "embree": ["terrain/query/surface_query*", "src/trace/ray_scene*"],
    "png": ["terrain/image/png_pixels*"],
    "openexr": ["terrain/heightmap/exr_heights*", "src/apps/common/picture/exr_file*"],
    "draco": ["terrain/gltf/codecs/draco_geometry*"],
    "gdal": ["terrain/maps/*"],
    "intrinsics": ["terrain/query/surface_query*"],
    "spdlog": ["src/core/log.cpp"],
    "windows": ["src/core/*_windows.cpp", "src/core/system/native_windows.h"],
}

# Folders inside a library, or inside one of its folders. Each may include those before it, and what lies in the folder
# that holds them all.
INSIDE = {
    "core": "math system process files json",
    "shared": "look sow layers lidar",
    "field": "file measure seeds poses",
    "interchange": "engine usda gltf compact tiles",
    "godot": "abi field native",
    "gpu": "context recording memory pipeline device presentation",
    "render": "frame field edits streaming sowing host resident cull resolve raster tessellation preview layers viewer",
    "bake": "ground mask settings paint filter sample poisson patches blades plan tiles whole seeds session",
    "shaders": "common sow blade cull raster resolve tessellation preview layers lidar bench",
    "terrain": "topology image files maps heightmap gltf mesh_files procedural query loading",
    "terrain/gltf": "file codecs",
    "apps_common": "terminal picture",
    "sward": "files text options",
    "sward_view": "files picture scene fields paint interface navigation panels window headless dataset lidar",
}

# Libraries whose sources all lie in folders.
ALL_IN_FOLDERS = {"shaders"}

# Headers that would double the build if other headers passed them on; these light ones may.
NOT_IN_HEADERS = {"nlohmann": ["nlohmann/json_fwd.hpp"], "cli11": [], "spdlog": []}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def library_of(path):
    """Our library that holds `path`, relative to the root; None outside all of them."""
    holders = [name for name, folder in FOLDERS.items() if path.startswith(folder + "/")]
    return max(holders, key=lambda name: len(FOLDERS[name]), default=None)


def target_of(root, kind, header):
    """What an include means: one of our libraries, a third party, "std", or None if unknown."""
    if kind == '"':
        path = file_of(root, header)
        return path and library_of(path)
    for name, patterns in THIRD_PARTY.items():
        if any(fnmatch(header, pattern) for pattern in patterns):
            return name
    # The headers of the C++ library have neither folder nor suffix; three are those of C.
    return "std" if re.fullmatch(r"[a-z_0-9]+|std(bool|def|int)\.h", header) else None


@functools.cache
def includes_of(file):
    """(line, kind, header) of each include of a file."""
    return [(number, *found.groups()) for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1)
            if (found := INCLUDE.match(line))]


@functools.cache
def file_of(root, header):
    """The path of our own header, relative to the root; None if there is none."""
    return next((base + header for base in ("", "src/") if (root / (base + header)).is_file()), None)


@functools.cache
def carried_by(root, header):
    """Third parties that our own header passes on, through other headers too."""
    carried, seen, todo = set(), set(), [header]
    while todo:
        path = file_of(root, todo.pop())
        if path is None or path in seen:
            continue
        seen.add(path)
        for _, kind, inner in includes_of(root / path):
            if kind == '"':
                todo.append(inner)
            else:
                carried.add(target_of(root, kind, inner))
    return carried


def complaint(root, path, kind, header):
    """Why `path` must not include `header`; None if it may."""
    library = library_of(path)
    target = target_of(root, kind, header)
    if target is None:
        return f"{header} belongs to no known library"
    if target not in ("std", library) and target not in MAY_USE[library].split():
        return f"{library} must not see {target} ({header})"
    for seen in {target} | (carried_by(root, header) if kind == '"' else set()):
        if seen in ONLY_IN and not any(fnmatch(path, place) for place in ONLY_IN[seen]):
            return f"only {', '.join(ONLY_IN[seen])} may see {seen} ({header})"
    if target == library and (reason := wrong_folder(path, file_of(root, header), library)):
        return reason
    if path.endswith(".h") and target in NOT_IN_HEADERS and header not in NOT_IN_HEADERS[target]:
        return f"a header must not pass on {header}"
    return None


def wrong_folder(path, included, library):
    """Why a file may not include another of its own library; None if it may."""
    inner = lambda file: file[len(FOLDERS[library]) + 1:].split("/")[:-1]
    place = library
    for own, other in zip_longest(inner(path), inner(included)):
        order = INSIDE.get(place, "").split()
        for folder in (own, other):
            if (folder or place in ALL_IN_FOLDERS) and order and folder not in order:
                return f"{folder or 'the root'} is no known folder of {place}"
        if own and other and order.index(other) > order.index(own):
            return f"{own} must not see {other}"
        if own != other:
            break
        place += "/" + own
    return None


def forbidden_arrows(root):
    """All offences below `root`, as file:line: reason; and the number of includes that were read."""
    # Files may have changed since the last call.
    for known in (includes_of, file_of, carried_by):
        known.cache_clear()
    offences, count = [], 0
    for top in ("terrain", "src", "shaders"):
        for file in sorted((root / top).rglob("*")):
            if file.suffix not in (".h", ".cpp", ".glsl", ".comp", ".vert", ".tesc", ".tese", ".frag"):
                continue
            path = file.relative_to(root).as_posix()
            if library_of(path) is None:
                offences.append(f"{path}:1: belongs to no library")
                continue
            for number, kind, header in includes_of(file):
                count += 1
                if reason := complaint(root, path, kind, header):
                    offences.append(f"{path}:{number}: {reason}")
    return offences, count


class IncludesObeyTheTable(unittest.TestCase):
    def test_no_forbidden_arrow(self):
        offences, count = forbidden_arrows(ROOT)
        self.assertEqual(offences, [], "\n" + "\n".join(offences))
        self.assertGreater(count, 300, "the libraries have more includes than that; are they read?")

    def test_table_has_no_cycle(self):
        for name in FOLDERS:
            reached, todo = set(), [name]
            while todo:
                for other in MAY_USE[todo.pop()].split():
                    if other in FOLDERS and other not in reached:
                        reached.add(other)
                        todo.append(other)
            self.assertNotIn(name, reached, f"{name} may use itself by a detour")

    def test_gpu_does_not_know_the_word_blade(self):
        for file in sorted((ROOT / "src/gpu").rglob("*.*")):
            words = re.findall(r"(?i)blade|grass|meadow", file.read_text(encoding="utf-8"))
            self.assertEqual(words, [], f"{file.name} knows grass")


class VulkanIsCalledInOneWay(unittest.TestCase):
    """Passes call Vulkan by gpu::Recording and DeviceContext::vk, so that a host may bring its own loader."""

    CALL = re.compile(r"(?<![\w\"])vk[A-Z]\w*\(")
    # What a frame of a host may reach. A program of ours makes instances, devices and swapchains by the linked loader.
    FOLDERS = ("src/render", "src/gpu/context", "src/gpu/recording", "src/gpu/pipeline", "src/gpu/memory")
    # Asks the physical device, which has no functions of a device.
    QUESTIONS = re.compile(r"vkGetPhysicalDevice\w+\($")

    def calls_in(self, text):
        code = re.sub(r"//[^\n]*", "", text)
        return [call for call in self.CALL.findall(code) if not self.QUESTIONS.match(call)]

    def test_no_pass_calls_the_linked_loader(self):
        for folder in self.FOLDERS:
            for file in sorted((ROOT / folder).rglob("*.*")):
                with self.subTest(file=file.relative_to(ROOT).as_posix()):
                    self.assertEqual(self.calls_in(file.read_text(encoding="utf-8")), [])

    def test_a_call_is_recognised(self):
        self.assertEqual(self.calls_in("    vkCmdDispatch(commands, 1, 1, 1);"), ["vkCmdDispatch("])
        self.assertEqual(self.calls_in('check(context.vk.WaitForFences(a), "vkWaitForFences"); // vkCmdDraw()'), [])


class PlantedIncludesAreCaught(unittest.TestCase):
    """The checker against a small house with known offences."""

    def offences_of(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text, encoding="utf-8")
            return forbidden_arrows(root)[0]

    def test_each_forbidden_arrow_is_named_with_its_place(self):
        planted = [
            ("terrain/a.cpp", '#include "field/field.h"', "terrain must not see field"),
            ("terrain/a.cpp", "#include <vulkan/vulkan.h>", "terrain must not see vulkan"),
            ("src/field/a.cpp", '#include "terrain/mesh.h"', "field must not see terrain"),
            ("src/bake/a.cpp", '#include "render/pass.h"', "bake must not see render"),
            ("src/gpu/a.cpp", '#include "field/field.h"', "gpu must not see field"),
            ("src/render/a.cpp", "#include <GLFW/glfw3.h>", "render must not see glfw"),
            ("src/render/a.cpp", '#include "presentation/viewpoint.h"', "render must not see presentation"),
            ("src/presentation/a.cpp", '#include "gpu/device/device.h"', "presentation must not see gpu"),
            ("src/presentation/a.cpp", "#include <vulkan/vulkan.h>", "presentation must not see vulkan"),
            ("src/core/a.cpp", '#include "field/field.h"', "core must not see field"),
            ("src/apps/sward/a.cpp", '#include "gpu/device/device.h"', "sward must not see gpu"),
            ("src/apps/sward_view/a.cpp", '#include "bake/bake.h"', "sward_view must not see bake"),
            ("src/interchange/a.cpp", '#include "bake/bake.h"', "interchange must not see bake"),
            ("src/trace/a.cpp", '#include "terrain/mesh.h"', "trace must not see terrain"),
            ("src/trace/a.cpp", '#include "render/pass.h"', "trace must not see render"),
            ("src/render/a.cpp", '#include "trace/tracer.h"', "render must not see trace"),
            ("src/trace/tracer.cpp", "#include <embree3/rtcore.h>", "may see embree"),
            ("terrain/topology/topology.cpp", "#include <embree3/rtcore.h>", "may see embree"),
            ("terrain/recipe.cpp", "#include <tiny_gltf.h>", "may see tinygltf"),
            ("terrain/load.cpp", "#include <OpenMesh/Core/Mesh.hh>", "may see openmesh"),
            ("src/core/b.h", "#include <nlohmann/json.hpp>", "a header must not pass on"),
            ("src/apps/common/b.h", "  #  include <CLI/CLI.hpp>", "a header must not pass on"),
            ("src/godot/a.cpp", '#include "render/pass.h"', "godot must not see render"),
            ("src/core/a.cpp", "#include <boost/any.hpp>", "belongs to no known library"),
            ("src/core/a.cpp", "#include <windows.h>", "may see windows"),
            ("src/core/a.cpp", '#include "core/system/native_windows.h"', "may see windows"),
            ("src/apps/common/a_windows.cpp", "#include <windows.h>", "apps_common must not see windows"),
            ("src/apps/common/a.cpp", "#include <unistd.h>", "apps_common must not see posix"),
            ("src/core/a.cpp", '#include "core/missing.h"', "belongs to no known library"),
            ("shaders/shared/b.h", "#include <fmt/core.h>", "shared must not see fmt"),
            ("src/elsewhere/a.cpp", "#include <vector>", "belongs to no library"),
            ("terrain/load.cpp", '#include "terrain/gltf/outer.h"', "may see tinygltf"),
            ("src/render/cull/a.cpp", '#include "render/raster/raster.h"', "cull must not see raster"),
            ("shaders/raster/a.comp", '#include "shaders/preview/a.glsl"', "raster must not see preview"),
            ("shaders/a.glsl", '#include "shaders/preview/a.glsl"', "the root is no known folder of shaders"),
            ("shaders/raster/a.comp", '#include "shaders/a.glsl"', "belongs to no known library"),
            ("shaders/shared/b.h", '#include "shaders/preview/a.glsl"', "shared must not see shaders"),
            ("shaders/cull/a.comp", '#include "core/b.h"', "belongs to no known library"),
            ("src/render/odd/a.cpp", '#include "render/pass.h"', "odd is no known folder of render"),
            ("terrain/gltf/file/a.cpp", '#include "terrain/gltf/codecs/c.h"', "file must not see codecs"),
            ("terrain/gltf/odd/a.cpp", '#include "terrain/gltf/inner.h"', "odd is no known folder of terrain/gltf"),
        ]
        house = {path: "#pragma once\n" for path in (
            "src/field/field.h", "terrain/mesh.h", "src/render/pass.h", "src/gpu/device/device.h",
            "src/bake/bake.h", "src/render/raster/raster.h", "src/trace/tracer.h",
            "src/presentation/viewpoint.h", "shaders/preview/a.glsl")}
        house["src/core/system/native_windows.h"] = "#pragma once\n#include <windows.h>\n"
        house["terrain/gltf/codecs/c.h"] = "#pragma once\n"
        house["terrain/gltf/inner.h"] = "#pragma once\n#include <tiny_gltf.h>\n"
        house["terrain/gltf/outer.h"] = '#pragma once\n#include "terrain/gltf/inner.h"\n'
        for path, line, reason in planted:
            with self.subTest(path=path, line=line):
                offences = self.offences_of({**house, path: "// One line before.\n" + line + "\n"})
                self.assertEqual(len(offences), 1, offences)
                self.assertRegex(offences[0], re.escape(path) + ":[12]: .*" + re.escape(reason))

    def test_allowed_includes_pass(self):
        self.assertEqual(self.offences_of({
            "src/core/error.h": "#pragma once\n#include <fmt/core.h>\n",
            "src/core/json.h": "#pragma once\n#include <nlohmann/json_fwd.hpp>\n",
            "src/core/json.cpp": '#include "core/json.h"\n#include <nlohmann/json.hpp>\n',
            "terrain/gltf/import.cpp": '#include "core/error.h"\n#include <tiny_gltf.h>\n',
            "terrain/topology/topology.cpp": "#include <OpenMesh/Core/Mesh.hh>\n#include <vector>\n",
            "src/render/pass.h": "#pragma once\n",
            "src/render/cull/cull.h": '#pragma once\n#include "render/pass.h"\n',
            "src/render/raster/raster.cpp": '#include "render/cull/cull.h"\n',
            "shaders/shared/blade.h": "",
            "shaders/cull/a.glsl": '#include "shaders/shared/blade.h"\n',
            "shaders/raster/a.comp": '#include "shaders/cull/a.glsl"\n',
            "src/render/grass.cpp": '#include "render/cull/cull.h"\n',
        }), [])


if __name__ == "__main__":
    print(f"Python {sys.version.split()[0]}, {ROOT.name}")
    unittest.main()
