#!/usr/bin/env bash
# Starts a Slurm of one node in a temporary folder, runs the two scripts beside this one on it, compares with a run
# without Slurm, and takes everything down again. Needs root, and Debian's packages:
#
#   apt-get install slurm-wlm munge
#   examples/cluster/slurm/try-one-node.sh target/release/clsmith
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
binary=$(realpath "${1:-$(command -v clsmith)}")
for tool in munged slurmctld slurmd sbatch; do
    command -v "$tool" >/dev/null || { echo "$tool is missing: apt-get install slurm-wlm munge" >&2; exit 1; }
done
[ "$(id -u)" = 0 ] || { echo "slurmd needs root" >&2; exit 1; }

work=$(mktemp -d)
chmod 755 "$work"
pids=()
finish() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
    rm -rf "$work"
}
trap finish EXIT
failed() { echo "$1" >&2; tail -n 20 "$work"/*.log "$work"/*.out >&2 || true; exit 1; }
soon() { for _ in $(seq 300); do if "$@" >/dev/null 2>&1; then return; fi; sleep 0.2; done; failed "waited in vain: $*"; }

# A Slurm of its own: its key, its ports, nothing in /etc or /var.
mkdir -p "$work"/{state,spool}
head -c 1024 /dev/urandom >"$work/munge.key"
chmod 600 "$work/munge.key"
munged --foreground --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
    --log-file="$work/munged.log" --seed-file="$work/munge.seed" >"$work/munge.out" 2>&1 &
pids+=($!)
host=$(hostname -s)
processors=$(nproc)
cat >"$work/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$processors RealMemory=2000 State=UNKNOWN
PartitionName=shop Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf
soon munge --socket="$work/munge.socket" --no-input
slurmctld -D >"$work/ctld.out" 2>&1 &
pids+=($!)
slurmd -D >"$work/d.out" 2>&1 &
pids+=($!)
soon sh -c 'sinfo --noheader --format=%t | grep -qx idle'
sinfo

# Sixty programs, one of them broken.
mkdir -p "$work/bin" "$work/shop/programs"
ln -s "$binary" "$work/bin/clsmith"
export PATH=$work/bin:$PATH
cd "$work/shop"
for number in $(seq 60); do
    printf 'TOOL PATH/OP%s,TOOL,T1\nFEDRAT/MMPM,%s00.0\nGOTO/1.0,2.0,3.0\nEND-OF-PATH\n' "$number" "$number" >"programs/p$number.cls"
done
echo 'GOTO/x' >programs/bad.cls
printf 'version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n' >recipe.yaml
printf "out: done\njobs:\n  - { recipe: recipe.yaml, files: ['programs/*.cls'] }\n" >jobs.yaml

ended() { [ -z "$(squeue --noheader --jobs="$1" 2>/dev/null)" ]; }
# Small enough for any node; the scripts' own numbers are for real ones.
small=(--parsable --cpus-per-task=1 --mem=500 --chdir="$work/shop")
array=$(sbatch "${small[@]}" --array=1-3 --export=ALL,JOBS="$work/shop/jobs.yaml" "$here/batch.sbatch")
merge=$(sbatch "${small[@]}" --dependency="afterany:$array" --export=ALL,OUT="$work/shop/done",SHARDS=3 "$here/merge.sbatch")
soon ended "$array"
soon ended "$merge"
tail -n +1 clsmith-*.log

# A whole run without Slurm has the same results and outputs.
clsmith batch jobs.yaml -o alone --quiet 2>/dev/null && failed "the broken program was not found"
cmp done/results.jsonl alone/results.jsonl
diff --recursive --exclude='.clsmith-batch*' --exclude='results-*' done alone

# The broken one is repaired, and its shard alone runs again.
bad=$(grep -l 'programs/bad.cls' done/results-*-of-3.jsonl | sed 's/.*results-\([0-9]*\)-of.*/\1/')
echo 'GOTO/1.0,2.0,3.0' >programs/bad.cls
again=$(sbatch "${small[@]}" --array="$bad" --export=ALL,JOBS="$work/shop/jobs.yaml",SHARDS=3 "$here/batch.sbatch")
soon ended "$again"
grep -q 'done before' "clsmith-$again-$bad.log" || failed "nothing was skipped"
clsmith merge done/results-*-of-3.jsonl --output done/results.jsonl --quiet || failed "not all is well"
echo "Slurm $(slurmctld -V | cut -d' ' -f2): three shards, merged, are one run; one repaired, and only that done again"
