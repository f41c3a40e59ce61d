#!/usr/bin/env bash
# clang-tidy over our own sources with the settings of .clang-tidy, in bundles of up to 20 sources of
# one target that begin with its precompiled header: the libraries' headers are read once, and the
# checks do not walk through them (.ci/tidy/own_code.cc). Sources that cannot stand in one bundle
# (two have the same name in an unnamed namespace) are judged in halves.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
plugin=build/tidy/own_code.so

# Bundles include sources, which no source of ours does.
tidy() {
  clang-tidy --load="$plugin" -p build/tidy --quiet --checks=-bugprone-suspicious-include "$1" 2>&1
}

# judge BUNDLE: a source, or a .cxx of lines `#include "/path/of/source.cc"` whose folder tells the
# compiler's options.
judge() {
  local bundle=$1 complaints sources=()
  [[ $bundle == *.cxx ]] && mapfile -t sources <"$bundle"
  complaints=$(tidy "$bundle") && return 0
  if [ ${#sources[@]} -gt 1 ] && grep -q 'clang-diagnostic' <<<"$complaints"; then
    local half=$(((${#sources[@]} + 1) / 2)) first="${bundle%.cxx}a.cxx" second="${bundle%.cxx}b.cxx"
    printf '%s\n' "${sources[@]:0:half}" >"$first"
    printf '%s\n' "${sources[@]:half}" >"$second"
    local code=0
    judge "$first" || code=1
    judge "$second" || code=1
    return $code
  fi
  printf '%s\n' "$complaints"
  return 1
}

if [ "${1:-}" = --judge ]; then
  judge "$2"
  exit
fi

rm -rf build/tidy
cmake --preset tidy >/dev/null
cmake --build build/tidy --target blocklift_kernel_headers blocklift_pipeline_headers \
  blocklift_quick_pipeline_headers >/dev/null
# shellcheck disable=SC2046  # the options of LLVM are many words
clang++ -fPIC -shared -std=c++17 -fno-rtti -O1 $(llvm-config --cppflags) .ci/tidy/own_code.cc -o "$plugin"
mapfile -t bundles < <(find "$PWD"/build/tidy/{algebra,parallel,dynamics,structure,pipeline} -name 'unity_*.cxx' | sort)
sed -i -e '/^#include/!d' -e "\\|$PWD/build/tidy/|d" "${bundles[@]}"  # without what the build would generate
# Sources that CMake leaves alone, for options of their own.
mapfile -t alone < <(git ls-files 'algebra/*.cc' 'parallel/*.cc' 'dynamics/*.cc' 'structure/*.cc' 'pipeline/*.cc' | grep -vxFf \
  <(sed -e "s|^#include \"$PWD/||" -e 's|"$||' "${bundles[@]}"))
printf '%s\0' "${bundles[@]}" "${alone[@]}" |
  xargs -0 -r -P "$(nproc)" -n 1 "$PWD/.ci/tidy.sh" --judge
