#!/bin/bash
# The blind benchmark: conceal, seal, diagnose, open, score.
#   tests/blind/run.sh [--set smoke|full] [--resume] [--seed N] [--out DIR] [--build DIR]
# The seed follows from the commit under test, so that nobody chose it. Resumable: cases that stand
# and answers that stand are kept (--resume; without it the folder must not exist).
set -euo pipefail
root=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.." && pwd)
set_name=smoke resume=0 seed='' out='' build=$root/build/release
usage() { sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }
while (($#)); do
  case $1 in
    --set) set_name=$2; shift ;;
    --resume) resume=1 ;;
    --seed) seed=$2; shift ;;
    --out) out=$2; shift ;;
    --build) build=$2; shift ;;
    -h | --help) usage; exit 0 ;;
    *) echo "run.sh: unknown argument '$1'" >&2; usage >&2; exit 2 ;;
  esac
  shift
done

commit=$(git -C "$root" rev-parse HEAD)
[[ -n $(git -C "$root" status --porcelain --untracked-files=no) ]] && echo "note: the work tree differs from $commit"
seed=${seed:-$((16#${commit:0:15}))}
out=${out:-$root/build/blind-$set_name-${commit:0:12}}
generate=$build/tests/blind/blind_generate
zrobench=$build/rig/cli/zrobench
[[ -x $generate ]] || { echo "run.sh: $generate is not built: cmake --build $build --target blind_generate" >&2; exit 2; }
if [[ -e $out && $resume == 0 ]]; then
  echo "run.sh: $out exists; --resume goes on with it" >&2
  exit 2
fi

echo "commit $commit, set $set_name, seed $seed"
echo "SHA-256 of each label and nonce, before anything is analysed:"
"$generate" --seed "$seed" --set "$set_name" --out "$out/cases" --sealed "$out/sealed"

if [[ ! -x $zrobench ]] || ! "$zrobench" diagnose --help >/dev/null 2>&1; then
  echo "run.sh: $zrobench has no verb 'diagnose' yet; the cases are ready in $out/cases" >&2
  exit 2
fi
number=0
total=$(wc -l <"$out/sealed/hashes.txt")
for folder in "$out"/cases/case-*; do
  number=$((number + 1))
  [[ -s $folder/diagnosis.json ]] && continue
  began=$(date +%s)
  # Copied out, so that nothing but columns and station file is within reach.
  work=$(mktemp -d)
  cp "$folder"/station.toml "$folder"/run-*.csv "$work"
  if "$zrobench" diagnose "$work" --json >"$folder/diagnosis.part" 2>"$folder/diagnosis.err"; then
    mv "$folder/diagnosis.part" "$folder/diagnosis.json"
  else
    echo "  ${folder##*/}: exit code $?: $(head -c 200 "$folder/diagnosis.err")"
    echo "{\"failed\": \"zrobench diagnose\"}" >"$folder/diagnosis.json"
  fi
  rm -rf "$work"
  echo "  $number of $total: ${folder##*/}, $(($(date +%s) - began)) s"
done
"$root/tests/blind/blind_score.py" --cases "$out/cases" --sealed "$out/sealed" --json "$out/score.json" |
  tee "$out/score.txt"
