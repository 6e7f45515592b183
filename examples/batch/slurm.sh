#!/bin/bash
# A Slurm array: every task meshes its share of the files, each file in a process of its own.
#   sbatch --array=0-3 examples/batch/slurm.sh meshes parts/*.stl
# Run it again to do what is missing; then one command merges the results and prints the table:
#   holdfast batch parts/*.stl -o meshes --resume
#SBATCH --cpus-per-task=2
#SBATCH --time=01:00:00
output=$1
shift
# I/N of --shard comes from SLURM_ARRAY_TASK_ID and its like.
exec "${HOLDFAST:-holdfast}" batch "$@" -o "$output" --jobs "${SLURM_CPUS_PER_TASK:-1}" --time-limit 600 --resume
