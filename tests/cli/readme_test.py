"""What README promises can be typed as it stands there."""

import os
import re
import subprocess
import unittest

from support import CliTest, PROGRAM, ROOT


def commands(document=ROOT / "README.md"):
    """Lines of a document's shell blocks that run the offline program, in their order."""
    text = document.read_text(encoding="utf-8")
    blocks = re.findall(r"(?ms)^```(?:sh|bash|shell|console)?\n(.*?)^```", text)
    lines = "\n".join(blocks).replace("\\\n", " ").splitlines()
    found = [re.match(r"\s*(?:\$ )?(?:build/\w+/bin/)?(sward (?!-).+)", line) for line in lines]
    return [match.group(1) for match in found if match]


class Readme(CliTest):
    def test_its_commands_run_one_after_the_other(self):
        self.assertGreater(len(commands()), 0, "README shows how to run sward")
        (self.folder / "assets").symlink_to(ROOT / "assets")
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}
        for command in commands():
            with self.subTest(command=command):
                done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=environment,
                                      stdin=subprocess.DEVNULL, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_its_quick_start_is_the_two_scripts(self):
        text = (ROOT / "README.md").read_text(encoding="utf-8")
        for script in ("scripts/demo", "scripts/test"):
            self.assertIn(script, text)
            self.assertTrue((ROOT / script).is_file())


if __name__ == "__main__":
    unittest.main()
