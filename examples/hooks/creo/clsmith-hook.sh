#!/bin/sh
# Corrects a CL file of Creo and posts it: clsmith-hook.sh op010.ncl.1
# RECIPES, LOG and POST may come from the environment; change what stands here for your shop.
set -eu
here=$(dirname "$0")
recipes=${RECIPES:-$here/../recipes.yaml}
post=${POST:-$here/../post.py}

if [ $# -ne 1 ]; then
    echo "usage: $0 PROGRAM.ncl.1" >&2
    exit 2
fi
# op010.ncl.3 gives op010.tap: the number is Creo's version of the file.
output=$(printf '%s' "$1" | sed 's/\.[0-9]*$//; s/\.ncl$//').tap
# exec: the exit code is clsmith's, and a signal reaches it.
exec "${CLSMITH:-clsmith}" hook --select "$recipes" --log "${LOG:-$here/hook.jsonl}" --timeout 600 \
    "$1" -- "$post" -o "$output" {}
