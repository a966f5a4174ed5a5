# Functions of ./twin and tests/run: install what is missing, configure, build. Sourced, not run.
#
# Everything said here goes to stderr: stdout belongs to the program.

say() { printf '%s: %s\n' "$TWIN_SELF" "$*" >&2; }

# Names of the packages that are missing, one a line. $1: "program", or "tests" for those of the program too.
missing_packages() {
  local name use why
  while read -r name use why; do
    case $name in '' | '#'*) continue ;; esac
    [[ $use == program || $use == "$1" ]] || continue
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null || true) == installed ]] || echo "$name $why"
  done <"$TWIN_ROOT/cmake/packages.txt"
}

# Installs missing packages, or with TWIN_NO_INSTALL=1 only names them.
install_missing() {
  if ! command -v dpkg-query >/dev/null; then
    say "this is no Debian: cmake/packages.txt lists what must be there"
    return
  fi
  local missing names as_root=()
  missing=$(missing_packages "$1")
  [[ -n $missing ]] || return 0
  say "these Debian packages are needed and missing:"
  while read -r name why; do printf '  %-22s %s\n' "$name" "$why" >&2; done <<<"$missing"
  if [[ ${TWIN_NO_INSTALL:-} == 1 ]]; then
    say "TWIN_NO_INSTALL=1: not installing them"
    exit 1
  fi
  mapfile -t names < <(cut -d' ' -f1 <<<"$missing")
  if ((EUID != 0)); then
    command -v sudo >/dev/null || {
      say "neither root nor sudo; as root run: apt-get install ${names[*]}"
      exit 1
    }
    as_root=(sudo)
  fi
  say "installing them: ${as_root[*]:+sudo }apt-get install ${names[*]}"
  {
    "${as_root[@]}" apt-get update -q &&
      "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${names[@]}"
  } >&2 || {
    say "apt-get failed; nothing was built"
    exit 1
  }
}

# Runs a command with its output in the build's log; shows the log's end if it fails.
logged() {
  "$@" >>"$TWIN_BUILD/build.log" 2>&1 || {
    tail -n 40 "$TWIN_BUILD/build.log" >&2
    say "failed: $1; the whole log is $TWIN_BUILD/build.log"
    exit 1
  }
}

# build <folder under build/> <program|tests> <ninja target> [cmake options]
#
# Sets TWIN_BUILD. One at a time per folder. When nothing has changed it costs one `ninja -n`.
build() {
  local folder=$1 use=$2 target=$3
  shift 3
  TWIN_BUILD=$TWIN_ROOT/build/$folder
  mkdir -p "$TWIN_BUILD"
  exec 9>"$TWIN_BUILD/.lock"
  flock 9
  # A tree that was moved cannot use its old build.
  if [[ -f $TWIN_BUILD/CMakeCache.txt ]] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$TWIN_ROOT" "$TWIN_BUILD/CMakeCache.txt"; then
    rm -rf "$TWIN_BUILD"
    mkdir -p "$TWIN_BUILD"
    exec 9>"$TWIN_BUILD/.lock"
    flock 9
  fi
  if [[ ! $TWIN_BUILD/.installed -nt $TWIN_ROOT/cmake/packages.txt ]]; then
    install_missing "$use"
    touch "$TWIN_BUILD/.installed"
  fi
  if [[ ! -f $TWIN_BUILD/build.ninja ]]; then
    : >"$TWIN_BUILD/build.log"
    logged cmake -S "$TWIN_ROOT" -B "$TWIN_BUILD" -G Ninja "$@"
  fi
  if [[ $(ninja -C "$TWIN_BUILD" -n "$target" 2>&1 | tail -n 1) != 'ninja: no work to do.' ]]; then
    say "building (log: build/$folder/build.log)"
    : >"$TWIN_BUILD/build.log"
    logged ninja -C "$TWIN_BUILD" -j "$(nproc)" "$target"
  fi
  exec 9>&-
}
