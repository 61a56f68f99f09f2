#!/usr/bin/env bash
# The same targets on another processor: builds the planner alone for this machine and for aarch64, which
# is run by an emulator, and compares what every behaviour answers in 500 drawn neighbourhoods.
# Needs Debian's g++-aarch64-linux-gnu and qemu-user, which it installs. Some minutes.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
apt-get install -y --no-install-recommends g++-aarch64-linux-gnu qemu-user >/dev/null

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for processor in x86_64 aarch64; do
  compiler=$processor-linux-gnu-g++
  for source in "$top" "$top/tests/install"; do
    build=$work/$processor-$(basename "$source")
    cmake -S "$source" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
      -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR="$processor" -DCMAKE_BUILD_TYPE=Release \
      -DEigen3_DIR=/usr/share/eigen3/cmake -DCMAKE_INSTALL_PREFIX="$work/$processor" \
      -DCMAKE_INSTALL_LIBDIR=lib -Dshoal_DIR="$work/$processor/lib/cmake/shoal" \
      -DSHOAL_COMPONENTS=formations -DSHOAL_NLOPT=OFF -DSHOAL_CERES=OFF -DSHOAL_IPOPT=OFF \
      -DSHOAL_BOOST=OFF -DSHOAL_CGAL=OFF -DSHOAL_GINAC=OFF -DSHOAL_MEMBERS=ON >"$work/log" 2>&1 ||
      { cat "$work/log"; exit 1; }
    cmake --build "$build" >"$work/log" || { cat "$work/log"; exit 1; }
    [ "$source" != "$top" ] || cmake --install "$build" >"$work/log"
  done
done
"$work/x86_64-install/targets" >"$work/here.txt"
qemu-aarch64 -L /usr/aarch64-linux-gnu "$work/aarch64-install/targets" >"$work/there.txt"
/usr/bin/python3 - "$work/here.txt" "$work/there.txt" <<'PYTHON'
import collections
import sys

here, there = ([line.split() for line in open(name)] for name in sys.argv[1:])
assert len(here) == len(there) > 1000
largest, differing, count = collections.Counter(), collections.Counter(), collections.Counter()
for a, b in zip(here, there):
    assert a[:2] == b[:2]
    count[a[0]] += 1
    differing[a[0]] += a != b
    away = max(abs(float(x) - float(y)) for x, y in zip(a[3:], b[3:]))
    largest[a[0]] = max(largest[a[0]], away if a[2] == b[2] else float("inf"))
print(f"{'behaviour':26}{'targets':>8}{'other bits':>12}{'at most apart':>16}")
for name in count:
    print(f"{name:26}{count[name]:8}{differing[name]:12}{largest[name]:16.2g}")
PYTHON
