#!/usr/bin/env bash
# Names every C++ file that clang-format would change: tests/rooms/format.sh; with --fix it formats them.
# Exits with 77, which ctest counts as skipped, where clang-format is missing or not the version of .clang-format.
set -euo pipefail
cd "$(dirname -- "${BASH_SOURCE[0]}")/../.."
wanted=14

version=$(clang-format --version 2>/dev/null | grep -oE '[0-9]+' | head -n 1) || true
if [[ $version != "$wanted" ]]; then
  echo "format: needs clang-format $wanted, found ${version:-none}: skipped" >&2
  exit 77
fi

mapfile -t files < <(find seif worlds sensors sim harness python tests -name '*.[ch]pp' -not -path '*/corpus/*' | sort)
if [[ ${1-} == --fix ]]; then
  clang-format -i "${files[@]}"
elif ! clang-format --dry-run -Werror "${files[@]}"; then
  echo "format: tests/rooms/format.sh --fix formats them" >&2
  exit 1
fi
