#!/usr/bin/env bash
# Fetches the page's library at its pinned version and puts it here; needs npm. README.md has the sums of the result.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
three=0.187.0
esbuild=0.28.2

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"
echo '{ "private": true }' > package.json
npm install --no-audit --no-fund --ignore-scripts --save-exact "three@$three" "esbuild@$esbuild"

cp node_modules/three/LICENSE "$here/three.LICENSE"
# three.js publishes modules only; the page takes one script of the parts that it uses.
cp "$here/three-entry.js" entry.js
node_modules/.bin/esbuild entry.js --bundle --minify --format=iife --global-name=THREE --charset=ascii \
  --banner:js="/*! three.js $three, MIT, Copyright 2010-2026 three.js authors */" --outfile="$here/three.iife.min.js"
cd "$here" && sha256sum three.iife.min.js
