#!/usr/bin/env bash
# The installation as others meet it, of the program in build/release: a program of somebody else
# finds the libraries and simulates a pendulum with them; the Debian packages' dependencies can be
# had, what they hold runs from an empty folder, and they are installed, used and removed again in a
# root of their own.
source "$(dirname "${BASH_SOURCE[0]}")/prepare.sh"

place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

say "Installing, and a program that stands on the installed libraries"
cmake --install build/release --prefix "$place/usr" >/dev/null
cmake -S tests/install -B "$place/somebody" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$place/usr" >/dev/null
cmake --build "$place/somebody"
ctest --test-dir "$place/somebody" --output-on-failure --no-tests=error

say "Debian packages"
(cd "$place" && cpack --config "$OLDPWD/build/release/CPackConfig.cmake" >/dev/null)
for package in "$place"/*.deb; do
  echo "$(basename "$package"): $(dpkg-deb --field "$package" Depends)"
  # The Python package asks for the program's, which no archive has.
  case $package in
    *python3-*) dpkg-deb --field "$package" Depends | grep -q blocklift ;;
    *) apt-get install --simulate -qq "$package" >/dev/null ;;
  esac
done
dpkg-deb --extract "$place"/blocklift_*.deb "$place/clean"
clean() { (cd "$place/clean" && env -i HOME="$place/clean" PATH=/usr/bin:/bin "$@"); }
clean usr/bin/blocklift --version
clean usr/bin/blocklift validate usr/share/blocklift/cases/goliath-turnover
clean usr/bin/blocklift simulate usr/share/blocklift/models/mechanisms/slider-crank -o result >/dev/null
test -s "$place/clean/result/report.html"
grep -q 'three.*licence' "$place/clean/result/report.html"
grep -q '^\.SS assess' "$place/clean/usr/share/man/man1/blocklift.1"

# The machine's files under an overlay: what is installed over them stays in memory.
say "Packages in a root of their own"
cat >"$place/in-own-root.sh" <<'END'
set -euo pipefail
mkdir "$1/over"
mount -t tmpfs none "$1/over" && mkdir "$1"/over/{upper,work,whole} &&
  mount -t overlay overlay "$1/over/whole" \
    -o "lowerdir=/,upperdir=$1/over/upper,workdir=$1/over/work" &&
  mount --rbind /proc "$1/over/whole/proc" && mount --rbind /dev "$1/over/whole/dev" || exit 77
cp "$1"/*.deb "$1/over/whole/mnt"
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root chroot "$1/over/whole" bash -euo pipefail -c '
  cd /root
  dpkg --install /mnt/*.deb >/dev/null
  blocklift --version
  blocklift simulate /usr/share/blocklift/models/mechanisms/slider-crank -o result >/dev/null
  test -s result/report.html
  /usr/bin/python3 -c "import blocklift; print(\"blocklift\", blocklift.version(), \"from Python\")"
  dpkg --purge python3-blocklift libblocklift-dev blocklift >/dev/null
  test ! -e /usr/bin/blocklift
  test -z "$(find /usr/{bin,lib,include,share} -path "*blocklift*" -print -quit)"'
END
code=77
# Neither who is not root nor root of a container without the right to mount can make one.
if unshare --mount true 2>/dev/null; then
  code=0
  unshare --mount bash "$place/in-own-root.sh" "$place" || code=$?
fi
case $code in
  0) echo "installed, used and removed" ;;
  77) echo "left out: this machine lets nobody mount an overlay" ;;
  *) exit "$code" ;;
esac

say "Python"
dpkg-deb --extract "$place"/python3-blocklift_*.deb "$place/clean"
BLOCKLIFT="$place/clean/usr/bin/blocklift" PYTHONPATH="$place/clean/usr/lib/python3/dist-packages" \
  /usr/bin/python3 -c "import blocklift; print('blocklift', blocklift.version(), 'from Python')"
BLOCKLIFT="$place/clean/usr/bin/blocklift" PYTHONPATH="$place/clean/usr/lib/python3/dist-packages" \
  /usr/bin/python3 -c "
import blocklift, blocklift.kernel
result = blocklift.Case('tests/pipeline/cases/small-lift').simulate('$place/in-process', laws={})
assert blocklift.kernel.load().__file__.startswith('$place/clean/'), blocklift.kernel.load().__file__
print(result, 'in the process of Python')"
cp -r pipeline/python "$place/wheel"
cp build/release/_kernel*.so "$place/wheel/blocklift"
(cd "$place/wheel" && /usr/bin/python3 -c "from setuptools import build_meta; build_meta.build_wheel('.')" >/dev/null 2>&1 &&
  test -e blocklift-*-cp3*.whl &&
  /usr/bin/python3 -m zipfile --extract blocklift-*.whl unpacked)
BLOCKLIFT="$place/clean/usr/bin/blocklift" PYTHONPATH="$place/wheel/unpacked" \
  /usr/bin/python3 -c "import blocklift; print(blocklift.describe('lift case', 'gravity'))"

say "Completion"
source "$place/clean/usr/share/bash-completion/completions/blocklift"
completed() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _blocklift
  printf '%s ' "${COMPREPLY[@]}"
}
[ "$(completed blocklift ass)" = "assess " ]
[ "$(completed blocklift stress --calc)" = "--calculix " ]
[ "$(completed blocklift hydro --export b)" = "bemio " ]
echo "commands, options and words are completed"
