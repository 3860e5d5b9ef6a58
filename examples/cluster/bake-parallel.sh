#!/usr/bin/env bash
# Bakes a ground in tiles with GNU parallel, on this machine or on several with a shared file system.
# Run the same command again after anything went wrong: only missing and damaged tiles are baked.
#
#   bake-parallel.sh OUT.sward TILES INPUT... [OPTION of sward plan...]
#
#   SWARD     the program, the same build on every machine (sward)
#   JOBS      tiles at a time (one for each core); their memory adds up
#   THREADS   threads of each tile (1)
#   PARALLEL  more options for GNU parallel: "--sshloginfile hosts", "--memfree 4G", "--bar"
#
# OUT.sward.tiles holds plan, parts, tiles and jobs.log; it may go once OUT.sward is there.
set -euo pipefail
if (($# < 3)); then
    sed -n '2,12s/^# \{0,1\}//p' "$0" >&2
    exit 1
fi
sward=${SWARD:-sward}
out=$(realpath -m -- "$1")
tiles=$2
shift 2
work=$out.tiles
plan=$work/plan.json

if [[ -e $out ]]; then
    echo "$out: is there already"
    exit 0
fi

# One folder, one bake: what was asked for is written down, and nothing else may go on with it.
mkdir -p -- "$work"
request=$(printf '%q ' "$PWD" "$tiles" "$@")
if [[ -e $work/request && $(<"$work/request") != "$request" ]]; then
    echo "$work: belongs to another bake: $(<"$work/request"); remove it first" >&2
    exit 1
fi
printf '%s\n' "$request" >"$work/request"

# The plan appears last, after all parts of the ground.
[[ -e $plan ]] || "$sward" plan "$@" --tiles "$tiles" -o "$plan"

# Merge joins the tiles or ends by naming those that it needs: "bake again: 0,3-5".
if answer=$("$sward" merge "$plan" "$work/tiles" -o "$out" 2>&1); then
    echo "$answer"
    exit 0
fi
again=$(sed -n 's/.*bake again: //p' <<<"$answer")
if [[ -z $again ]]; then
    echo "$answer" >&2
    exit 1
fi

# A tile that fails does not stop the others; merge names it in the end.
for range in ${again//,/ }; do seq "${range%-*}" "${range#*-}"; done |
    parallel --quote --jobs "${JOBS:-100%}" --joblog "+$work/jobs.log" "$sward" tile "$plan" \
        --index {} -o "$work/tiles" --threads "${THREADS:-1}" --quiet || true
exec "$sward" merge "$plan" "$work/tiles" -o "$out"
