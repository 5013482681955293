#!/usr/bin/env bash
# install_test.sh SOURCE BUILD: installs the build, and uses it as its users would.
set -euo pipefail
source=$1 build=$2
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT
prefix=$scratch/prefix

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

cmake --install "$build" --prefix "$prefix" >"$scratch/install.log" || fail "cmake --install: $(cat "$scratch/install.log")"

# Headers for users, and no others.
[[ -f $prefix/include/seif/make_estimator.hpp ]] || fail "make_estimator.hpp was not installed"
[[ ! -e $prefix/include/seif/seif.hpp ]] || fail "seif.hpp is not for users"
[[ -s $prefix/share/man/man1/seifbed.1 ]] || fail "there is no man page"

build_example() {
  cmake -G Ninja -S "$source/docs/examples/$1" -B "$scratch/$1" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_BUILD_TYPE=Release "${@:2}" >"$scratch/$1.log" 2>&1 &&
    cmake --build "$scratch/$1" >>"$scratch/$1.log" 2>&1 || fail "$1 could not be built: $(cat "$scratch/$1.log")"
}

# The library of filters asks for Eigen alone.
build_example filter_on_your_data
! grep -qE '^(yaml-cpp|fmt|Ceres|Boost)_DIR' "$scratch/filter_on_your_data/CMakeCache.txt" ||
  fail "the filters ask for more than Eigen"
printed=$("$scratch/filter_on_your_data/filter_on_your_data")
[[ $printed == *"landmark 7: "*"landmark 3: "* ]] || fail "filter_on_your_data printed: $printed"

# A filter of one's own, in a world that comes with the program.
build_example own_filter
cd "$scratch"
"$prefix/bin/seifbed" --plugin own_filter/frozen_map.so run courtyard --duration 20 --quiet --out run \
  --set 'estimators={ekf: {}, frozen_map: {sightings: 3}}' || fail "the plug-in did not run"
grep -q frozen_map run/summary.json || fail "the plug-in was not scored"

# The Python package, where it was built.
site=$prefix/lib/python3/dist-packages
if [[ -d $site/seifbed ]]; then
  PYTHONPATH=$site /usr/bin/python3 -B -c '
import seifbed
print(seifbed.run("courtyard", seed=1, duration=2).scores.index[0])' >"$scratch/python.log" 2>&1 ||
    fail "the installed Python package does not run: $(cat "$scratch/python.log")"
fi

# The filters alone can be configured where nothing but Eigen is.
cmake -G Ninja -S "$source" -B "$scratch/filters" -DSEIFBED_TESTBED=OFF -DSEIFBED_TESTS=OFF >"$scratch/filters.log" 2>&1 ||
  fail "the filters alone could not be configured: $(cat "$scratch/filters.log")"
! grep -qE '^(yaml-cpp|fmt|Boost|PNG_LIBRARY|CERES)' "$scratch/filters/CMakeCache.txt" ||
  fail "the filters alone look for libraries of the testbed"
