#!/usr/bin/env bash
# Runs clang-tidy on the sources that changed since a commit, with the compile commands of a build folder.
#
#   check-tidy.sh BUILD [BASE]    BASE is ATRIA_CI_BASE, or else the commit before
#
# Of very many it takes those with the most changed lines, and names the others.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$1
base=${2:-${ATRIA_CI_BASE:-HEAD~1}}
most=24 # files, some minutes of two cores

if ! git rev-parse -q --verify "$base^{commit}" >/dev/null; then
  echo "check-tidy: there is no commit $base to compare with; nothing is looked at"
  exit 0
fi
mapfile -t changed < <(git diff --numstat -M --diff-filter=AMR "$base" -- 'Filters/*.cxx' 'IO/*.cxx' 'Examples/*.cxx' |
  awk -F '\t' '$1 > 0 { path = $3; sub(/\{.* => /, "", path); sub(/\}/, "", path); sub(/.* => /, "", path); print $1 "\t" path }' |
  sort -rn | cut -f 2)
if [ "${#changed[@]}" -gt "$most" ]; then
  printf 'check-tidy: not looked at: %s\n' "${changed[@]:most}"
fi
printf '%s\n' "${changed[@]:0:most}" | sed '/^$/d' | xargs -r -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet --warnings-as-errors='*'
