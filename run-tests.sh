#!/usr/bin/env bash
# The tests of a clone: installs what is missing, builds everything, runs the fast tests first, then
# the long ones, whatever became of the fast ones; one verdict at the end. Arguments go to ctest:
# ./run-tests.sh -R Rope
# Without them each program of fast tests runs all of its tests in one process: to start it once for
# each test takes most of their time.
source "$(dirname "${BASH_SOURCE[0]}")/.ci/prepare.sh"

install_packages
build release

failed=()
say "Fast tests"
fast=program
[ $# -eq 0 ] || fast=unit
ctest --test-dir build/release --output-on-failure --no-tests=ignore -j2 -L "$fast" "$@" || failed+=("fast tests")
say "Command line, verification and whole cases"
ctest --test-dir build/release --output-on-failure --no-tests=ignore -j2 -LE 'unit|program' "$@" || failed+=("long tests")
verdict "${failed[@]}"
