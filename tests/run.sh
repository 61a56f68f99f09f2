#!/usr/bin/env bash
# Installs what is needed, builds, and runs every check: format, lint, tests, sanitizers, install.
# Stops at the first failure. Longer forms of some checks are commands of their own; see README.md.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$top/scenarios/packages.sh"
export CTEST_PARALLEL_LEVEL=${CTEST_PARALLEL_LEVEL:-$(nproc)}

step() { printf '\n== %s (%d s)\n' "$1" "$SECONDS"; }

install_packages all
cd "$top"

step 'build'
cmake --preset ci
cmake --build --preset ci

step 'tests'
ctest --test-dir build/ci --output-on-failure

step 'every solver on every known problem'
build/ci/bin/solvers_test --gtest_brief=1 --gtest_filter='SolverMatrix.*'

step 'sanitizers'
cmake --preset asan >/dev/null
cmake --build --preset asan
ctest --test-dir build/asan --output-on-failure --exclude-regex 'install|python|browser|slurm'

step 'the same bits from two compilers'
/usr/bin/python3 tests/same_bits.py build/ci/bin/shoal build/asan/bin/shoal --scenarios 10

step 'format and lint'
/usr/bin/python3 tests/lint.py build/asan build/ci

step 'done'
