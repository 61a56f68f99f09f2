#!/usr/bin/env bash
# tests/lint.sh BUILD_DIR: clang-format and clang-tidy on everything of ours.
set -euo pipefail
build=$1
mapfile -t files < <(find core solvers formations scenarios analysis tests \
  \( -name '*.cpp' -o -name '*.hpp' \) | sort)
clang-format --dry-run --Werror "${files[@]}"

mapfile -t sources < <(find core solvers formations scenarios analysis -name '*.cpp' | sort)
printf '%s\n' "${sources[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet \
    --extra-arg=-Wno-unknown-warning-option 2> >(grep -v "warnings.* generated" >&2)
