#!/bin/sh
# End the Slurm that start_slurm.sh started in a directory:  stop_slurm.sh DIRECTORY
place=${1:?directory of its files}
SLURM_CONF=$place/slurm.conf scontrol shutdown
sleep 1
if [ -e "$place/own_munge" ]; then
   kill "$(cat /run/munge/munged.pid)"
   rm -f "$place/own_munge"
fi
