#!/bin/sh
# Sets up Slurm on this machine, publishes generated books by the array of examples/cluster,
# merges the shards, and compares the site with that of one run. Debian's slurm-wlm and munge
# are installed if they are missing. Everything runs in a folder of its own, on ports of its
# own, and is ended; nothing of the system's own Slurm is touched.
#   TURNLEAF_BOOKS=N   number of books (6)
set -eu
cd "$(dirname "$0")/../.."
root="$PWD"
for program in slurmctld slurmd munged sbatch; do
  PATH="$PATH:/usr/sbin" command -v $program >/dev/null || missing=yes
done
if [ "${missing:-}" = yes ]; then
  as_root=""
  [ "$(id -u)" = 0 ] || as_root=sudo
  $as_root apt-get update -q >/dev/null
  # The packages start services of their own where there is an init system.
  $as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -yq --no-install-recommends slurm-wlm munge >/dev/null
fi
[ "$(id -u)" = 0 ] || { echo "Slurm's daemons need root here: run it by sudo." >&2; exit 1; }
PATH="$PATH:/usr/sbin"

folder=$(mktemp -d)
chmod 755 "$folder"
pids=""
end() {
  status=$?
  for pid in $pids; do kill "$pid" 2>/dev/null || true; done
  for pid in $pids; do wait "$pid" 2>/dev/null || true; done
  [ $status = 0 ] || tail -n 20 "$folder"/*.log "$folder"/job-* 2>/dev/null >&2 || true
  rm -rf "$folder"
}
trap end EXIT
trap 'exit 1' INT TERM

mkdir "$folder/state" "$folder/spool" "$folder/bin"
dd if=/dev/urandom of="$folder/munge.key" bs=1 count=128 status=none
chmod 400 "$folder/munge.key"
munged --foreground --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
  --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" >/dev/null 2>&1 &
pids="$pids $!"

cores=$(getconf _NPROCESSORS_ONLN)
memory=$(awk '/MemTotal/ { print int($2 / 1024) }' /proc/meminfo)
cat >"$folder/slurm.conf" <<CONF
ClusterName=turnleaf
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort=26817
SlurmdPort=26818
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MailProg=/bin/true
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$cores RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$folder/slurm.conf"
slurmctld -D -c -L "$folder/slurmctld.log" >/dev/null 2>&1 &
pids="$pids $!"
slurmd -D -L "$folder/slurmd.log" >/dev/null 2>&1 &
pids="$pids $!"
for attempt in $(seq 60); do
  if sinfo --noheader --format=%T 2>/dev/null | grep -q '^idle'; then break; fi
  [ "$attempt" != 60 ] || { echo "Slurm did not start." >&2; exit 1; }
  sleep 1
done
sinfo

printf '#!/bin/sh\nexec node "%s/packages/cli/dist/main.js" "$@"\n' "$root" >"$folder/bin/turnleaf"
chmod 755 "$folder/bin/turnleaf"
PATH="$folder/bin:$PATH"
CHROMIUM="${CHROMIUM:-$(node -e 'import("./scripts/chromium.mjs").then((m) => console.log(m.findChromium()))')}"
export PATH CHROMIUM
node tests/cluster/make_books.mjs "$folder/books" "${TURNLEAF_BOOKS:-6}"
cp examples/cluster/slurm_array.sh examples/cluster/slurm_merge.sh "$folder"
cd "$folder"
export CATALOGUE="$folder/books/catalogue.json" SHARDS="$folder/shards" SITE="$folder/site"
mkdir "$SHARDS"
array=$(sbatch --parsable --array=1-2 --cpus-per-task=1 --mem=0 --output=job-%A-%a.txt slurm_array.sh)
merge=$(sbatch --parsable --dependency=afterok:"$array" --kill-on-invalid-dep=yes --mem=0 \
  --output=job-%j.txt slurm_merge.sh)
echo "Array job $array, merge job $merge"
while [ -n "$(squeue --noheader --jobs="$array,$merge" 2>/dev/null)" ]; do sleep 1; done
cat job-*.txt
turnleaf publish --catalogue "$CATALOGUE" --out "$folder/one" --workers 1
diff -r "$SITE" "$folder/one"
echo "The site of $(find "$SITE/books" -name record.json | wc -l) books by an array of 2 tasks is that of one run, byte for byte."
