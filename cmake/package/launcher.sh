#!/bin/sh
# Runs a program of this folder, from any working directory and through symbolic links:
#   ./sward …  ./sward-view …     as the programs' --help says
#   ./run sward …  ./run sward-view …  ./run bench [--groups LIST] [SCENE …]  ./run libraries
# `run bench` writes fields and reports to $SWARD_WORK, by default to the folder work beside this file.
# `run libraries` prints the folder of the libraries that lie here.
set -eu
self=$(readlink -f -- "$0")
here=$(dirname -- "$self")
name=$(basename -- "$self")
stop() {
    echo "$name: $2" >&2
    exit "$1"
}

work=${SWARD_WORK:-$here/work}
lib=$here/lib
if [ ! -d "$lib" ]; then
    # A bundle for measurements brings them packed; they are unpacked once.
    mkdir -p "$work"
    work=$(cd "$work" && pwd)
    lib=$work/lib
    if [ ! -e "$lib/unpacked" ]; then
        mkdir -p "$lib"
        tar -xzf "$here/lib.tar.gz" -C "$lib"
        touch "$lib/unpacked"
    fi
fi
case $lib in *[:\;\$]*) stop 2 "$lib: LD_LIBRARY_PATH cannot hold a path with ':', ';' or '\$'" ;; esac

# Libraries that only Sward uses are always those of this folder: the same code gives the same fields
# everywhere. Of libraries that the Vulkan driver may use too (lib/spare, one folder for each), the
# machine's own are taken; a spare one is added only where the machine has none or an older one.
# A traced program loads its libraries, names them and ends.
path=$lib/own
while :; do
    said=$(for program in sward sward-view; do
        LD_TRACE_LOADED_OBJECTS=1 LD_LIBRARY_PATH=$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} "$here/bin/$program" 2>&1 || true
    done)
    case $said in *"version \`GLIBC_"*" not found"*) stop 5 "the C library of this system is older than glibc @GLIBC@" ;; esac
    before=$path
    for missing in $(printf '%s\n' "$said" |
        sed -nE 's/^[[:space:]]*([^[:space:]]+) => not found.*/\1/p; s/^.*\/([^/]+): version .* not found.*/\1/p' | sort -u); do
        case :$path: in *:"$lib/spare/$missing":*) continue ;; esac
        if [ -d "$lib/spare/$missing" ]; then path=$path:$lib/spare/$missing; fi
    done
    if [ "$path" = "$before" ]; then break; fi
done
export LD_LIBRARY_PATH="$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"

if [ "$name" = run ]; then
    name=${1:-}
    if [ $# -gt 0 ]; then shift; fi
fi
case $name in
    sward | sward-view) exec "$here/bin/$name" "$@" ;;
    bench)
        mkdir -p "$work"
        work=$(cd "$work" && pwd)
        exec python3 -B "$here/scripts/bench" --programs "$here/bin" --fields "$work" --out "$work/report" "$@"
        ;;
    libraries) echo "$lib" ;;
    *)
        sed -n '2,6s/^# \{0,1\}//p' "$self" >&2
        exit 1
        ;;
esac
