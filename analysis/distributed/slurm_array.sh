#!/usr/bin/env bash
# A study as a job array of Slurm: every task of the array runs one part of it, and a last job unites
# them. From a login node, in a folder that all nodes share:
#
#     slurm_array.sh STUDY PARTS OUT [SBATCH OPTION ...]
#     slurm_array.sh thesis_chapter5 64 out/thesis_chapter5 --partition=short --cpus-per-task=4
#
# STUDY is a file or the name of a study that ships. Parts stand in OUT.parts/1 ... and may be run
# again: what is stored is not run twice. `shoal` must be on PATH on all nodes, or in $SHOAL.
set -euo pipefail
[ $# -ge 3 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
study=$1 parts=$2 out=$3
shift 3
case $parts in '' | *[!0-9]* | 0*) echo "PARTS is \"$parts\"; give a number from 1" >&2; exit 2 ;; esac
shoal=${SHOAL:-shoal}
folder=$(pwd)
mkdir -p "$out.parts"
logs=${out//%/%%}.parts  # sbatch puts numbers for % and a letter

# A job: these words, quoted once and for all, are $1, $2 ... of the script on standard input.
job() {
  printf '#!/usr/bin/env bash\nset -euo pipefail\nset --'
  printf ' %q' "$@"
  printf '\n'
  cat
}

array=$(job "$shoal" "$study" "$parts" "$out.parts" <<'JOB' |
"$1" sweep "$2" --shard "$SLURM_ARRAY_TASK_ID/$3" --jobs "${SLURM_CPUS_PER_TASK:-1}" \
  --out "$4/$SLURM_ARRAY_TASK_ID"
JOB
  sbatch --parsable --array="1-$parts" --job-name=shoal --chdir="$folder" \
    --output="$logs/%a.log" "$@")
merge=$(job "$shoal" "$out" "$parts" <<'JOB' |
for ((i = 1; i <= $3; ++i)); do folders+=("$2.parts/$i"); done
"$1" merge "$2" "${folders[@]}"
"$1" report "$2"
JOB
  sbatch --parsable --dependency="afterok:$array" --job-name=shoal-merge --chdir="$folder" \
    --output="$logs/merge.log" "$@")
echo "submitted: array $array of $parts parts, then merge $merge into $out"
