# Functions of ./twin, tests/run and tests/fuzz/run: install what is missing, configure, build. Sourced, not run.
#
# Everything said here goes to stderr: stdout belongs to the program. On a terminal a stage is one line that rewrites
# itself; on a pipe it is one line, said when it begins.

TWIN_BUILD=$TWIN_ROOT/build/release

say() { printf '%s: %s\n' "$TWIN_SELF" "$*" >&2; }

# Says what stage begins, and keeps the text for its progress.
stage() {
  TWIN_STAGE=$1
  if [[ -t 2 ]]; then printf '\r\033[K%s: %s' "$TWIN_SELF" "$TWIN_STAGE" >&2; else say "$TWIN_STAGE"; fi
}

# Ends the line that rewrites itself.
stage_done() { if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi; }

# Reads a tool's output: all of it goes to the log; on a terminal the last line's sense shows behind the stage.
show_progress() {
  local line what columns
  columns=$(tput cols 2>/dev/null || echo 80)
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$TWIN_BUILD/build.log"
    [[ -t 2 ]] || continue
    case $line in
      '['*'] '*)  # [12/45] Building CXX object src/gcode/CMakeFiles/...: the folder
        what=${line#*object }
        what=${what#*executable }
        what=${what#*library }
        what="${line%%] *}] ${what%%/CMakeFiles*}"
        ;;
      Unpacking* | 'Setting up'*)
        what=${line%% (*}
        what=${what%%:*}
        ;;
      *) continue ;;
    esac
    what="$TWIN_SELF: $TWIN_STAGE $what"
    printf '\r\033[K%s' "${what:0:columns-1}" >&2
  done
}

# Runs a command with its output in the build's log. If it fails, shows what the compiler (or any tool) said.
logged() {
  : >"$TWIN_BUILD/build.log"
  local status=0
  { "$@" 2>&1 || status=$?; exit "$status"; } | show_progress || status=$?
  stage_done
  if ((status != 0)); then
    if grep -qE '^FAILED: |error:' "$TWIN_BUILD/build.log"; then
      # Not the compiler's command line, which is longer than its message.
      awk '/^FAILED: /{shown = 1; print; getline; next} /^\[[0-9]+\/[0-9]+\]|^ninja: /{shown = 0} shown || /rror:/' \
        "$TWIN_BUILD/build.log" | head -n 60 >&2
    else
      tail -n 40 "$TWIN_BUILD/build.log" >&2
    fi
    say "$TWIN_STAGE failed; everything that was said is in $TWIN_BUILD/build.log"
    exit 1
  fi
}

# Names of the packages that are missing, one a line. $1: "program"; or "tests" or "fuzz", with those of the program.
missing_packages() {
  local name use why
  while read -r name use why; do
    case $name in '' | '#'*) continue ;; esac
    [[ $use == program || $use == "$1" ]] || continue
    [[ $(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null || true) == installed ]] || echo "$name $why"
  done <"$TWIN_ROOT/cmake/packages.txt"
}

install_packages() {
  "${as_root[@]}" apt-get update -q &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"
}

# Installs missing packages, or with TWIN_NO_INSTALL=1 only names them.
install_missing() {
  if ! command -v dpkg-query >/dev/null; then
    say "this is no Debian: cmake/packages.txt lists what must be there"
    return
  fi
  local missing names name why as_root=()
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
    sudo -v  # asks for the password while nothing rewrites the line
    as_root=(sudo)
  fi
  stage "installing them with apt-get"
  logged install_packages "${names[@]}"
}

# Gets what the test in a browser needs: Chromium from Debian, playwright-core from npm. It is tried once a build folder,
# and what cannot be had is left out: that test then says what it lacks and is skipped.
set_up_browser() {
  local folder=$TWIN_BUILD/browser as_root=()
  [[ ${TWIN_NO_INSTALL:-} != 1 && ! -f $folder/.tried ]] || return 0
  mkdir -p "$folder"
  touch "$folder/.tried"
  ((EUID == 0)) || as_root=(sudo -n)
  stage "getting a browser for the tests"
  if ! command -v chromium >/dev/null && command -v dpkg-query >/dev/null; then
    (install_packages chromium) >"$folder/install.log" 2>&1 || true
  fi
  if [[ ! -d $folder/node_modules/playwright-core ]] && command -v npm >/dev/null; then
    timeout 60 npm install --prefix "$folder" --no-save --no-audit --no-fund playwright-core@1.65.1 \
      >>"$folder/install.log" 2>&1 || true
  fi
  stage_done
}

# build <program|tests|asan|tsan|fuzz> <ninja target>...
#
# One tree and one set of flags for the program and its tests; the programs of libFuzzer are clang's, with sanitizers, in
# a tree of their own ($TWIN_BUILD of tests/fuzz/run), and so are tests with sanitizers. One at a time. When nothing has changed it costs one
# `ninja -n`.
build() {
  local use=$1 configured= options packages=$1
  shift
  case $use in
    program) options=(-DTWIN_BUILD_TESTS=OFF) ;;
    tests) options=(-DTWIN_BUILD_TESTS=ON) ;;
    asan | tsan)
      options=(--preset "$use" -DTWIN_BUILD_TESTS=ON)
      packages=tests
      ;;
    fuzz)
      options=(-DTWIN_BUILD_TESTS=OFF -DTWIN_BUILD_FUZZ=ON -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo
        "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -gline-tables-only -DEIGEN_NO_DEBUG" -DTWIN_SANITIZE=address,undefined,fuzzer-no-link)
      ;;
  esac
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
  if [[ ! $TWIN_BUILD/.installed_$use -nt $TWIN_ROOT/cmake/packages.txt ]]; then
    install_missing "$packages"
    touch "$TWIN_BUILD/.installed_$use"
  fi
  [[ -f $TWIN_BUILD/build.ninja ]] && configured=yes
  if [[ $use == tests ]] && ! grep -qxF 'TWIN_BUILD_TESTS:BOOL=ON' "$TWIN_BUILD/CMakeCache.txt" 2>/dev/null; then
    configured=
  fi
  if [[ -z $configured ]]; then
    stage "configuring"
    logged cmake -S "$TWIN_ROOT" -B "$TWIN_BUILD" -G Ninja "${options[@]}"
  fi
  if [[ $(ninja -C "$TWIN_BUILD" -n "$@" 2>&1 | tail -n 1) != 'ninja: no work to do.' ]]; then
    stage "building"
    logged ninja -C "$TWIN_BUILD" -j "$(nproc)" "$@"
  fi
  exec 9>&-
}
