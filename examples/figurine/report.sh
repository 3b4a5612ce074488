#!/usr/bin/env bash
# Makes report.png beside this script: the page about the figurine's correction as a headless Chromium draws it
# (apt-get install chromium), without a graphics card.
set -euo pipefail
cd "$(dirname "$0")/../.."
for browser in chromium chromium-browser google-chrome google-chrome-stable; do
  if command -v "$browser" >/dev/null; then break; fi
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cargo run --locked -- apply examples/figurine/recipe.yaml examples/figurine/part.cls \
  --output "$work/part.cls" --report "$work/report.html"
rm -f examples/figurine/report.png
# Virtual time: the picture is taken when the page has done what it does in its first twenty seconds.
"$browser" --headless=new --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader \
  --hide-scrollbars --window-size=1300,1520 --virtual-time-budget=20000 --user-data-dir="$work/profile" \
  --screenshot="$PWD/examples/figurine/report.png" "file://$work/report.html#line=4337" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
test -s examples/figurine/report.png
