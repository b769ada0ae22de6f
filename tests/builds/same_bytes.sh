#!/bin/bash
# The same seed gives the same bytes of record.ulg whatever the compiler's options: the default run by
# each of the programs named, optimised, plain and sanitized, compared byte by byte.
#   tests/builds/same_bytes.sh ZROBENCH ZROBENCH...
# The builds are held against each other, not against a digest kept here: what a run records may
# change with every improvement of corrector or physics, that builds agree may not.
set -euo pipefail
(($# >= 2)) || { sed -n '2,4s/^# \{0,1\}//p' "$0"; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
first=
for program in "$@"; do
  program=$(readlink -f -- "$program")
  mkdir "$work/run"
  (cd "$work/run" && "$program" run --seed 11 --ui none >out.txt) || { cat "$work/run/out.txt"; exit 1; }
  mv "$work"/run/runs/*/record.ulg "$work/record.ulg"
  rm -r "$work/run"
  if [[ -z $first ]]; then
    first=$program
    mv "$work/record.ulg" "$work/first.ulg"
  else
    cmp "$work/first.ulg" "$work/record.ulg" || {
      echo "$first and $program record different bytes for the same seed"
      exit 1
    }
  fi
done
echo "$# builds, the same $(stat -c %s "$work/first.ulg") bytes"
