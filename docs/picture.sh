#!/bin/bash
# Makes docs/report.png, the README's picture: the top of the default run's own report in Chromium.
#   docs/picture.sh [ZROBENCH]    the program; build/release's without it
set -euo pipefail
root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/.." && pwd)
zrobench=$(readlink -f -- "${1:-$root/build/release/rig/cli/zrobench}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$zrobench" run --ui none >run.txt || { cat run.txt; exit 1; }
chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$work/profile" \
  --window-size=1100,945 --virtual-time-budget=5000 --screenshot="$work/report.png" \
  "file://$(echo "$work"/runs/*/report.html)" 2>/dev/null
cp report.png "$root/docs/report.png"
