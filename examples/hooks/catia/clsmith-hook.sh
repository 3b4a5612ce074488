#!/bin/sh
# Corrects an APT source and posts it: clsmith-hook.sh part.aptsource
# RECIPES, LOG and POST may come from the environment; change what stands here for your shop.
set -eu
here=$(dirname "$0")
recipes=${RECIPES:-$here/../recipes.yaml}
post=${POST:-$here/../post.py}

if [ $# -ne 1 ]; then
    echo "usage: $0 PROGRAM.aptsource" >&2
    exit 2
fi
# The NC program beside the export, with its name; a dot in a folder's name is no suffix.
name=$(basename "$1")
output=$(dirname "$1")/${name%.*}.nc
if [ "$output" = "$1" ] || [ "$output" = "./$1" ]; then
    echo "$0: $1 is an NC program by its name, not an export" >&2
    exit 2
fi
# exec: the exit code is clsmith's, and a signal reaches it.
exec "${CLSMITH:-clsmith}" hook --select "$recipes" --log "${LOG:-$here/hook.jsonl}" --timeout 600 \
    "$1" -- "$post" -o "$output" {}
