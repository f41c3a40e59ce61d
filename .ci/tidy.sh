#!/usr/bin/env bash
# clang-tidy over our own sources with the settings of .clang-tidy, a file a core at a time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
git ls-files 'dynamics/*.cc' 'structure/*.cc' 'pipeline/*.cc' |
  xargs -P "$(nproc)" -n 1 clang-tidy -p build/release --quiet --extra-arg=-Wno-unknown-warning-option
