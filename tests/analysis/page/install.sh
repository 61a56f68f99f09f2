#!/usr/bin/env bash
# Installs what package.json asks for, beside it; without a network if it is there already.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
wanted=$(node -p 'require("./package.json").dependencies["playwright-core"]')
have=$(node -p 'require("playwright-core/package.json").version' 2>/dev/null || true)
[ "$have" = "$wanted" ] && exit 0
npm install --no-package-lock --no-audit --no-fund
