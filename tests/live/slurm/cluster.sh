# shellcheck shell=bash # sourced
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# A Slurm cluster on this computer: munged, slurmctld and up to two slurmd with a configuration of their own in a folder,
# on the loopback of a private network. To be sourced within that network.

# Slurm resolves addresses with AI_ADDRCONFIG, for which 127.0.0.1 alone is no address.
address=10.77.77.1

# start_cluster FOLDER: exits with 77 (skipped) if the daemons do not run here.
start_cluster() {
  cluster=$1
  mkdir -p "$cluster"/{munge,state,log}
  chmod 755 "$cluster"
  chmod 700 "$cluster/munge"
  for program in munged slurmctld slurmd sbatch squeue scancel; do
    command -v "$program" >/dev/null || PATH=$PATH:/usr/sbin command -v "$program" >/dev/null ||
      { echo "skipped: no $program (apt install slurm-wlm munge)" >&2; exit 77; }
  done
  PATH=$PATH:/usr/sbin
  dd if=/dev/urandom of="$cluster/munge/key" bs=1 count=128 status=none
  chmod 400 "$cluster/munge/key"
  munged --foreground --force --key-file="$cluster/munge/key" --socket="$cluster/munge/socket" \
    --pid-file="$cluster/munge/pid" --log-file="$cluster/log/munged.log" --seed-file="$cluster/munge/seed" \
    --num-threads=2 >"$cluster/log/munged.out" 2>&1 &
  munged_pid=$!
  until_true 10 test -S "$cluster/munge/socket" ||
    { cat "$cluster"/log/munged.*; echo "skipped: munged does not run" >&2; exit 77; }
  ip link set lo up && { ip address add "$address/32" dev lo || true; }
  write_configuration
  export SLURM_CONF=$cluster/slurm.conf
  start_controller
  for node in "${nodes[@]}"; do start_node "$node"; done
  until_true 30 controller_has_ended_or all_nodes_idle
  { controller_runs && all_nodes_idle && runs_jobs; } ||
    { tail -n 5 "$cluster"/log/slurm*; echo "skipped: Slurm does not run a job here" >&2; exit 77; }
}

# As in a user namespace without root, where slurmctld cannot set its groups.
controller_has_ended_or() { ! controller_runs || "$@"; }
controller_runs() { kill -0 "$controller_pid" 2>/dev/null; }

runs_jobs() {
  printf '#!/bin/sh\ntouch %s/ran\n' "$cluster" >"$cluster/job.sh"
  sbatch --parsable --mem=100M --output=/dev/null "$cluster/job.sh" >/dev/null && until_true 30 test -e "$cluster/ran"
}

write_configuration() {
  local user
  user=$(id -un)
  nodes=(n1)
  multiple_nodes_allowed && nodes=(n1 n2)
  cat >"$cluster/slurm.conf" <<END
ClusterName=adit
SlurmctldHost=$(hostname)($address)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket
CredType=cred/munge
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool.%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.%n.pid
SlurmctldPort=16817
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_min_interval=10000,batch_sched_delay=1,bf_interval=5
SlurmdTimeout=10
MinJobAge=300
ReturnToService=2
JobRequeue=1
$(for i in "${!nodes[@]}"; do
    echo "NodeName=${nodes[i]} NodeHostname=$(hostname) NodeAddr=$address Port=$((17001 + i)) CPUs=2 RealMemory=4000"
  done)
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
END
}

# Only a slurmd built for it takes the name of its node from the command line.
multiple_nodes_allowed() { ! slurmd -N n1 -C 2>&1 | grep -q 'invalid option'; }

start_controller() {
  slurmctld -D >>"$cluster/log/slurmctld.out" 2>&1 &
  controller_pid=$!
}

# start_node NAME
start_node() {
  slurmd -D -N "$1" >>"$cluster/log/slurmd.$1.out" 2>&1 &
  eval "node_pid_$1=$!"
}

# node_pid NAME: of its slurmd.
node_pid() { eval "echo \$node_pid_$1"; }

all_nodes_idle() { [[ $(sinfo -h -N -t idle -o %N 2>/dev/null | sort -u | wc -l) == "${#nodes[@]}" ]]; }

# As an administrator does: a controller that was killed has lost its last seconds. It starts tasks twice, and drains the
# nodes on which it finds those; and it takes tasks that ended meanwhile for running, until the nodes register again, and
# only if they started more than 20 s before (BatchStartTimeout and MessageTimeout).
reconcile_nodes() {
  local node
  if ((SECONDS >= ${next_registration_s:-0})); then
    next_registration_s=$((SECONDS + 10))
    scontrol reconfigure 2>/dev/null || true
  fi
  for node in $(sinfo -h -N -t drain -o %N 2>/dev/null | sort -u); do
    scontrol update NodeName="$node" State=RESUME 2>/dev/null || true
  done
}

stop_cluster() {
  local pids=("${controller_pid:-}" "${munged_pid:-}") pid node
  for node in "${nodes[@]}"; do pids+=("$(node_pid "$node")"); done
  for pid in "${pids[@]}"; do [[ -z $pid ]] || kill -KILL "$pid" 2>/dev/null || true; done
}

# until_true SECONDS COMMAND..: polls.
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < end)) || return 1
    sleep 0.1
  done
}
