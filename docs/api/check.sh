#!/usr/bin/env bash
# Writes the API pages to build/api/html; a warning is an error. Exits with 77, which ctest counts as skipped, where
# doxygen is missing.
set -euo pipefail
cd "$(dirname -- "${BASH_SOURCE[0]}")/../.."
if [[ ! $(type -P doxygen) ]]; then
  echo "api: doxygen is missing: skipped" >&2
  exit 77
fi
mkdir -p build
doxygen docs/api/Doxyfile
