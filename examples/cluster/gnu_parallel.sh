#!/bin/sh
# Eight shards on the machines of a file, one line a machine, over ssh and a folder that
# all of them see:  CATALOGUE=books.json SHARDS=/shared/shards SITE=/shared/site gnu_parallel.sh machines.txt
set -eu
parallel --sshloginfile "$1" --jobs 1 --workdir "$PWD" --retries 3 \
  turnleaf publish --catalogue "$CATALOGUE" --out "$SHARDS/{}" --shard '{}/8' ::: $(seq 8)
turnleaf publish --merge "$SHARDS"/* --out "$SITE"
