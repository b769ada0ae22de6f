#!/bin/bash
# Drives headless Chromium over the report of a fresh run.
#   tests/browser/run.sh [ZROBENCH]    the program; build/release's without it
set -euo pipefail
root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd)
source "$root/cmake/setup.sh"
zrobench=$(readlink -f -- "${1:-$root/build/release/rig/cli/zrobench}")

install_packages "$root/cmake/debian-packages-browser.txt"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$zrobench" run --ui none >run.txt || { cat run.txt; exit 1; }
ZROBENCH=$zrobench RUN=$(echo "$work"/runs/*) PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 "$root/tests/browser/report_test.py" -v
