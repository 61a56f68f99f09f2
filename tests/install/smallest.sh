#!/usr/bin/env bash
# The planner alone, without any backend: builds it, finds nothing but Eigen behind it, compares what it
# lists with a whole build, and runs the engineer's example against it.
# Usage: smallest.sh PROGRAM [CXX_COMPILER [BUILD_TYPE]]; Release also prints what it weighs.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$(realpath "$1")
compiler=${2:-c++}
type=${3:-Debug}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

unity=OFF
[ "$type" = Release ] || unity=ON  # half the time, for other bits
cmake -S "$here/../.." -B "$work/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_BUILD_TYPE="$type" -DCMAKE_UNITY_BUILD=$unity -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 \
  -DCMAKE_CXX_FLAGS_DEBUG=-O0 -DSHOAL_COMPONENTS=formations -DSHOAL_NLOPT=OFF -DSHOAL_CERES=OFF \
  -DSHOAL_IPOPT=OFF -DSHOAL_BOOST=OFF -DSHOAL_CGAL=OFF -DSHOAL_GINAC=OFF >"$work/configure.log"
cmake --build "$work/build" >"$work/build.log" || { cat "$work/build.log"; exit 1; }

# Whatever was compiled included this tree, the compiler's own headers, and Eigen.
foreign=$(ninja -C "$work/build" -t deps | sed -n 's/^ *\(\/usr\/include\/.*\)/\1/p' | sort -u |
  grep -vE '^/usr/include/(eigen3|c\+\+|[a-z0-9_]+-linux-gnu)/|^/usr/include/(asm-generic|linux)/|^/usr/include/[a-z0-9_-]+\.h$') || true
if [ -n "$foreign" ]; then
  printf 'the smallest build includes more than Eigen:\n%s\n' "$foreign" >&2
  exit 1
fi

cmake --install "$work/build" --prefix "$work/prefix" >"$work/install.log"
"$here/headers.sh" "$work/prefix"
cmake -S "$here" -B "$work/engineer" -DCMAKE_CXX_COMPILER="$compiler" -DSHOAL_MEMBERS=ON \
  -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/engineer.log"
cmake --build "$work/engineer"
"$work/engineer/engineer"

"$work/engineer/members" >"$work/members.txt"
cut -d' ' -f1 "$work/members.txt" | sort -u | while read -r family; do
  "$program" list "$family" | sed -n "s/^  \([a-z][^ ]*\).*/$family \1/p"
done | sort >"$work/whole.txt"
diff "$work/whole.txt" <(sort "$work/members.txt")

if cmake -S "$here" -B "$work/more" -DCMAKE_PREFIX_PATH="$work/prefix" -DSHOAL_NEEDED=analysis \
  >"$work/more.log" 2>&1; then
  echo 'a component that was not built is found' >&2
  exit 1
fi
grep -q 'this shoal was built without analysis' "$work/more.log"

if [ "$type" = Release ]; then
  strip "$work"/prefix/lib/libshoal_*.so.0.*
  du -cb "$work"/prefix/lib/libshoal_*.so.0.* | awk '{ printf "%8.0f kB %s\n", $1 / 1000, $2 }' |
    sed 's| /.*/| |'
fi
