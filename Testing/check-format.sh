#!/usr/bin/env bash
# All C++ sources are laid out as .clang-format says. With --fix they are made so.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# Other versions lay out some lines differently.
formatter=$(command -v clang-format-14 || command -v clang-format)
case $("$formatter" --version) in
  *"version 14."*) ;;
  *)
    echo "clang-format 14 is needed; there is $("$formatter" --version)" >&2
    exit 2
    ;;
esac
options=(--dry-run --Werror)
if [ "${1:-}" = --fix ]; then options=(-i); fi
git ls-files -z '*.h' '*.cxx' | xargs -0 "$formatter" "${options[@]}"
