#!/usr/bin/env bash
# Installs the missing Debian packages of packages.txt (asking sudo where the user is not root),
# configures and builds. Sourced by first-lift.sh, run-tests.sh and .ci/run; safe to repeat, quick
# when nothing is missing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

missing_packages() {
  local wanted package
  wanted=$(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' .ci/packages.txt)
  # Node bundles the report's scripts; any npm on the PATH will do, Debian's comes where there is
  # none.
  command -v npm >/dev/null 2>&1 || wanted="$wanted nodejs npm"
  for package in $wanted; do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || echo "$package"
  done
}

install_packages() {
  command -v apt-get >/dev/null 2>&1 || {
    echo "Blocklift installs its libraries with apt-get, which this system does not have." >&2
    echo "Install what .ci/packages.txt names by hand, then use: cmake --preset release" >&2
    exit 1
  }
  local missing
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -eq 0 ] && return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 || {
      echo "These packages are missing, and without sudo only root can install them: ${missing[*]}" >&2
      exit 1
    }
    as_root=(sudo)
    say "Using sudo to install Debian packages"
  fi
  say "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
}

# build PRESET [TARGET ...]
build() {
  local preset=$1
  shift
  say "Building ($preset)"
  cmake --preset "$preset" >/dev/null
  cmake --build "build/$preset" ${1:+--target "$@"}
}

# verdict [WHAT ...]: says what failed, if anything did; the exit code of the script.
verdict() {
  if [ $# -eq 0 ]; then
    say "All tests pass"
    return 0
  fi
  local IFS=,
  say "FAILED: $*"
  return 1
}
