#!/usr/bin/env bash
# apps/cluster/benchmark.sbatch on a Slurm of this machine with two nodes that the test starts and ends:
# slurm_test.sh MSC_VO SOURCE_DIR. Exit status 77: skipped.
command=$1
source_dir=$2
skip() {
  echo "skipped: $1"
  exit 77
}
for program in slurmctld slurmd sbatch squeue; do
  type -P "$program" > /dev/null || [[ -x /usr/sbin/$program ]] || skip "$program is not installed"
done
[[ $EUID -eq 0 ]] || skip "slurmd needs root"
PATH=$PATH:/usr/sbin
source "$source_dir/tests/cluster/prepare.sh"
pids=()
clean_up() {
  for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null || true; done
  wait
  rm -rf "$folder"
}
trap clean_up EXIT

host=$(hostname --short)
port=$((20000 + $$ % 20000))
mkdir state
cat > slurm.conf <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmUser=root
AuthType=auth/none
CredType=cred/none
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
StateSaveLocation=$folder/state
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmdSpoolDir=$folder/spool-%n
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2
PartitionName=all Nodes=n1,n2 Default=YES State=UP
CONF
export SLURM_CONF=$folder/slurm.conf
slurmctld -D -i > /dev/null 2>&1 &
pids+=($!)
for node in n1 n2; do
  mkdir "spool-$node"
  slurmd -D -N "$node" > /dev/null 2>&1 &
  pids+=($!)
done
for ((i = 0; i < 50; ++i)); do
  [[ $(sinfo --noheader --format=%T 2> /dev/null) == idle ]] && break
  sleep 0.2
done
if [[ $(sinfo --noheader --format=%T 2> /dev/null) != idle ]]; then
  tail -n 5 "$folder"/*.log || true
  skip "Slurm does not start on this machine"
fi

MSC_VO=$command sbatch --wait --quiet --chdir="$folder" --output="$folder/task-%a.log" --array=1-2 \
  "$source_dir/apps/cluster/benchmark.sbatch" sequences.txt out --modes pl-vo ||
  { cat "$folder"/task-*.log; tail -n 20 "$folder"/slurm*.log; exit 1; }
check_merged
