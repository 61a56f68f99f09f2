#!/usr/bin/env bash
# slurm_array.sh with a stand-in for sbatch that runs each job at once: names with all that a shell
# takes for its own are names, and nothing else.
# Usage: slurm_quoting_test.sh SHOAL
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export SHOAL=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir bin
cat >bin/sbatch <<'SBATCH'
#!/usr/bin/env bash
set -euo pipefail
script=$(cat) array=1
for word in "$@"; do case $word in --array=*) array=${word#--array=1-} many=yes ;; esac; done
for ((i = 1; i <= array; ++i)); do
  SLURM_ARRAY_TASK_ID=${many:+$i} SLURM_CPUS_PER_TASK=1 bash -c "$script" >&2
done
echo 7
SBATCH
chmod +x bin/sbatch
PATH=$work/bin:$PATH

name='a $(touch ran) `touch ran` "b'\''c $5 %a %g; touch ran'
cat >"$name.toml" <<STUDY
scenario = "construction_square"
replications = 3
set = { trial.duration_s = 10 }
[[table]]
name = "energy"
rows = []
measures = ["energy_mean_wh"]
STUDY
"$here/../../analysis/distributed/slurm_array.sh" "$name.toml" 2 "out $name" 2>log ||
  { cat log; exit 1; }
[ ! -e ran ]
[ -s "out $name/report.html" ]
[ -s "out $name.parts/2/trials.sqlite" ]
echo "names are names"
