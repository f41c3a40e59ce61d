#!/usr/bin/env bash
# Draws the motion of the paper's two test mechanisms over their references into this folder (needs gnuplot).
#   models/benchmarks/plots.sh [BLOCKLIFT]      the executable, build/release/blocklift if left out
set -euo pipefail
blocklift=$(realpath "${1:-$(dirname "$0")/../../build/release/blocklift}")
cd "$(dirname "$0")"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# draw NAME FIRST SECOND HEADING
draw() {
  "$blocklift" simulate "$1" --csv -o "$work/$1" >/dev/null
  gnuplot -e "ours='$work/$1/results.csv'; reference='$1/reference.csv'; picture='$1/motion.svg'" \
          -e "first='$2'; second='$3'; heading='$4'" plots.gp
  echo "$1/motion.svg"
}

draw paper-loop q1 q2 "Three bodies, three revolute joints, one cylindrical joint, one loop"
draw andrews-squeezer beta gamma "Andrews squeezer"
