"""docs/engine.md as a stranger uses it: the host that it links is built against the installed package and draws,
and the lists of members in docs/engine_reference.md are those of the installed headers."""

import re
import unittest

from package_test import ExampleTest, PREFIX, ROOT, needs

PAGE = PREFIX / "share/doc/sward/docs/engine.md"
REFERENCE = PAGE.with_name("engine_reference.md")

# Structs of a host, and the headers that have them.
STRUCTS = {
    "gpu::HostDevice": "gpu/host_device.h", "render::FieldBudget": "render/resident_field.h",
    "render::Grass::Settings": "render/grass.h", "render::FieldInstance": "render/grass.h",
    "render::Placement": "render/placement.h", "render::HostTarget": "render/blade_target.h",
    "render::GrassFrame": "render/grass_frame.h", "render::HostView": "render/host_view.h",
    "render::HostDepth": "render/host_view.h", "render::HostLayers": "render/host_view.h", "render::HostShadow": "render/host_light.h",
    "render::StoredPicture": "render/host_image.h", "render::HostImage": "render/host_image.h",
    "render::HostCollider": "render/grass_frame.h",
    "render::HostLight": "render/host_light.h", "render::HostLamp": "render/host_light.h",
    "render::HostCone": "render/host_light.h", "render::FrameStats": "render/frame_stats.h",
    "render::StreamingStats": "render/frame_stats.h",
}


def members_of(struct):
    """Data members of a struct, by the installed header."""
    text = (PREFIX / "include/sward" / STRUCTS[struct]).read_text(encoding="utf-8")
    body = re.search(rf"\n( *)struct {struct.split('::')[-1]} {{\n(.*?)\n\1}};", text, re.S)[2]
    body = re.sub(r"//.*", "", body)
    members = []
    for statement in body.split(";"):
        found = re.search(r"([A-Za-z]\w*)\s*(?:=.*|\{.*\})?$", statement.strip(), re.S)
        if found and "(" not in re.sub(r"[={].*", "", statement, flags=re.S):
            members.append(found[1])
    return members


class EnginePage(unittest.TestCase):
    def test_the_lists_of_the_reference_name_every_member(self):
        text = REFERENCE.read_text(encoding="utf-8")
        section = text[text.index("\n## Structs\n"):text.index("\n## From C and other languages")]
        parts = re.split(r"\n(?=`\w+::)", section)
        for struct in STRUCTS:
            members = members_of(struct)
            self.assertGreater(len(members), 1, struct)
            part = " ".join(one for one in parts if f"`{struct}`" in one.split("|")[0])
            named = set(re.findall(r"`(?:\w+::)*(\w+)`", part))
            self.assertEqual([name for name in members if name not in named], [], struct)

    def test_the_curve_on_the_engine_page_is_that_of_the_shaders(self):
        page = PAGE.read_text(encoding="utf-8")
        curve = page[page.index("vec3 developed("):page.index("**Equal depths.**")]
        shader = (ROOT / "shaders/shared/look/film_curve.h").read_text(encoding="utf-8")
        shader = shader[shader.index("vec3 filmOf("):]

        def numbers(text):
            return sorted(re.findall(r"\d+\.\d+", re.sub(r"//.*", "", text)))
        self.assertEqual(numbers(curve), numbers(shader))

    def test_headers_that_the_pages_name_are_installed(self):
        text = PAGE.read_text(encoding="utf-8") + REFERENCE.read_text(encoding="utf-8")
        headers = set(re.findall(r"<(sward/[\w/]+\.h)>", text))
        self.assertGreater(len(headers), 12)
        self.assertEqual([name for name in sorted(headers) if not (PREFIX / "include" / name).is_file()], [])


class QuickStart(ExampleTest):
    """The host that the page links: Vulkan alone."""

    max_lines = 230

    def test_the_host_of_the_engine_page_draws_without_a_validation_message(self):
        needs("pillow")
        link = re.search(r"\]\((\S*quick_start/main\.cpp)\)", PAGE.read_text(encoding="utf-8"))
        self.assertTrue(link, "the page links the quick start")
        host = (PAGE.parent / link[1]).read_text(encoding="utf-8")
        self.assertEqual(host, (ROOT / "examples/quick_start/main.cpp").read_text(encoding="utf-8"))
        self.assertNotRegex(host, r"#include <sward/gpu/\S*(commands|image|pipeline|readback|rendering)",
                            "it does without Sward's helpers")

        self.build_example("quick_start")
        field = self.bake("--count", 30000, "--blade-scale", 2.5)
        said = self.run_example(field, "SYNCHRONIZATION_VALIDATION")
        self.assertRegex(said, r"^llvmpipe.* drew \d+ blades\n$")
        picture = self.picture()
        self.assertEqual(picture.size, (640, 360))
        self.assertGreater(self.green_share(picture, (200, 150, 440, 300)), 0.5)
        red, _, blue = picture.getpixel((320, 20))
        self.assertGreater(blue, red, "no ground and no sky but the host's own")

        # The layer has listened, and what is wrong is named.
        bald = self.bake("--count", 0, "--force")
        self.assertIn("BestPractices", self.run_example(bald, "BEST_PRACTICES"))
        self.assertLess(self.green_share(self.picture(), (200, 150, 440, 300)), 0.02)
        done = self.run_here(self.program, "none.sward", "frame.png", succeeds=False)
        self.assertRegex(done, r"quick_start: none\.sward: ")


if __name__ == "__main__":
    unittest.main()
