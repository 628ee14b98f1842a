#!/usr/bin/env bash
# Fuzzes the readers under the address and undefined-behavior sanitizers, at low priority on one core.
#
#   fuzz.sh [SECONDS] [vrml|model]   how long to search for new findings (default: 600), the readers of VRML and of the
#                                    other formats after each other, or one of them
#   fuzz.sh vrml|model FILE...       runs these files once, such as a finding
#
# Seeds are the models of the repository and, where there are any, those of ATRIA_CORPUS; for the other formats small
# ones that model_seeds writes. What a run learns is kept in build/fuzz/READER/corpus for the next. A finding is
# minimized into build/fuzz/READER/findings, and the script fails. It belongs, once mended, into
# Testing/Data/VRML/damaged, whose files TestVRMLDamage and TestVRMLMutations read, or Testing/Data/Models/damaged, whose
# files TestModelDamage reads.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
[ -e build/fuzz/CMakeCache.txt ] || cmake --preset fuzz
cmake --build --preset fuzz

export UBSAN_OPTIONS=print_stacktrace=1
export ASAN_OPTIONS=detect_stack_use_after_return=1
# Larger models are slow to run and taught the fuzzers nothing that smaller ones did not.
longest=16384
limits=(-timeout=300 -rss_limit_mb=4096 -malloc_limit_mb=2048)

if [[ ${1:-} =~ ^(vrml|model)$ ]] && [ $# -gt 1 ]; then
  fuzzer=build/fuzz/bin/$1_fuzzer
  shift
  exec "$fuzzer" "${limits[@]}" "$@"
fi

vrml_seeds() {
  local models=("$root/Testing/Data/VRML" "$root/Examples/Data" "${ATRIA_CORPUS:-$root/../shared/corpus}")
  local number=0 model
  while IFS= read -r -d '' model; do
    number=$((number + 1))
    cp "$model" "$1/$number"
    # Also unpacked: little survives a change to compressed bytes.
    if gzip -t "$model" 2>/dev/null; then gzip -dc "$model" >"$1/${number}_unpacked"; fi
  done < <(find "${models[@]}" -name '*.wr[lz]*' -print0 2>/dev/null | sort -z)
}

model_seeds() {
  build/fuzz/bin/model_seeds "$1"
  find "$root/Testing/Data/Models" -type f -exec cp -t "$1" {} + 2>/dev/null || true
}

# search READER SECONDS
search() {
  local work=build/fuzz/$1 fuzzer=build/fuzz/bin/$1_fuzzer status=0 finding
  rm -rf "$work/seeds"
  mkdir -p "$work/seeds" "$work/corpus" "$work/findings"
  "$1_seeds" "$work/seeds"
  find "$work/seeds" "$work/corpus" -type f -size "+$((longest / 1024))k" -delete
  echo "$1: $(find "$work/seeds" -type f | wc -l) seeds, $(find "$work/corpus" -type f | wc -l) inputs of runs before;" \
    "progress in $work/fuzz.log"
  nice -n 19 "$fuzzer" -max_total_time="$2" -max_len="$longest" "${limits[@]}" -dict="Testing/Fuzzing/$1.dict" \
    -artifact_prefix="$work/findings/" -print_final_stats=1 "$work/corpus" "$work/seeds" >"$work/fuzz.log" 2>&1 || status=$?
  grep -E '^#[0-9]+\s+(INITED|DONE)|^stat::|^SUMMARY|ERROR|Slowest|broke a promise' "$work/fuzz.log" || true
  [ "$status" -eq 0 ] && return
  for finding in "$work"/findings/{crash,oom,timeout}-*; do
    [ -e "$finding" ] || continue
    case $finding in *.minimal) continue ;; esac
    [ ! -e "$finding.minimal" ] || continue
    nice -n 19 "$fuzzer" -minimize_crash=1 -exact_artifact_path="$finding.minimal" -max_total_time=120 -timeout=20 \
      -rss_limit_mb=4096 "$finding" >/dev/null 2>&1 || true
  done
  echo "findings in $work/findings; see $work/fuzz.log" >&2
  return "$status"
}

seconds=${1:-600}
readers=(vrml model)
[ $# -lt 2 ] || readers=("$2")
failed=0
for reader in "${readers[@]}"; do
  search "$reader" $((seconds / ${#readers[@]})) || failed=1
done
exit "$failed"
