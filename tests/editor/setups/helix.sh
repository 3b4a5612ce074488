#!/usr/bin/env bash
# What a newcomer to Helix gets: run in examples/pocket by `scripts/check-editors`, in a terminal of tmux.
set -euo pipefail
export TERM=xterm-256color
run() { tmux -L "clsmith-$$" "$@"; }
trap 'run kill-server 2>/dev/null || true' EXIT

# Waits until the screen shows a text.
see() {
  for _ in $(seq 100); do
    if run capture-pane -p | grep -qF "$1"; then return; fi
    sleep 0.1
  done
  run capture-pane -p >&2
  echo "helix: never on the screen: $1" >&2
  exit 1
}
press() { run send-keys "$@"; sleep 0.3; }

# Opens a file in a fresh Helix, and waits for it.
open() {
  run new-session -d -s "$1" -x 160 -y 44 "hx $1"
  see "$2"
}

open part.cls "TOOL PATH/POCKET_ROUGH"
press ":20" Enter
# The server may still be starting: the key is pressed until the state is there.
for _ in $(seq 20); do
  press " k"
  sleep 0.5
  if run capture-pane -p | grep -qF "1200 MMPM"; then break; fi
done
see "feed: 1200 MMPM"
press Escape
press " s"
see "function HOLES"
press Escape
press ":17" Enter
press x
press ":pipe sed s/1200/12O0/" Enter
press Escape
press " d"
see "CL0003"
press Escape
press ":q!" Enter

# A word that no recipe knows.
sed -i 's/clamp_feed/clamp_fed/' recipe.yaml
open recipe.yaml "steps:"
see "● 1"
press " d"
see "CL0"
press Escape
press ":q!" Enter
