#!/bin/sh
# check_freestanding.sh NM OBJDUMP ARCHIVE...: what the target's libraries may not hold.
set -eu
nm=$1 objdump=$2
shift 2
status=0
complain() {
  [ -z "$2" ] || { echo "$1:"; echo "$2" | sort -u; status=1; }
}
defined=$("$nm" --defined-only "$@" | awk 'NF == 3 { print $3 }')
undefined=$("$nm" -u "$@" | awk '$1 == "U" { print $2 }')
[ -n "$defined" ] || { echo "no symbols in $*"; exit 1; }
complain "asks for more than mem*, fabsf, sqrtf" \
  "$(echo "$undefined" | grep -vxF -e "$defined" | grep -vxE 'mem(cpy|set|move|cmp)|fabsf|sqrtf' || true)"
complain "variables (global or function-local state)" \
  "$("$nm" "$@" | awk 'NF == 3 && $2 ~ /[bBdDC]/ && $3 !~ /^_ZTV/' || true)"  # tables of virtual functions are constant
complain "code that runs before main" \
  "$("$objdump" -h "$@" | grep -E '\.(init_array|ctors)' || true)"
complain "double-precision instructions" \
  "$("$objdump" -d "$@" | grep -oE '\b(cvt(ss2sd|sd2ss|si2sdl?q?|t?sd2siq?)|(add|sub|mul|div|sqrt|ucomi|comi)sd)\b' || true)"
exit $status
