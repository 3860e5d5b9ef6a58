"""Words that a message of Sward never has: those of libraries, invented names, and noise of rounding."""

import re

# Libraries' own words, and of the language's; names of formats such as "OpenEXR file" are ours.
FOREIGN = re.compile(
    r"json\.exception|nlohmann|OpenMesh|Embree|tinygltf|TinyGLTF|libpng|stbi|stb_image|\bImf\b|\bIex\b|Cannot read image"
    r"|Error reading pixel|filesystem error|basic_string|std::|vector::|terminate called|what\(\)|\bexception\b|error code"
    r"|accessor\[|document 0\b|bad_alloc|[Dd]ecompression error|Unsupported marker|no SOI|bad dist|unknown image type"
    r"|type must be|parse error|syntax error", re.ASCII)

# A number of more than nine significant digits with a point: 4.6000000000000005.
NOISE = re.compile(r"(?<![\w.])(?<!version )\d*\.\d+(?:e[-+]?\d+)?", re.ASCII)


def foreign_words(message, given=""):
    """What a message has that it must not; empty if nothing. Texts of `given`, such as the command line and the file's
    content, may be quoted."""
    for found in FOREIGN.finditer(message):
        if found[0] not in given:
            return found[0]
    for found in NOISE.finditer(message):
        digits = found[0].split("e")[0].replace(".", "").strip("0")
        if len(digits) > 9 and float(found[0]) not in numbers_of(given):
            return found[0]
    return ""


def numbers_of(text):
    """All numbers of a text: a message may write them as it does its own."""
    return {float(found[0]) for found in re.finditer(r"\d*\.?\d+(?:[eE][-+]?\d+)?", text, re.ASCII)}
