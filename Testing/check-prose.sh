#!/usr/bin/env bash
# Reports how the comments read: sentences that start without their subject, and headers that do not say what they are
# for. Folders can be given; the whole library is the default.
#
#   check-prose.sh [--list] [FOLDER...]
#
# --list names each sentence and header. The exit status is 0 unless a folder does not exist.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

list=0
if [ "${1:-}" = --list ]; then
  list=1
  shift
fi
[ $# -gt 0 ] || set -- Filters IO ParaViewPlugin Examples

# A comment is all lines of one block, or what follows code on a line. A sentence ends with a period and a blank.
find "$@" \( -name '*.h' -o -name '*.cxx' \) -print0 | sort -z | xargs -0 awk -v list="$list" '
  function finish(   words, count, i, sentences, text) {
    gsub(/`[^`]*`/, "it", comment)
    count = split(comment, sentences, /[.?!] +/)
    for (i = 1; i <= count; ++i) {
      text = sentences[i]
      gsub(/^[[:space:]]+|[[:space:]]+$/, "", text)
      if (text == "" || text ~ /^(SPDX|NOLINT|clang-format|\\|<)/) continue
      ++all
      if (text ~ /^([Oo]f|[Bb]y|[Ww]hat|[Ww]hether|[Ww]here|[Tt]hose)[ ,]/) {
        ++poor
        if (list) print file ":" line ": " text
      }
    }
    comment = ""
  }
  FNR == 1 { finish(); file = FILENAME; isHeader = FILENAME ~ /\.h$/; headers += isHeader; opened = 0 }
  FNR == 2 && isHeader && !/^\/\/\/ / {
    ++silent
    if (list) print file ":2: the header does not say what it is for"
  }
  /SPDX-License-Identifier/ { next }
  /^[[:space:]]*\/\/+/ {
    if (comment == "") line = FNR
    text = $0
    sub(/^[[:space:]]*\/\/+[!<]?/, "", text)
    if (text ~ /^[[:space:]]*(\\|-|$)/) finish()
    comment = comment " " text
    next
  }
  {
    finish()
    if (match($0, /[^:"]\/\/+<? /)) { line = FNR; comment = substr($0, RSTART + RLENGTH); finish() }
  }
  END {
    finish()
    printf "%d of %d sentences in comments (%.1f %%) start without their subject; ", poor, all, 100 * poor / all
    printf "%d of %d headers do not say what they are for\n", silent, headers
  }'
