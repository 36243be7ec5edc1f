#!/bin/sh
#SBATCH --job-name=publish
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --mem=4G
# One shard a task:  sbatch --export=ALL,CATALOGUE=books.json,SHARDS=/shared/shards slurm_array.sh
# SHARDS is a folder that all machines see. A task that was killed goes on where it was.
set -eu
turnleaf publish --catalogue "$CATALOGUE" --out "$SHARDS/$SLURM_ARRAY_TASK_ID" \
  --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --workers "$SLURM_CPUS_PER_TASK"
