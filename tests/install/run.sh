#!/usr/bin/env bash
# Installs a build into a folder of its own, builds engineer.cpp against that alone, and runs both.
# Usage: run.sh BUILD_DIR [CXX_COMPILER]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$1
compiler=${2:-c++}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"

cmake -S "$here" -B "$work/build" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/build"
"$work/build/engineer"

# From elsewhere, and without what might point back to the build: it must find its library itself.
cd "$work"
unset SHOAL_LIBRARY LD_LIBRARY_PATH
prefix/bin/shoal list scenario | tee scenarios.txt
for scenario in redsea_square construction_hexagonal letters_nr; do
  grep -qw "$scenario" scenarios.txt || {
    echo "the installed shoal does not list $scenario" >&2
    exit 1
  }
done
if ldd prefix/bin/shoal | grep -F "$(cd "$build" && pwd)"; then
  echo "the installed shoal uses libraries of the build" >&2
  exit 1
fi

# The Python package and the report, where they were installed.
prefix/bin/shoal run construction_square --set trial.duration_s=60 --out out
[ -s out/report.html ]
for package in prefix/lib/python3*/dist-packages; do
  PYTHONPATH=$package /usr/bin/python3 -B - <<'PYTHON'
import json
import shoal

wanted = json.load(open("out/summary.json"))["metrics"]
assert shoal.run("construction_square", {"trial.duration_s": 60}).measures == wanted
print("the installed package runs", shoal.program)
PYTHON
done
