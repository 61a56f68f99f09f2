#!/usr/bin/env bash
# Every header of shoal that an installed one includes is installed, too.
# Usage: headers.sh PREFIX
set -euo pipefail
cd "$1/include/shoal"
grep -rhoE '#include [<"]shoal/[^">]+' . | sed 's/.*shoal\///' | sort -u | while read -r header; do
  [ -f "$header" ] || { echo "an installed header includes $header, which is not installed" >&2; exit 1; }
done
