#!/usr/bin/python3
"""Runs single tests, each in the environment that ctest gives its suite.

    tests/support/one.py BUILD NAME …

NAME is that of a test as a failure prints it, or a pattern with * and ?:

    Session.BakesReplacedGround*                  GoogleTest: suite and test
    surface.SurfaceTest.test_a_cave               Python: file, class and test; the end of it is enough
"""

import ast
import fnmatch
import json
import os
import re
import subprocess
import sys


def suites(build, *chosen):
    """(name, command, properties) of each suite that ctest knows, or chooses by some arguments."""
    said = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1", *chosen], capture_output=True, text=True, check=True)
    for test in json.loads(said.stdout)["tests"]:
        yield test["name"], test.get("command", []), {p["name"]: p["value"] for p in test.get("properties", [])}


def googletests(program, known={}):
    """Full names of all tests of a GoogleTest program."""
    if program not in known:
        said = subprocess.run([program, "--gtest_list_tests"], capture_output=True, text=True, check=True).stdout
        names, suite = [], ""
        for line in said.splitlines():
            if line.startswith("  "):
                names.append(suite + line.split("#")[0].strip())
            elif re.match(r"[\w/]+\.", line):
                suite = line.split()[0]
        known[program] = names
    return known[program]


def python_tests(file):
    """Full names of all tests of a Python file: file, class, test."""
    with open(file, encoding="utf-8") as text:
        tree = ast.parse(text.read())
    stem = os.path.basename(file).removesuffix("_test.py")
    return [f"{stem}.{owner.name}.{test.name}" for owner in tree.body if isinstance(owner, ast.ClassDef)
            for test in owner.body if isinstance(test, ast.FunctionDef) and test.name.startswith("test_")]


def commands(command, pattern):
    """What runs the tests of a suite that a pattern names; nothing if it names none."""
    suite = next((word.split("=", 1)[1] for word in command if word.startswith("--gtest_filter=")), None)
    if suite:
        names = [name for name in googletests(command[0])
                 if fnmatch.fnmatchcase(name, suite) and fnmatch.fnmatchcase(name, pattern)]
        return [[command[0], "--gtest_filter=" + ":".join(names)]] if names else []
    file = next((i for i, word in enumerate(command) if word.endswith("_test.py")), None)
    if file is None:
        return []
    classes = command[file + 1:]
    arguments = [word for word in classes if os.path.sep in word]  # for the file itself
    names = [name.split(".", 1)[1] for name in python_tests(command[file])
             if name.split(".")[1] in classes
             and (fnmatch.fnmatchcase(name, pattern) or fnmatch.fnmatchcase(name, "*." + pattern))]
    return [[*command[:file + 1], *arguments, *names]] if names else []


def main(build, patterns):
    """Returns the exit code."""
    known, code = list(suites(build)), 0
    for pattern in patterns:
        found = [(run, properties) for _, command, properties in known for run in commands(command, pattern)]
        if not found:
            print(f"scripts/test: no test is named {pattern}", file=sys.stderr)
            code = 1
        for run, properties in found:
            environment = dict(word.split("=", 1) for word in properties.get("ENVIRONMENT", []))
            done = subprocess.run(run, env={**os.environ, **environment},
                                  cwd=properties.get("WORKING_DIRECTORY", build), check=False)
            code = code or done.returncode
    return code


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
