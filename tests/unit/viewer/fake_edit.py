"""Stands in for `sward edit`: holds strokes and answers, or misbehaves as its first argument says.
Each request is written to the file of its second argument."""

import json
import os
import sys
import time

how, log = sys.argv[1], open(sys.argv[2], "a", buffering=1)
with open(sys.argv[2] + ".pid", "w") as file:
    file.write(str(os.getpid()))


def say(value):
    print(json.dumps(value), flush=True)


if how == "silent-death":
    sys.exit(3)
if how == "loud-death":
    print("error: hills: no such ground", file=sys.stderr)
    sys.exit(4)
if how == "garbage":
    print("Hello.", flush=True)
    time.sleep(60)
print("sampling  [####  ]  50 %", file=sys.stderr, flush=True)
strokes = ["held"] * (2 if how == "held" else 0)
say({"format": "sward edit 1", "origin": [0, 0, 0], "blades": 100, "cells": 1,
     "strokes": len(strokes), "species": ["grass", "clover"], "scale": 1.0, "reused": True,
     "warnings": ["one"]})
done = 0
for line in sys.stdin:
    log.write(line)
    request = json.loads(line)
    done += 1
    if how == "dies" and done == 2:
        os.abort()
    if how == "wrong-id":
        say({"id": 77, "delta": None})
    if how == "endless":
        while True:
            print("x" * 65536, end="")
    answer = {"id": request["id"]}
    if request["do"] == "paint":
        if any(stroke["kind"] == "smooth" for stroke in request["strokes"]):
            say({**answer, "error": "input", "message": "strokes[0]: not smooth"})
            continue
        time.sleep(0.02)
        strokes = strokes[:request["keep"]] + request["strokes"]
        delta = f"{sys.argv[2]}.{done}.delta"
        with open(delta, "w") as file:
            json.dump(strokes, file)
        say({**answer, "delta": delta, "cells": 1, "blades": 10, "total": 100 + len(strokes),
             "strokes": len(strokes), "seconds": 0.02,
             "lost": [{"stroke": i, "points": 1, "lost": 1, "share": 1.0}
                      for i in range(request["keep"], len(strokes)) if strokes[i]["points"][0][0] > 50]})
    elif request["do"] == "move":
        for stroke in strokes:
            stroke["points"] = [[x, y - request["distance"], z] for x, y, z in stroke["points"]]
        moved = [{"index": i, "stroke": stroke} for i, stroke in enumerate(strokes)]
        say({**answer, "delta": None, "cells": 0, "blades": 0, "total": 100 + len(strokes),
             "strokes": len(strokes), "seconds": 0.0, "lost": [], "moved": moved})
    elif request["do"] in ("save", "save_strokes"):
        with open(request["path"], "w") as file:
            json.dump(strokes, file)
        say({**answer, "saved": request["path"], "bytes": 10})
