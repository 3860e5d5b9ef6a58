#!/usr/bin/env bash
# Bakes a ground in tiles on a Slurm cluster with a shared file system: a job that plans, an array
# with a task for each tile, a job that merges. Submits and returns. Run the same command again
# after anything went wrong: only missing and damaged tiles are baked.
#
#   bake-slurm.sh OUT.sward TILES INPUT... [OPTION of sward plan...]
#
#   SWARD                          the program, the same build on every node (sward)
#   PLAN_JOB, TILE_JOB, MERGE_JOB  options for sbatch: "--mem=4G --time=30 --cpus-per-task=4"
#
# OUT.sward.tiles holds plan, parts, tiles and logs; it may go once OUT.sward is there.
set -euo pipefail
(($# >= 3)) || { sed -n '2,11s/^# \{0,1\}//p' "$0" >&2; exit 1; }
sward=${SWARD:-sward} out=$(realpath -m -- "$1") tiles=$2
shift 2
work=$out.tiles plan=$work/plan.json
name=sward-$(cksum <<<"$out" | cut -d ' ' -f 1)
read -ra plan_job <<<"${PLAN_JOB:-}"
read -ra tile_job <<<"${TILE_JOB:-}"
read -ra merge_job <<<"${MERGE_JOB:-}"

[[ ! -e $out ]] || { echo "$out: is there already"; exit 0; }
if [[ -n $(squeue --me --noheader --name="$name") ]]; then
    echo "$out: in the queue; squeue --name=$name shows it, scancel --name=$name ends it" >&2
    exit 1
fi

# One folder, one bake: what was asked for is written down, and nothing else may go on with it.
mkdir -p -- "$work/logs"
request=$(printf '%q ' "$PWD" "$tiles" "$@")
if [[ -e $work/request && $(<"$work/request") != "$request" ]]; then
    echo "$work: belongs to another bake: $(<"$work/request"); remove it first" >&2
    exit 1
fi
printf '%s\n' "$request" >"$work/request"

# submit COMMAND OPTION... prints the job's number.
submit() {
    sbatch --parsable --job-name="$name" "${@:2}" <<<$'#!/usr/bin/env bash\nexec '"$1"
}

if [[ -e $plan ]]; then
    # Merge joins the tiles or ends by naming those that it needs: "bake again: 0,3-5".
    answer=$("$sward" merge "$plan" "$work/tiles" -o "$out" 2>&1) && { echo "$answer"; exit 0; }
    again=$(sed -n 's/.*bake again: //p' <<<"$answer")
    [[ -n $again ]] || { echo "$answer" >&2; exit 1; }
    after=()
else
    command=$(printf '%q ' "$sward" plan "$@" --tiles "$tiles" -o "$plan")
    job=$(submit "$command" --output="$work/logs/plan.log" "${plan_job[@]}")
    again=0-$((tiles - 1)) after=(--dependency="afterok:$job" --kill-on-invalid-dep=yes)
fi
command=$(printf '%q ' "$sward" tile "$plan" -o "$work/tiles")
# shellcheck disable=SC2016 # the task's own shell knows them
command+='--index "$SLURM_ARRAY_TASK_ID" --threads "${SLURM_CPUS_PER_TASK:-1}"'
job=$(submit "$command" --array="$again" --output="$work/logs/tile-%a.log" "${after[@]}" "${tile_job[@]}")
command=$(printf '%q ' "$sward" merge "$plan" "$work/tiles" -o "$out")
job=$(submit "$command" --dependency="afterany:$job" --output="$work/logs/merge.log" "${merge_job[@]}")
echo "tiles $again, then job $job merges them; squeue --name=$name shows how far they are"
