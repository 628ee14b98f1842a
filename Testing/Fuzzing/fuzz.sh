#!/usr/bin/env bash
# Fuzzes the VRML reader under the address and undefined-behaviour sanitizers, at low priority on one core.
#
#   fuzz.sh [SECONDS]      how long to search for new findings (default: 600)
#   fuzz.sh FILE...        runs these files once, such as a finding
#
# Seeds are the models of the repository and, where there are any, those of ATRIA_CORPUS; what a run learns is kept in
# build/fuzz/corpus for the next. A finding is minimised into build/fuzz/findings, and the script fails. It belongs,
# once mended, into Testing/Data/VRML/damaged, whose files TestVRMLDamage reads.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
[ -e build/fuzz/CMakeCache.txt ] || cmake --preset fuzz
cmake --build --preset fuzz

fuzzer=build/fuzz/bin/vrml_fuzzer
work=build/fuzz
export UBSAN_OPTIONS=print_stacktrace=1
export ASAN_OPTIONS=detect_stack_use_after_return=1

if [ $# -gt 0 ] && [ -e "$1" ]; then
  exec "$fuzzer" "$@"
fi
seconds=${1:-600}

# Models above this size are slow to run and taught it nothing that smaller ones did not.
longest=65536
rm -rf "$work/seeds"
mkdir -p "$work/seeds" "$work/corpus" "$work/findings"
models=("$root/Testing/Data" "$root/Examples/Data" "${ATRIA_CORPUS:-$root/../shared/corpus}")
number=0
while IFS= read -r -d '' model; do
  number=$((number + 1))
  cp "$model" "$work/seeds/$number"
  # Also unpacked: little survives a change to compressed bytes.
  if gzip -t "$model" 2>/dev/null; then gzip -dc "$model" >"$work/seeds/${number}_unpacked"; fi
done < <(find "${models[@]}" -name '*.wr[lz]*' -print0 2>/dev/null | sort -z)
find "$work/seeds" -size "+$((longest / 1024))k" -delete
echo "$(find "$work/seeds" -type f | wc -l) seeds, $(find "$work/corpus" -type f | wc -l) inputs of runs before"

status=0
nice -n 19 "$fuzzer" -max_total_time="$seconds" -max_len="$longest" -timeout=300 -rss_limit_mb=4096 -malloc_limit_mb=2048 \
  -dict=Testing/Fuzzing/vrml.dict -artifact_prefix="$work/findings/" -print_final_stats=1 \
  "$work/corpus" "$work/seeds" 2>&1 | tee "$work/fuzz.log" | grep -vE '^#[0-9]+\s+(NEW|REDUCE|pulse)' || status=$?
status=${PIPESTATUS[0]}
if [ "$status" -ne 0 ]; then
  for finding in "$work"/findings/{crash,oom,timeout}-*; do
    [ -e "$finding" ] || continue
    case $finding in *.minimal) continue ;; esac
    nice -n 19 "$fuzzer" -minimize_crash=1 -exact_artifact_path="$finding.minimal" -max_total_time=120 -timeout=20 \
      -rss_limit_mb=4096 "$finding" >/dev/null 2>&1 || true
  done
  echo "findings in $work/findings; see $work/fuzz.log" >&2
fi
exit "$status"
