#!/usr/bin/env bash
# Runs a command beside a Slurm cluster of this machine alone, which it starts and stops.
# Usage (as root): slurm_cluster.sh COMMAND...
set -euo pipefail
work=$(mktemp -d /tmp/holdfast-slurm.XXXXXX)
host=$(hostname -s)
# Daemons write their state as they end: the folder stands until they have.
stop() {
  local name
  for name in slurmctld slurmd ${munged:+munged}; do
    [ -e "$work/$name.pid" ] || continue
    pkill -F "$work/$name.pid" 2>/dev/null || continue
    for _ in $(seq 100); do
      pgrep -F "$work/$name.pid" >/dev/null 2>&1 || break
      sleep 0.1
    done
  done
  rm -rf "$work"
}
trap stop EXIT

# A key and a socket of our own.
mkdir -p "$work/munge" "$work/state" "$work/spool"
chmod 755 "$work" "$work/munge"
dd if=/dev/urandom of="$work/munge.key" bs=1 count=1024 status=none
chmod 400 "$work/munge.key"
munged --force --key-file="$work/munge.key" --socket="$work/munge/socket" --pid-file="$work/munged.pid" \
  --log-file="$work/munged.log" --seed-file="$work/munged.seed"
munged=yes
cat >"$work/slurm.conf" <<EOF
ClusterName=holdfast
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CryptoType=crypto/munge
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
EOF
export SLURM_CONF=$work/slurm.conf
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for _ in $(seq 60); do
  sinfo -h -o %t 2>/dev/null | grep -qx idle && break
  sleep 0.5
done
sinfo -h -o %t | grep -qx idle || { tail -n 20 "$work"/slurm*.log; exit 1; }

"$@"
