#!/bin/sh
# Start a Slurm of one host, as root, without systemd, cgroups or accounting:  start_slurm.sh DIRECTORY
# Debian packages: slurmctld slurmd slurm-client munge. Prints the setting of SLURM_CONF; stop_slurm.sh ends it.
set -eu
place=${1:?directory for its files}
host=$(hostname)
mkdir -p "$place/state" "$place/spool"
place=$(cd "$place" && pwd)
if ! munge -n > /dev/null 2>&1; then
   mkdir -p /run/munge
   chown munge:munge /run/munge
   chmod 755 /run/munge
   runuser -u munge -- /usr/sbin/munged
   touch "$place/own_munge"
fi
cat > "$place/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
KillWait=5
MpiDefault=none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) CoresPerSocket=$(nproc) State=UNKNOWN
PartitionName=main Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
SLURM_CONF=$place/slurm.conf
export SLURM_CONF
slurmctld -c -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
tries=0
until sinfo -h -o %T 2> /dev/null | grep -q idle; do
   tries=$((tries + 1))
   [ "$tries" -lt 30 ] || { echo "Slurm does not start: $place/slurmctld.log" >&2; exit 1; }
   sleep 1
done
echo "SLURM_CONF=$SLURM_CONF"
