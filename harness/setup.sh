# What ./seifbed and ./test share: install the packages that are missing, configure a preset, build it.
# Sourced by both. All that it says goes to stderr: stdout is the program's.
# shellcheck shell=bash

: "${root:?must be the top of the tree}"

# Each package and what it is for.
packages=(
  "g++                   C++20 compiler"
  "cmake                 configures the build"
  "ninja-build           builds"
  "pkg-config            finds Bullet"
  "git                   tells the version"
  "libbullet-dev         physics, in double precision"
  "libeigen3-dev         linear algebra"
  "libyaml-cpp-dev       reads world files"
  "libfmt-dev            formats text"
  "libcli11-dev          reads the command line"
  "libboost-dev          quantiles of Student's distribution"
  "libceres-dev          solves for the optimum of a run"
  "nlohmann-json3-dev    writes summaries and schemas"
  "libgtest-dev          tests"
  "libbenchmark-dev      benchmarks"
  "libosmesa6-dev        renders films without a display"
  "libgl-dev             declares OpenGL's core functions"
  "libfreetype-dev       draws the letters of films"
  "fonts-roboto-unhinted the letters themselves"
  "libpng-dev            writes and reads images"
  "ffmpeg                encodes films"
  "gnuplot-nox           draws figures for papers"
  "libjs-chart.js        plots in reports and in the live page"
  "libjs-three           the scene of the live page"
)

# What ./test installs besides: the program works with these, and without.
test_packages=(
  "munge                 lets the parts of Slurm trust each other"
  "slurm-wlm             runs sweeps on a cluster"
  "chromium-headless-shell opens reports as people see them"
  "clang-format          checks the format"
  "doxygen               checks the API pages"
)

# The Python package; ./seifbed python and ./test install it.
python_packages=(
  "python3-dev           the interpreter's headers"
  "pybind11-dev          binds C++ to Python"
  "python3-numpy         arrays"
  "python3-pandas        tables"
  "python3-matplotlib    plots"
  "python3-pytest        tests of the package"
  "python3-nbconvert     runs the notebooks"
  "python3-ipykernel     their kernel"
)

# Other people's filters to measure ours against; with SEIFBED_PEERS=1 they are installed, and where they are they are
# built with the rest.
peer_packages=(
  "libmrpt-slam-dev      MRPT's EKF-SLAM, as mrpt_ekf"
)
[[ ! ${SEIFBED_PEERS-} ]] || packages+=("${peer_packages[@]}")

say() { printf 'set-up: %s\n' "$*" >&2; }

die() {
  say "error: $*"
  exit 1
}

# Fills `missing` with the entries of `packages` that dpkg does not have.
find_missing() {
  local installed entry
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]%% *}" 2>/dev/null) || true
  missing=()
  for entry in "${packages[@]}"; do
    [[ $'\n'$installed$'\n' == *$'\n'"installed ${entry%% *}"$'\n'* ]] || missing+=("$entry")
  done
}

# Any system but Debian and its kin: the packages have other names there, so that they can only be asked for.
ask_for_packages() {
  say "this system has no apt-get; by Debian's names, seifbed needs:"
  printf '  %s\n' "${packages[@]}" >&2
  [[ $(type -P cmake) && $(type -P ninja) && $(type -P "${CXX:-c++}") ]] ||
    die "cmake, ninja or the compiler is missing: install the above and call again"
  say "cmake, ninja and a compiler are here: going on with them"
}

install_packages() {
  local missing apt
  find_missing
  ((${#missing[@]})) || return 0
  say "missing packages:"
  printf '  %s\n' "${missing[@]}" >&2

  apt=(env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300)
  if ((EUID != 0)); then
    [[ $(type -P sudo) ]] || die "installing needs root or sudo. As root: apt-get install ${missing[*]%% *}"
    apt=(sudo "${apt[@]}")
  fi
  say "installing them with ${apt[*]}"
  "${apt[@]}" update </dev/null >&2 || say "apt-get update failed: trying the package lists at hand"
  "${apt[@]}" install --yes --no-install-recommends "${missing[@]%% *}" </dev/null >&2 ||
    die "apt-get could not install: ${missing[*]%% *}"
}

# Whether a build has not found the peers that it was told to have.
lacks_peers() { [[ ${SEIFBED_PEERS-} ]] && grep -qxF "mrpt-slam_DIR:PATH=mrpt-slam_DIR-NOTFOUND" "$1/CMakeCache.txt"; }

# Whether a build was configured before the packages for Python were there, and is to have them.
lacks_python() {
  [[ ${packages[*]} == *pybind11-dev* ]] && grep -qxE "pybind11_DIR:PATH=(pybind11_DIR-NOTFOUND)?" "$1/CMakeCache.txt"
}

# Configures unless the folder holds a build of this very tree by these very presets: a tree that was copied or moved
# with its build folder would else go on building the old one.
configure() {
  local preset=$1 folder=$2
  if [[ $folder/build.ninja -nt $root/CMakePresets.json ]] &&
    grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt" && ! lacks_peers "$folder" &&
    ! lacks_python "$folder"; then
    return 0
  fi
  say "configuring $folder"
  cmake --fresh --preset "$preset" -S "$root" </dev/null >&2 || die "cmake could not configure the build"
}

# Says nothing when there is nothing to do.
build() {
  local folder=$1 plan
  shift
  plan=$(ninja -C "$folder" -n "$@" 2>&1) || true
  [[ $plan != *"no work to do"* ]] || return 0
  say "building $folder"
  ninja -C "$folder" "$@" </dev/null >&2 || die "the build failed"
}

# set_up PRESET [TARGET...]: leaves these targets (default: all) of the preset built and fresh, or exits. Calls on the
# same preset at the same time take turns.
set_up() {
  local preset=$1 folder=$root/build/$1 lock
  shift
  [[ -d $folder ]] || mkdir -p "$folder" || die "cannot make $folder"
  exec {lock}<"$folder"
  if ! flock --timeout 1 "$lock"; then
    say "waiting for another call that is building $folder"
    flock "$lock"
  fi
  if [[ $(type -P dpkg-query) && $(type -P apt-get) ]]; then
    install_packages
  elif [[ ! -f $folder/build.ninja ]]; then
    ask_for_packages
  fi
  configure "$preset" "$folder"
  build "$folder" "$@"
  exec {lock}<&-
}
