#!/usr/bin/env bash
# Installs a build into a folder of its own, builds engineer.cpp against that alone, and runs both.
# Usage: run.sh BUILD_DIR [CXX_COMPILER]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(realpath "$1")
compiler=${2:-c++}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
"$here/headers.sh" "$work/prefix"

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

# A plugin, out of tree.
cmake -S "$here/plugin" -B "$work/plugin" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/plugin"
plugin=$work/plugin/libmine.so
prefix/bin/shoal --plugin "$plugin" list | grep -c '^  my_' | grep -qx 5
prefix/bin/shoal --plugin "$plugin" describe my_jet | grep -F current.my_jet.width_m
prefix/bin/shoal --plugin "$plugin" run construction_square --out mine --no-report \
  --set trial.duration_s=60 --set current.kind=my_jet --set behaviour.kind=my_gathering \
  --set guidance.kind=my_pursuit --set measure.my_easting.from_m=-1e6
grep -E '"my_easting_m": (9|10)[0-9]{5}' mine/summary.json
grep -F from_m mine/scenario.toml
grep -F libmine.so- mine/summary.json
cat >mine.toml <<'STUDY'
scenario = "construction_square"
set = { trial.duration_s = 60, behaviour.kind = "attraction_repulsion" }
replications = 2
[[factor]]
key = "behaviour.attraction_repulsion.potential.kind"
values = ["thesis", "my_spring"]
[[table]]
name = "easting"
caption = "Where the swarm went"
rows = ["kind"]
measures = ["my_easting_m"]
STUDY
SHOAL_PLUGINS=$plugin prefix/bin/shoal sweep mine.toml --out study --jobs 2 --no-figures
grep -F "$plugin" study/manifest.json
refused() {  # what is said instead of a traceback or a crash
  local status=0
  "${@:2}" 2>complaint.txt || status=$?
  [ "$status" = 2 ] && [ "$(wc -l <complaint.txt)" = 1 ] && grep -F "$1" complaint.txt
}
refused 'is no plugin of shoal' prefix/bin/shoal --plugin prefix/lib/libshoal_core.so list
refused 'cannot read the plugin' prefix/bin/shoal --plugin nowhere.so list
refused 'cannot read the plugin' prefix/bin/shoal --plugin . list
refused 'has a colon in its path' prefix/bin/shoal --plugin ./a:b.so list
sed 's/shoal plugin, ABI /shoal plugin, ABI 9/' "$plugin" >foreign.so
refused 'was built for shoal 9' prefix/bin/shoal --plugin ./foreign.so list
cp "$plugin" twin.so
refused 'are called' prefix/bin/shoal --plugin "$plugin" --plugin ./twin.so list
refused 'no option "my_jet"' prefix/bin/shoal run construction_square --set current.my_jet.width_m=3

# The Python package and the report, where they were installed.
prefix/bin/shoal run construction_square --set trial.duration_s=60 --out out
[ -s out/report.html ]
for package in prefix/lib/python3*/dist-packages; do
  PYTHONPATH=$package /usr/bin/python3 -B - <<'PYTHON'
import json
import shoal

wanted = json.load(open("out/summary.json"))["measures"]
assert shoal.run("construction_square", {"trial.duration_s": 60}).measures == wanted
print("the installed package runs", shoal.program())
PYTHON
  PYTHONPATH=$package PLUGIN=$plugin /usr/bin/python3 -B - <<'PYTHON'
import json
import os
import shoal

shoal.load_plugin(os.environ["PLUGIN"])
run = shoal.run("construction_square", {"trial.duration_s": 60, "current.kind": "my_jet",
                                        "behaviour.kind": "my_gathering",
                                        "guidance.kind": "my_pursuit",
                                        "measure.my_easting.from_m": -1e6})
assert run.measures == json.load(open("mine/summary.json"))["measures"]
assert "my_jet" in shoal.catalogue()["current"]
assert "libmine.so-" in shoal.program()
PYTHON
done
