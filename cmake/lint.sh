#!/bin/bash
# lint.sh BUILD_DIR: clang-format over all tracked sources, clang-tidy over those the build knows.
# A file that passed once is not looked at again until it, a header or the rules change.
set -euo pipefail
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
build=$(cd -- "$1" && pwd)
cd "$root"
passed=$build/lint-passed
mkdir -p "$passed"

mapfile -t sources < <(git ls-files '*.cc' '*.h')
((${#sources[@]})) || exit 0
clang-format --dry-run -Werror "${sources[@]}"

# clang-tidy sees through includes: a changed header of ours makes every file new. Rules too.
rules=$( (cat .clang-tidy cmake/lint.sh; git ls-files -z '*.h' | xargs -0 cat) | sha256sum)
known=$(sed -n 's/^ *"file": "\(.*\)",\{0,1\}$/\1/p' "$build/compile_commands.json" | sort -u)
todo=()
keys=()
for file in "${sources[@]}"; do
  [[ $file == *.cc ]] && grep -qxF "$root/$file" <<<"$known" || continue
  key=$( (echo "$rules $file"; cat "$file") | sha256sum | cut -d' ' -f1)
  [[ -f $passed/$key ]] && continue
  todo+=("$file")
  keys+=("$key")
done
((${#todo[@]})) || { echo "lint: clean"; exit 0; }

echo "lint: clang-tidy over ${#todo[@]} files"
check() {
  clang-tidy --quiet -p "$build" "$2" 2>&1 | grep -v ' warnings\? generated\.$' |
    grep -v '^Suppressed\|^Use -' || true
  [[ ${PIPESTATUS[0]} -eq 0 ]] || { echo "lint: $2 failed"; return 1; }
  touch "$passed/$1"
}
export -f check
export build passed
paste -d' ' <(printf '%s\n' "${keys[@]}") <(printf '%s\n' "${todo[@]}") |
  xargs -P2 -L1 bash -c 'check "$@"' check
echo "lint: clean"
