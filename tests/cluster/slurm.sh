#!/usr/bin/env bash
# A Slurm of one controller and two nodes on this machine makes one texture by a task on each, and
# does an array of shards: one node and its task are killed in the middle, Slurm starts the task again
# on the other node, and in the end all results are there, the same bytes as one process makes. Needs
# root, slurm-wlm, munge and openimageio-tools.
#   tests/cluster/slurm.sh [build/gramloom]
set -euo pipefail
root=$(dirname "$(readlink -f "$0")")/../..
export GRAMLOOM
GRAMLOOM=$(readlink -f "${1:-build/gramloom}")
for command in munged slurmctld slurmd sbatch srun idiff; do
  command -v $command >/dev/null || { echo "slurm.sh: $command is not installed (Debian: slurm-wlm munge openimageio-tools)" >&2; exit 77; }
done

folder=$(mktemp -d)
export SLURM_CONF=$folder/slurm.conf
started=()
clean_up() {
  kill -9 "${started[@]}" 2>/dev/null || true
  pkill -9 -f "slurmstepd.*$folder" 2>/dev/null || true
  [ -n "${KEEP:-}" ] || rm -rf "$folder"
}
trap clean_up EXIT
fail() { echo "slurm.sh: $*" >&2; tail -n 5 "$folder"/*.log >&2; KEEP=1; exit 1; }

start() {  # a daemon in the foreground, its messages in a log
  local log=$1
  shift
  "$@" >>"$folder/$log.log" 2>&1 &
  started+=($!)
  disown
}

wait_until() {  # a command succeeds
  local what=$1
  shift
  for _ in $(seq 300); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.2
  done
  fail "waited in vain: $what"
}

mkdir -p "$folder"/{state,munge}
chmod 700 "$folder/munge"
head -c 1024 /dev/urandom >"$folder/munge/key"
chmod 400 "$folder/munge/key"
cat >"$SLURM_CONF" <<CONF
ClusterName=gramloom
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=17000
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket,cred_expire=5
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/linear
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool-%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/%n.pid
SlurmdTimeout=5
ReturnToService=2
JobRequeue=1
NodeName=n[1-2] NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[17001-17002] CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
CONF

start munged munged --foreground --force --socket="$folder/munge/socket" --key-file="$folder/munge/key" \
  --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" --log-file="$folder/munge/log"
wait_until "munge" test -S "$folder/munge/socket"
start slurmctld slurmctld -D
start n1 slurmd -D -N n1
node=${started[-1]}
start n2 slurmd -D -N n2
wait_until "both nodes are idle" sh -c '[ "$(sinfo -h -t idle -N -o %N | sort -u | wc -l)" = 2 ]'

# One texture by a task on each node.
cat >"$folder/giant.toml" <<CONF
size = [96, 256]
tile = "both"
[[exemplar]]
name = "pebbles"
image = "$root/data/pebbles.png"
[[method]]
name = "gram"
kind = "neural"
preset = "gatys"
network = "multiscale_1"
optimizer = ["adam"]
positions = 4096
iterations = [3]
CONF
"$GRAMLOOM" run "$folder/giant.toml" --output "$folder/giant" --quiet --threads 1
(cd "$folder" && timeout 120 srun -N 2 -n 2 "$GRAMLOOM" run giant.toml --output by-srun --one-job --quiet --threads 1) ||
  fail "srun failed"
idiff -q -fail 0.005 "$folder"/{giant,by-srun}/pebbles/gram/seed1.png || fail "the texture of two tasks is another one"
echo "a texture by two tasks of srun is that of one process"

cat >"$folder/array.toml" <<CONF
size = [160, 160]
seeds = [1, 2, 3]
$(for name in granite pebbles; do printf '[[exemplar]]\nname = "%s"\nimage = "%s/data/%s.png"\n' $name "$root" $name; done)
$(for kind in quilting pixel patchmatch pyramid; do printf '[[method]]\nname = "%s"\nkind = "%s"\n' $kind $kind; done)
[[method]]
name = "marble"
kind = "procedural"
texture = "marble"
CONF
"$GRAMLOOM" run "$folder/array.toml" --output "$folder/one" --quiet

job=$(cd "$folder" && sbatch --parsable --array=1-4 --output="$folder/task-%a.log" \
  "$root/configs/cluster/array.sbatch" "$folder/array.toml" --output "$folder/all")
on_first_node() { squeue -h -t running -w n1 -o %i | grep .; }
wait_until "a task runs on the first node" on_first_node
wait_until "a job is done" sh -c "find '$folder/all' -name 'seed*.json' | grep ."
echo "killing n1 with its task $(on_first_node)"
step=$(pgrep -f "slurmstepd: \[$(squeue -h -t running -w n1 -o %A)\.")
kill -9 "$node"
pkill -9 -P "$step" || true
kill -9 "$step"
for _ in $(seq 1500); do
  squeue -h -j "$job" -o %i | grep -q . || break
  sleep 0.2
done
squeue -h -j "$job" -o '%i %T %R' | grep . && fail "the array does not end"
"$GRAMLOOM" report "$folder/all" >/dev/null

grep -q waiting "$folder/all/scores.csv" && fail "jobs were not done"
(cd "$folder/one" && find . -name '*.png') | while read -r file; do
  cmp "$folder/one/$file" "$folder/all/$file" || fail "$file differs"
done
diff <(cut -d, -f1-5,8- "$folder/one/scores.csv") <(cut -d, -f1-5,8- "$folder/all/scores.csv") || fail "other scores"
echo "all results are there and the same as one process makes"
