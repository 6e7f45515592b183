#!/usr/bin/env bash
# Runs every fuzz target (tests/fuzz) for some seconds, one after the other or several at a time.
# Usage: scripts/fuzz.sh BUILD SECONDS JOBS
# New inputs are kept in BUILD/inputs/TARGET, so that the next run goes on from them; an input that fails is
# BUILD/found/TARGET-*, and belongs into tests/fuzz/corpus/TARGET once it is mended. Exit code 1 if any failed.
set -uo pipefail
cd "$(dirname "$0")/.."
build=$1 seconds=$2 jobs=$3
targets=(read_surface read_volume read_solver read_size_field mesh untangle check plane)

run() {
  local target=$1 build=$2 seconds=$3 corpus=tests/fuzz/corpus/$1
  mkdir -p "$build/inputs/$target" "$build/found"
  local log=$build/found/$target.log
  "$build/tests/fuzz/fuzz_$target" "$build/inputs/$target" "$corpus" -max_total_time="$seconds" -max_len=2048 \
    -timeout=60 -rss_limit_mb=3072 -artifact_prefix="$build/found/$target-" -print_final_stats=1 >"$log" 2>&1
  local status=$?
  local runs
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  if [ "$status" -eq 0 ] && [ "${runs:-0}" -gt 0 ]; then
    echo "fuzz $target: $runs inputs in $seconds s, none failed"
  else
    echo "fuzz $target: FAILED (exit $status), see $log"
    grep -E "ERROR|FAILED|runtime error|SUMMARY|Test unit written" "$log" | head -n 8
    return 1
  fi
}
export -f run
printf '%s\n' "${targets[@]}" | xargs -P "$jobs" -I{} bash -c 'run {} '"'$build' '$seconds'"
