#!/usr/bin/env bash
# The tests of a clone: installs what is missing, builds everything, runs the fast tests first, then
# the long ones, whatever became of the fast ones; one verdict at the end. Arguments go to ctest:
# ./run-tests.sh -R Rope
source "$(dirname "${BASH_SOURCE[0]}")/.ci/prepare.sh"

install_packages
build release

failed=()
say "Fast tests"
ctest --test-dir build/release --output-on-failure --no-tests=ignore -j2 -L unit "$@" || failed+=("fast tests")
say "Command line, verification and whole cases"
ctest --test-dir build/release --output-on-failure --no-tests=ignore -j2 -LE unit "$@" || failed+=("long tests")
verdict "${failed[@]}"
