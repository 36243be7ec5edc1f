#!/bin/sh
#SBATCH --job-name=publish-merge
#SBATCH --mem=8G
# After the array:  sbatch --dependency=afterany:JOB --export=ALL,SHARDS=/shared/shards,SITE=/shared/site slurm_merge.sh
set -eu
turnleaf publish --merge "$SHARDS"/* --out "$SITE"
