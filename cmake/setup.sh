# Shared by ./zrobench and ./run-tests: from a bare Debian 12 to a configured build folder.
# Sourced by bash; $root is the checkout. Talks on stderr only: stdout belongs to the program.

say() { printf '%s\n' "$*" >&2; }

# run_quietly WHAT COMMAND...: one line, and the command's output only when it fails.
run_quietly() {
  local what=$1 log status=0
  shift
  log=$(mktemp)
  say "$what ..."
  "$@" >"$log" 2>&1 </dev/null || status=$?
  if ((status)); then
    cat "$log" >&2
    say "$what failed (exit status $status)"
  fi
  rm -f "$log"
  return "$status"
}

# install_packages LIST...: Debian packages named in the files, one a line. Asks dpkg once.
install_packages() {
  local wanted missing as_root=()
  mapfile -t wanted < <(cat "$@")
  mapfile -t missing < <(comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      sed -n 's/^installed //p' | sort -u))
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "These Debian packages are missing: ${missing[*]}"
      say "Neither root nor sudo here: ask an administrator to apt-get install them."
      return 1
    fi
    as_root=(sudo)
  fi
  # A package list may be weeks old or absent; refreshing it costs less than explaining a 404.
  run_quietly "refreshing the package lists" "${as_root[@]}" apt-get update
  run_quietly "installing ${missing[*]}" "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}

# configure PRESET: once; afterwards ninja itself sees when CMake files change.
# A build folder configured without the test packages is configured again when tests are wanted.
configure() {
  local preset=$1
  shift
  local dir=$root/build/$preset option
  for option in "$@"; do
    grep -qxF -- "$option" "$dir/.configured" 2>/dev/null || rm -f "$dir/.configured"
  done
  [[ -f $dir/build.ninja && -f $dir/.configured ]] && return 0
  (cd "$root" && run_quietly "configuring $preset" cmake --preset "$preset" "${@/#/-D}") || return
  printf '%s\n' "" "$@" >"$dir/.configured"
}

# build PRESET TARGET...: says so only when there is something to build.
build() {
  local preset=$1 dir=$root/build/$1
  shift
  if ninja -C "$dir" -n "$@" 2>/dev/null | grep -q 'no work to do'; then return 0; fi
  run_quietly "building $preset" ninja --quiet -C "$dir" "$@"
}
