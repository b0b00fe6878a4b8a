#!/bin/sh
# Gets the programs that peers.py compares with, as far as they can be had: Simbody from Debian's packages, MuJoCo and Exudyn from PyPI
# in a virtual environment. set_up.sh DIRECTORY; says what is missing, and fails only if nothing is there.
set -u
mkdir -p "$1"
directory=$(cd "$1" && pwd)
cd "$(dirname "$0")"
there=""

say() { printf 'bench-peers: %s\n' "$*"; }

as_root() {
   if [ "$(id -u)" -eq 0 ]; then
      env DEBIAN_FRONTEND=noninteractive "$@"
   else
      sudo -n env DEBIAN_FRONTEND=noninteractive "$@"
   fi
}

if command -v apt-get >/dev/null 2>&1; then
   wanted=""
   for package in g++ libsimbody-dev python3-venv; do
      dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null | grep -q '^installed' || wanted="$wanted $package"
   done
   # shellcheck disable=SC2086 # one word per package
   [ -z "$wanted" ] || as_root apt-get install -y -qq --no-install-recommends $wanted </dev/null >"$directory/apt.log" 2>&1 ||
      say "apt-get could not install:$wanted ($directory/apt.log)"
fi

built=yes
for program in simbody_peer simbody_space; do
   if [ "$directory/$program" -nt "$program.cpp" ] && [ "$directory/$program" -nt simbody_loose.h ]; then continue; fi
   g++ -O2 -std=c++17 -I/usr/include/simbody "$program.cpp" -o "$directory/$program" -lSimTKsimbody -lSimTKmath -lSimTKcommon \
      >"$directory/$program.log" 2>&1 || built=no
done
if [ "$built" = yes ]; then
   there="$there Simbody"
else
   say "no Simbody ($directory/simbody_peer.log)"
fi

python=$directory/venv/bin/python
[ -x "$python" ] || "${PYTHON:-python3}" -m venv "$directory/venv" >"$directory/venv.log" 2>&1
for package in mujoco exudyn; do
   if "$python" -c "import $package" >/dev/null 2>&1 || "$python" -m pip install -q "$package" >"$directory/$package.log" 2>&1; then
      there="$there $package"
   else
      say "no $package ($directory/$package.log)"
   fi
done

[ -n "$there" ] || { say "nothing to compare with"; exit 1; }
say "found:$there"
