#!/bin/bash
# The parts of a sweep put together; submitted by submit_sweep to follow its array.
#SBATCH --job-name=gudgeon-merge
#SBATCH --time=01:00:00
#SBATCH --cpus-per-task=1

exec "${GUDGEON:-gudgeon}" merge "${OUT:?directory of the results}"
