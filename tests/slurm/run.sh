#!/bin/sh
# Start a Slurm on this host, try an array of it, end it:  run.sh GUDGEON DIRECTORY
set -eu
here=$(cd "$(dirname "$0")" && pwd)
for tool in slurmctld slurmd sbatch munge; do
   command -v "$tool" > /dev/null || { echo "slurm-test needs $tool: apt-get install slurmctld slurmd slurm-client munge" >&2; exit 1; }
done
eval "$("$here/start_slurm.sh" "$2/slurm")"
export SLURM_CONF
code=0
"${PYTHON:-python3}" -B "$here/array_sweep.py" "$1" "$2/work" || code=$?
"$here/stop_slurm.sh" "$2/slurm"
exit "$code"
