#!/usr/bin/env bash
# Lets libFuzzer try the readers: .ci/fuzz.sh [SECONDS [PROGRAM ...]], two minutes over all of them
# if nothing is said. What makes one crash, take more than 10 s or more than 2 GB is kept in
# build/fuzz/finds, and the exit code is 1; inputs that go new ways are kept in build/fuzz/corpus.
source "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

seconds=${1:-120}
shift || true
programs=("$@")
[ ${#programs[@]} -gt 0 ] || programs=(nastran abaqus part_mesh gdf wamit input_file database)

build fuzz "${programs[@]/#/fuzz_}"
mkdir -p build/fuzz/finds
failed=()
for program in "${programs[@]}"; do
  say "Fuzzing: $program"
  kept=build/fuzz/corpus/$program
  mkdir -p "$kept"
  # Weighing inputs by how rare what they reach is (entropic) takes a third of the time, and freed
  # memory that is kept for long most of the caches.
  # Gmsh and HDF5 keep what they allocate until the process ends: leaks are not looked for.
  ASAN_OPTIONS=malloc_context_size=1:quarantine_size_mb=32 nice build/fuzz/tests/fuzz/fuzz_"$program" \
    -max_total_time=$((seconds / ${#programs[@]})) -timeout=10 -rss_limit_mb=2048 -max_len=20000 \
    -detect_leaks=0 -entropic=0 -print_final_stats=1 -artifact_prefix="build/fuzz/finds/$program-" \
    "$kept" "tests/fuzz/corpus/$program" >"build/fuzz/$program.log" 2>&1 || failed+=("$program")
  grep -E '^stat::(number_of_executed_units|slowest_unit_time_sec|peak_rss_mb)|SUMMARY|Test unit written' \
    "build/fuzz/$program.log" || true
done
[ ${#failed[@]} -eq 0 ] || { echo "finds in: ${failed[*]}" >&2; exit 1; }
