#!/usr/bin/env bash
# slurm_array.sh with a Slurm of this machine's own: munged, slurmctld and slurmd on loopback, in a
# folder that goes away. Needs root, and Debian's slurm-wlm and munge.
# Usage: slurm_test.sh SHOAL
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export SHOAL=$(realpath "$1")
for needed in munged slurmctld slurmd sbatch; do
  command -v $needed >/dev/null || PATH=$PATH:/usr/sbin
  command -v $needed >/dev/null || { echo "skipped: there is no $needed; install slurm-wlm and munge"; exit 0; }
done
[ "$(id -u)" -eq 0 ] || { echo "skipped: Slurm's daemons need root"; exit 0; }

work=$(mktemp -d)
processes=()
trap 'kill -9 "${processes[@]}" 2>/dev/null && wait 2>/dev/null || true; rm -rf "$work"' EXIT
chmod 755 "$work"
cd "$work"
mkdir munge ctld d
chmod 755 munge
head -c 1024 /dev/urandom >munge.key
chmod 400 munge.key
cat >slurm.conf <<CONF
ClusterName=loopback
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=26817
SlurmdPort=26818
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
SlurmUser=root
StateSaveLocation=$work/ctld
SlurmdSpoolDir=$work/d
SlurmctldPidFile=$work/ctld.pid
SlurmdPidFile=$work/d.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
ReturnToService=2
MpiDefault=none
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf
munged --foreground --force --key-file=munge.key --socket=munge/socket --pid-file=munge/pid \
  --log-file=munge/log --seed-file=munge/seed >munge.out 2>&1 &
processes+=($!)
for _ in $(seq 100); do [ -S munge/socket ] && break; sleep 0.1; done
slurmctld -D -f slurm.conf >ctld.log 2>&1 &
processes+=($!)
slurmd -D -f slurm.conf >d.log 2>&1 &
processes+=($!)
for _ in $(seq 200); do sinfo -h -o %T 2>/dev/null | grep -q idle && break; sleep 0.2; done
sinfo -h -o %T 2>/dev/null | grep -q idle || { tail -n 5 ctld.log d.log munge.out; echo "skipped: Slurm does not start on this machine"; exit 0; }

cat >study.toml <<STUDY
scenario = "construction_square"
replications = 6
set = { trial.duration_s = 120 }
[[factor]]
key = "ping.period_s"
values = [10, 30]
[[table]]
name = "energy"
rows = ["period_s"]
measures = ["energy_mean_wh"]
STUDY
"$SHOAL" sweep study.toml --out one >/dev/null
"$here/../../analysis/distributed/slurm_array.sh" study.toml 3 many
for _ in $(seq 300); do [ -z "$(squeue -h)" ] && break; sleep 0.2; done
cat many.parts/*.log
cmp one/tables/energy.tex many/tables/energy.tex
[ -s many/report.html ]
echo "a job array of three parts gave the tables of one machine"
