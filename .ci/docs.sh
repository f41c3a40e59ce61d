#!/usr/bin/env bash
# The documentation as a site in build/docs/site: pages, manual of keys, verification register,
# links checked. The register's figures take two minutes and are computed once for a build of the
# program; with --quick the register has those of the last time, or the list of its cases.
source "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

blocklift=build/release/blocklift
[ -x "$blocklift" ] || {
  echo "The manual and the register come from $blocklift, which is not built: run ./first-lift.sh first." >&2
  exit 1
}
figures=build/docs/verification.json
mkdir -p build/docs
if [ "${1:-}" != --quick ] && [ ! "$figures" -nt "$blocklift" ]; then
  say "Computing the figures of the register"
  # A figure that is off is marked in the register, and is no fault of the pages: the tests complain
  # of it.
  "$blocklift" verify --json >"$figures.new" || [ -s "$figures.new" ]
  mv "$figures.new" "$figures"
fi
say "Building the pages"
python3 docs/site/build.py --blocklift "$blocklift" --output build/docs --figures "$figures"
