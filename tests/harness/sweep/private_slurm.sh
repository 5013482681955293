#!/usr/bin/env bash
# A Slurm of one's own with one node, on loopback, everything in one folder:
#   private_slurm.sh start DIR    then SLURM_CONF=DIR/slurm.conf sbatch ..
#   private_slurm.sh stop DIR
#   private_slurm.sh watch DIR PID    stops it when the process PID has ended, however that came
# It needs munged, slurmctld and slurmd, and to be root. It is there when `start` has returned.
set -euo pipefail
PATH=$PATH:/usr/sbin

die() {
  printf 'private_slurm: %s\n' "$*" >&2
  exit 1
}

# A port that nothing listens to.
free_port() {
  local port
  for _ in {1..100}; do
    port=$((20000 + RANDOM % 12000)) # below those that the kernel hands out
    (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port" && return; }
  done
  die "no free port"
}

# wait_for SECONDS COMMAND...: until it succeeds.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < end)) || return 1
    sleep 0.1
  done
}

write_configuration() {
  local host
  host=$(hostname -s)
  cat >slurm.conf <<CONF
ClusterName=private
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$PWD/munge.socket
CredType=cred/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
SlurmctldLogFile=$PWD/slurmctld.log
SlurmdLogFile=$PWD/slurmd.log
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0,bf_interval=1
MpiDefault=none
ReturnToService=2
MinJobAge=300
NodeName=node NodeHostname=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
CONF
}

start() {
  mkdir -p state spool
  umask 077
  head -c 1024 /dev/urandom >munge.key
  write_configuration
  munged --force --key-file="$PWD/munge.key" --socket="$PWD/munge.socket" --pid-file="$PWD/munged.pid" \
    --log-file="$PWD/munged.log" --seed-file="$PWD/munge.seed" || die "munged does not start"
  export SLURM_CONF=$PWD/slurm.conf
  slurmctld -i || die "slurmctld does not start: $(tail -n 3 slurmctld.log)"
  slurmd -N node || die "slurmd does not start: $(tail -n 3 slurmd.log)"
  wait_for 30 node_is_idle || die "the node does not come up: $(tail -n 3 slurmctld.log slurmd.log)"
}

node_is_idle() { [[ $(sinfo -h -o %T) == idle ]]; }

ended() { ! kill -0 "$1"; }

stop() {
  local name pid
  export SLURM_CONF=$PWD/slurm.conf
  scancel --quiet --user="$(id -un)" 2>/dev/null || true
  for name in slurmd slurmctld munged; do
    pid=$(cat "$name.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || continue
    wait_for 1 ended "$pid" || kill -KILL "$pid" # slurmctld takes its time, and nothing of it is kept
  done
}

watch() {
  until ended "$1"; do sleep 1; done
  [[ ! -e munged.pid ]] || stop
}

[[ ($# == 2 && ($1 == start || $1 == stop)) || ($# == 3 && $1 == watch) ]] ||
  die "usage: private_slurm.sh start|stop DIR, or watch DIR PID"
cd "$2"
"$1" "${@:3}"
