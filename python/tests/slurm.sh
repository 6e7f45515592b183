#!/usr/bin/env bash
# An array of four on a Slurm cluster of this machine alone: everything is meshed, nothing twice.
# Usage (as root): slurm.sh HOLDFAST
set -euo pipefail
here=$(cd "$(dirname "$0")/../.." && pwd)
if [ -z "${SLURM_CONF:-}" ]; then
  exec "$here/python/tests/slurm_cluster.sh" "$0" "$@"
fi
holdfast=$(realpath "$1")
work=$(mktemp -d /tmp/holdfast-array.XXXXXX)
trap 'rm -rf "$work"' EXIT

mkdir "$work/parts"
for i in $(seq 10); do python3 "$here/examples/make_part.py" "$work/parts/part$i.stl" >/dev/null; done
export HOLDFAST=$holdfast
sbatch --wait --array=0-3 --cpus-per-task=1 --output="$work/%a.log" "$here/examples/batch/slurm.sh" "$work/meshes" \
  "$work"/parts/*.stl || { cat "$work"/*.log; exit 1; }
done_parts=$(cat "$work"/meshes/results.?-of-4.jsonl | grep -c '"status": "done"')
merged=$(grep -c '"status": "done"' "$work/meshes/results.jsonl")
volumes=$(find "$work/meshes" -name "*.vtu" ! -name "*_surface.vtu" | wc -l)
cat "$work"/?.log
echo "$done_parts parts done by the tasks, $merged in the merged results, $volumes volumes"
[ "$done_parts" -eq 10 ] && [ "$merged" -eq 10 ] && [ "$volumes" -eq 10 ]
