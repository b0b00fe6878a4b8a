#!/bin/bash
# A sweep as a Slurm job array: one task for each part of its runs. Copy this file, change the lines with #SBATCH and DECK, and
#
#     scripts/slurm/submit_sweep DECK [N]     submits an array of N tasks (20) and the job that merges them
#
# A task that reaches its time limit, is killed or loses its node is queued again and makes only what is missing: every run that
# has ended is in the journal of its part. docs/reference/batch.md tells more.
#SBATCH --job-name=gudgeon
#SBATCH --time=04:00:00
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@120        # two minutes before the time limit, to this script

DECK=${DECK:?the deck to sweep}
OUT=${OUT:?directory of the results}
GUDGEON=${GUDGEON:-gudgeon}

part=$SLURM_ARRAY_TASK_ID
parts=$SLURM_ARRAY_TASK_COUNT
this=${SLURM_ARRAY_JOB_ID}_$part

end_sweep() {
   trap '' TERM
   kill -TERM "$sweep" 2> /dev/null
   wait "$sweep"
}

queue_again() {     # before the time limit
   echo "part $part of $parts: out of time, queued again"
   end_sweep
   scontrol requeue "$this"
   sleep 60          # Slurm ends this script
   exit 0
}

trap queue_again USR1
trap 'end_sweep; exit 143' TERM

# in the background, since bash answers signals only between commands; `wait` ends at a signal
"$GUDGEON" sweep "$DECK" --out "$OUT" --shard "$part/$parts" --jobs "${SLURM_CPUS_PER_TASK:-1}" --quiet &
sweep=$!
wait "$sweep"
code=$?
[ "$code" -eq 8 ] && exit 0          # runs that failed are recorded; merge tells of them
if [ "$code" -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 10 ]; then
   echo "part $part of $parts: the sweep ended by signal $((code - 128)), queued again"
   scontrol requeue "$this"
   sleep 60
fi
exit "$code"
