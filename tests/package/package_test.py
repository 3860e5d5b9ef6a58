"""The installed library in programs of others: each component finds what it needs and no more."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/support"))
from needs import needs  # noqa: E402

PREFIX = Path(os.environ.get("SWARD_TEST_PREFIX", ROOT / "build/release/tests/package/prefix"))
BUILD = Path(os.environ.get("SWARD_TEST_BUILD", ROOT / "build/release"))
COMPILER = os.environ.get("SWARD_TEST_CXX", "c++")

MESH_PACKAGES = "OpenMesh embree TinyGLTF TBB draco meshoptimizer OpenEXR PNG".split()

# What is installed below sward/ for each component, beside that of the field.
FOLDERS = {"field": ["core", "field", "shaders"], "bake": ["terrain", "bake"],
           "render": ["gpu", "presentation", "render"]}

# Doors that are enough for the programs below.
DOORS = {"field": ["field/read.h"],
         "bake": ["bake/bake.h", "bake/meadow.h", "field/write.h", "terrain/load.h"],
         "render": ["gpu/features.h"]}

# A program that does what its component is for.
PROGRAMS = {
    "field": """
        const sward::field::MappedField file = sward::field::readField(argv[1]);
        std::printf("%zu blades\\n", file.view().blades.size());""",
    "bake": """
        sward::Diagnostics diagnostics;
        sward::Progress progress;
        sward::bake::BakeSettings settings;
        settings.count = 500;
        settings.meadow = sward::bake::loadMeadow("lawn");
        const auto ground = sward::terrain::load("plane", {}, diagnostics);
        const auto result = sward::bake::bakeField(ground, settings, 1, diagnostics, progress);
        sward::field::writeField(result.field, argv[1], true);
        std::printf("%zu blades\\n", result.field.blades.size());""",
    "render": """
        static_cast<void>(argv);
        std::printf("%zu features\\n", sward::gpu::requiredFeatureNames().size());""",
}

CMAKE = """cmake_minimum_required(VERSION 3.25)
project(guest LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
find_package(sward {version} CONFIG REQUIRED COMPONENTS {component})
add_executable(guest main.cpp)
target_compile_options(guest PRIVATE -Wall -Wextra -Werror)
target_link_libraries(guest PRIVATE sward::{component})
"""

VALIDATION = """khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG
khronos_validation.log_filename = stdout
khronos_validation.report_flags = error,warn,perf
khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_{feature}_EXT
"""


def libraries_of(program):
    """Shared libraries that are loaded with a program."""
    return subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout


class GuestTest(unittest.TestCase):
    """A test with a folder outside of Sward's tree, which is thrown away."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="sward-guest-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_here(self, *command, succeeds=True, **environment):
        done = subprocess.run([str(word) for word in command], cwd=self.folder, text=True,
                              env={**os.environ, **environment}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode == 0, succeeds, f"{command}\n{done.stdout}")
        return done.stdout

    def write_guest(self, component, version="0.1", headers=None):
        """A program that includes headers, by default every one of the component, and does its
        work."""
        if headers is None:
            root = PREFIX / "include/sward"
            headers = [path.relative_to(root).as_posix()
                       for folder in FOLDERS["field"] + FOLDERS[component]
                       for path in sorted((root / folder).rglob("*.h"))]
            self.assertGreater(len(headers), 20)
        includes = "".join(f"#include <sward/{name}>\n" for name in [*headers, "version.h"])
        (self.folder / "main.cpp").write_text(
            f'{includes}#include <cstdio>\nint main(int argc, char** argv)\n{{\n'
            f'    if (argc < 2) return 1;{PROGRAMS[component]}\n'
            '    std::printf("%s\\n", SWARD_VERSION);\n}\n', encoding="utf-8")
        (self.folder / "CMakeLists.txt").write_text(
            CMAKE.format(component=component, version=version), encoding="utf-8")

    def configure(self, without=(), succeeds=True, source="."):
        """Configures as on a machine that lacks some packages."""
        shutil.rmtree(self.folder / "build", ignore_errors=True)
        return self.run_here(
            "cmake", "-S", source, "-B", "build", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={PREFIX}",
            f"-DCMAKE_CXX_COMPILER={COMPILER}",
            *(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in without), succeeds=succeeds)

    def build(self):
        self.run_here("cmake", "--build", "build")

    def bake(self, *options):
        self.run_here(PREFIX / "bin/sward", "bake", "plane", "--meadow", "grass", "-o", "field.sward", "-q", *options)
        return self.folder / "field.sward"


class Components(GuestTest):
    def test_a_reader_of_fields_needs_neither_vulkan_nor_mesh_libraries(self):
        self.write_guest("field")
        self.configure(without=[*MESH_PACKAGES, "Vulkan"])
        self.build()
        field = self.bake("--count", "700")
        self.assertEqual(self.run_here("build/guest", field), "700 blades\n0.1.0\n")
        self.assertNotRegex(libraries_of(self.folder / "build/guest"),
                            r"(?i)vulkan|embree|openmesh|gltf|tbb|glfw")

    def test_a_baker_needs_no_vulkan(self):
        self.write_guest("bake")
        self.configure(without=["OpenMesh"], succeeds=False)
        self.configure(without=["Vulkan"])
        self.build()
        self.assertEqual(self.run_here("build/guest", "field.sward"), "500 blades\n0.1.0\n")
        self.run_here(PREFIX / "bin/sward", "validate", "field.sward")
        self.assertNotRegex(libraries_of(self.folder / "build/guest"), r"(?i)vulkan|glfw")

    def test_a_renderer_needs_no_mesh_library(self):
        self.write_guest("render")
        self.configure(without=["Vulkan"], succeeds=False)
        self.configure(without=MESH_PACKAGES)
        self.build()
        self.assertRegex(self.run_here("build/guest", "-"), r"^\d+ features\n0\.1\.0\n$")
        self.assertNotRegex(libraries_of(self.folder / "build/guest"),
                            r"(?i)embree|openmesh|gltf|tbb|glfw")

    def test_another_minor_version_and_an_unknown_component_are_refused(self):
        self.write_guest("field", version="0.2")
        self.assertIn("0.2", self.configure(succeeds=False))
        self.write_guest("field")
        text = (self.folder / "CMakeLists.txt").read_text(encoding="utf-8")
        (self.folder / "CMakeLists.txt").write_text(text.replace("COMPONENTS", "COMPONENTS sheep"),
                                                    encoding="utf-8")
        self.assertIn("sheep", self.configure(succeeds=False))

    def test_a_host_with_a_loader_of_its_own_is_not_linked_with_vulkan(self):
        field = self.bake("--count", "300")
        shutil.copy(ROOT / "tests/package/own_loader.cpp", self.folder / "main.cpp")
        flags = self.run_here("pkg-config", "--cflags", "--libs", "sward-render",
                              PKG_CONFIG_PATH=str(PREFIX / "lib/pkgconfig")).split()
        self.assertIn("-lvulkan", flags)
        flags.remove("-lvulkan")
        # Without a word about the loader, Sward opens the system's.
        for told in ((), ("-DLEAVES_THE_LOADER_OUT",)):
            with self.subTest(told=told):
                self.run_here(COMPILER, "-std=c++20", "-DVK_NO_PROTOTYPES", *told, "main.cpp", *flags, "-o", "guest")
                self.assertNotIn("vulkan", libraries_of(self.folder / "guest"))
                self.assertRegex(self.run_here("./guest", field), r"^llvmpipe.* lists blades\n$")

    def test_settings_and_cameras_are_linked_without_vulkan(self):
        field = self.bake("--count", "300")
        (self.folder / "main.cpp").write_text("""
            #include <sward/field/read.h>
            #include <sward/presentation/camera_presets.h>
            #include <sward/presentation/settings_file.h>
            #include <cstdio>
            int main(int, char** argv)
            {
                using namespace sward;
                const field::MappedField file = field::readField(argv[1]);
                auto settings = render::FrameSettings::of(file.view());
                presentation::readSettings(R"({"recovery": 3})", "here", settings);
                const render::Camera camera = presentation::presetCamera(
                    presentation::CameraPreset::fit, file.view(), glm::vec3(0.0f, 1.0f, 0.0f), 1.5f);
                std::printf("%g, %g\\n", settings.environment.recovery, camera.fovY);
            }""", encoding="utf-8")
        flags = self.run_here("pkg-config", "--cflags", "--libs", "sward-render",
                              PKG_CONFIG_PATH=str(PREFIX / "lib/pkgconfig")).split()
        flags.remove("-lvulkan")
        self.run_here(COMPILER, "-std=c++20", "main.cpp", *flags, "-o", "guest")
        self.assertEqual(self.run_here("./guest", field), "3, 40\n")
        self.assertNotIn("vulkan", libraries_of(self.folder / "guest"))

    def test_a_reader_of_fields_in_c_is_linked_without_vulkan(self):
        """By what pkg-config says of sward-field, and by the target sward::c_field."""
        field = self.bake("--count", "300")
        shutil.copy(ROOT / "tests/gpu/c/fields_only.c", self.folder / "main.c")
        flags = self.run_here("pkg-config", "--cflags", "--libs", "sward-field",
                              PKG_CONFIG_PATH=str(PREFIX / "lib/pkgconfig")).split()
        compiled = [flag for flag in flags if flag.startswith(("-I", "-D"))]
        self.run_here("cc", "-std=c11", "-DSWARD_IS_INSTALLED", *compiled, "-c", "main.c", "-o", "main.o")
        self.run_here(COMPILER, "main.o", *flags, "-o", "guest")
        (self.folder / "CMakeLists.txt").write_text(
            CMAKE.format(component="c_field", version="0.1").replace("COMPONENTS c_field", "COMPONENTS field")
            .replace("LANGUAGES CXX", "LANGUAGES C CXX").replace("main.cpp", "main.c") +
            "target_compile_definitions(guest PRIVATE SWARD_IS_INSTALLED)\n"
            "set_target_properties(guest PROPERTIES LINKER_LANGUAGE CXX)\n", encoding="utf-8")
        self.configure(without=[*MESH_PACKAGES, "Vulkan"])
        self.build()
        for program in ("guest", "build/guest"):
            self.assertEqual(self.run_here(self.folder / program, field), "300 rows, 0 ribbons\n")
            self.assertNotIn("vulkan", libraries_of(self.folder / program))
            self.assertNotRegex(self.run_here("nm", "-C", program), r" vk[A-Z]|sward::(gpu|render)::")

    def test_vectors_go_between_a_host_of_plain_glm_and_ours(self):
        """The headers ask for no setting that gives GLM's vectors another name."""
        field = self.bake("--count", "300")
        (self.folder / "other.cpp").write_text("""
            #include <glm/vec3.hpp>
            glm::vec3 doubled(glm::vec3 v) { return v + v; }""", encoding="utf-8")
        (self.folder / "main.cpp").write_text("""
            #include <sward/field/read.h>
            #include <cstdio>
            glm::vec3 doubled(glm::vec3 v);
            int main(int, char** argv)
            {
                const auto file = sward::field::readField(argv[1]);
                const glm::vec3 size = file.view().bounds().size();
                std::printf("%g %g\\n", double(doubled(size).x), double(2.0f * size.x));
            }""", encoding="utf-8")
        flags = self.run_here("pkg-config", "--cflags", "--libs", "sward-field",
                              PKG_CONFIG_PATH=str(PREFIX / "lib/pkgconfig")).split()
        self.assertNotIn("GLM", " ".join(flags))
        self.run_here(COMPILER, "-std=c++20", "-c", "other.cpp", "-o", "other.o")
        self.run_here(COMPILER, "-std=c++20", "main.cpp", "other.o", *flags, "-o", "guest")
        ours, theirs = self.run_here("./guest", field).split()
        self.assertEqual(ours, theirs)

    def test_pkg_config_says_the_same(self):
        field = self.bake("--count", "300")
        for component, arguments in {"field": [field], "bake": ["new.sward"], "render": ["-"]}.items():
            with self.subTest(component=component):
                self.write_guest(component, headers=DOORS[component])
                flags = self.run_here("pkg-config", "--cflags", "--libs", f"sward-{component}",
                                      PKG_CONFIG_PATH=str(PREFIX / "lib/pkgconfig"))
                self.run_here(COMPILER, "-std=c++20", "main.cpp", *flags.split(), "-o", "guest")
                self.assertTrue(self.run_here("./guest", *arguments).endswith("0.1.0\n"))


class InstalledTree(GuestTest):
    def test_headers_include_each_other_by_sward(self):
        headers = list((PREFIX / "include").rglob("*.h"))
        self.assertGreater(len(headers), 40)
        for header in headers:
            for name in re.findall(r'^ *# *include "(.+)"', header.read_text(encoding="utf-8"), re.M):
                self.assertRegex(name, "^sward/", header)
                self.assertTrue((PREFIX / "include" / name).is_file(), f"{header}: {name}")

    def test_nothing_names_the_tree_it_was_built_in(self):
        files = [path for path in (PREFIX / "lib").rglob("*") if path.suffix in (".cmake", ".pc")]
        self.assertGreater(len(files), 8)
        for file in files:
            self.assertNotIn(str(ROOT), file.read_text(encoding="utf-8"), file)

    def test_programs_run_where_they_were_installed(self):
        self.assertEqual(self.run_here(PREFIX / "bin/sward", "--version"), "sward 0.1.0\n")
        self.assertIn("llvmpipe", self.run_here(PREFIX / "bin/sward-view", "devices"))

    def test_manual_pages_and_completions_are_installed_where_man_and_bash_look(self):
        for program in ("sward", "sward-view"):
            page = (PREFIX / f"share/man/man1/{program}.1").read_text(encoding="utf-8")
            self.assertEqual(page, self.run_here(PREFIX / "bin" / program, "--man"))
            script = PREFIX / "share/bash-completion/completions" / program
            self.assertIn(f" {program}\n", self.run_here("bash", "-c", f". {script}; complete -p {program}"))

    def test_links_of_installed_pages_lead_to_what_is_installed(self):
        root = PREFIX / "share/doc/sward"
        pages = list(root.rglob("*.md"))
        self.assertGreater(len(pages), 40)
        broken = []
        for page in pages:
            text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
            for link in re.findall(r"\]\(([^)\s#]+)[^)]*\)", text):
                if "://" not in link and not (page.parent / link).exists():
                    broken.append(f"{page.relative_to(root)}: {link}")
        self.assertEqual(broken, [])


class LongDebianPackages(GuestTest):
    """Before each release. What they unpack to is what `cmake --install` installs: InstalledTree."""

    def test_debian_packages_name_what_they_need_and_run_unpacked(self):
        self.run_here("cpack", "--config", BUILD / "CPackConfig.cmake", "-G", "DEB", "-B", ".",
                      "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
        programs, = self.folder.glob("sward_0.1.0_*.deb")
        development, = self.folder.glob("sward-dev_0.1.0_*.deb")
        documentation, = self.folder.glob("sward-doc_0.1.0_all.deb")
        module, = self.folder.glob("python3-sward_0.1.0_*.deb")
        needs = self.run_here("dpkg-deb", "--field", module, "Depends")
        for package in ("libc6", r"libembree\d-", "libvulkan1", "python3-numpy", r"python3 \(>= 3\.\d+\), python3 \(<< 3\.\d+\)"):
            self.assertRegex(needs, package)
        self.assertNotIn("libglfw3", needs)
        needs = self.run_here("dpkg-deb", "--field", programs, "Depends")
        for library in ("libc6", r"libembree\d-", r"libopenmesh\d", "libvulkan1", "libglfw3"):
            self.assertRegex(needs, library)
        needs = self.run_here("dpkg-deb", "--field", development, "Depends", "Recommends")
        for package in ("libfmt-dev", "libzstd-dev", "libvulkan-dev", "libembree-dev"):
            self.assertIn(package, needs)
        owner = {}
        for package in (programs, development, documentation, module):
            self.run_here("dpkg-deb", "--extract", package, "root")
            for line in self.run_here("dpkg-deb", "--contents", package).splitlines():
                path = line.split(maxsplit=5)[5]
                if not path.endswith("/"):
                    self.assertNotIn(path, owner, "two packages with one file cannot be installed together")
                    owner[path] = package
        self.assertEqual(owner["./usr/share/man/man1/sward.1"], programs)
        for name in ("share/man/man1/sward-view.1", "share/bash-completion/completions/sward"):
            self.assertEqual(owner[f"./usr/{name}"], programs)
        for name in ("README.md", "docs/engine.md", "docs/meadow_files.md", "examples/quick_start/main.cpp",
                     "examples/embed/CMakeLists.txt", "assets/meadows/lawn.json"):
            self.assertEqual(owner[f"./usr/share/doc/sward/{name}"], documentation)
        root = self.folder / "root/usr"
        self.assertEqual(self.run_here(root / "bin/sward", "--version"), "sward 0.1.0\n")
        self.assertEqual(self.run_here(root / "bin/sward-view", "--version"), "sward-view 0.1.0\n")
        folder = root / "lib/python3/dist-packages"
        self.assertEqual(self.run_here("env", f"PYTHONPATH={folder}", "PYTHONDONTWRITEBYTECODE=1", "/usr/bin/python3", "-c",
                                       "import sward; print(sward.__version__, len(sward.bake('plane', count=9, meadow='grass')))"),
                         "0.1.0 9\n")
        self.assertTrue((folder / "sward/__init__.pyi").is_file())
        self.assertTrue((root / "lib/cmake/sward/swardConfig.cmake").is_file())
        self.assertTrue((root / "include/sward/render/field_renderer.h").is_file())
        # Debug information would be ten times larger.
        self.assertLess(sum(file.stat().st_size for file in root.rglob("*")), 80e6)


class ExampleTest(GuestTest):
    """A test of a host in examples/, under the validation layer."""

    max_lines = 200

    def build_example(self, name, bakes=False):
        """Builds a copy, as a stranger does: of few lines, without libraries that render does not
        need, unless it bakes."""
        shutil.copytree(ROOT / "examples" / name, self.folder / name)
        sources = [path for path in (self.folder / name).iterdir() if path.suffix in (".cpp", ".h")]
        self.assertLessEqual(sum(len(path.read_bytes().splitlines()) for path in sources), self.max_lines)
        unneeded = ["glfw3"] if bakes else ["TinyGLTF", "embree", "OpenMesh", "glfw3"]
        self.configure(without=unneeded, source=name)
        self.build()
        self.program = f"build/{name}"
        self.assertNotRegex(libraries_of(self.folder / self.program),
                            r"(?i)glfw|imgui" if bakes else r"(?i)glfw|imgui|embree|openmesh|gltf")

    def run_example(self, field, feature, *options):
        settings = self.folder / "vk_layer_settings.txt"
        settings.write_text(VALIDATION.format(feature=feature), encoding="utf-8")
        return self.run_here(self.program, field, "frame.png", *options,
                             VK_INSTANCE_LAYERS="VK_LAYER_KHRONOS_validation",
                             VK_LAYER_SETTINGS_PATH=str(settings))

    def picture(self):
        """What the example has drawn last."""
        from PIL import Image
        return Image.open(self.folder / "frame.png").convert("RGB")

    @staticmethod
    def green_share(picture, box):
        pixels = list(picture.crop(box).getdata())
        return sum(g > r and g > b for r, g, b in pixels) / len(pixels)


if __name__ == "__main__":
    unittest.main()
