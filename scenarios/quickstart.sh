#!/usr/bin/env bash
# From a fresh Debian 12 to the first swarm: installs the packages, builds shoal, runs redsea_square.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
. "$top/scenarios/packages.sh"

install_packages build
cd "$top"
cmake --preset release -DSHOAL_TESTS=OFF >/dev/null
cmake --build --preset release
build/release/bin/shoal run redsea_square --out out/redsea_square

cat <<EOF

That was 20 vehicles for five hours in an ocean current.
  $top/out/redsea_square/report.html    to look at: the mission plays in any browser
  $top/out/redsea_square/summary.json   how well it went
  $top/out/redsea_square/run.nc         where every vehicle was (open it with xarray)
Another behaviour:
  $top/build/release/bin/shoal run redsea_square --set behaviour.kind=pairwise_referencing
What else there is:
  $top/build/release/bin/shoal list
The same from Python:
  PYTHONPATH=$top/build/release/python /usr/bin/python3 -c 'import shoal; help(shoal)'
EOF
