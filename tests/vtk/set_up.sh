#!/bin/sh
# A virtual environment with VTK's own reader: set_up.sh DIRECTORY. Fails if it cannot be had.
set -u
directory=$1
mkdir -p "$directory"
python=$directory/venv/bin/python
wanted="vtk>=9.4 h5py numpy"

"$python" -c "import vtk, h5py" >/dev/null 2>&1 && exit 0
[ -x "$python" ] || "${PYTHON:-python3}" -m venv "$directory/venv" >"$directory/venv.log" 2>&1 || {
   echo "vtk-test: no virtual environment (python3-venv is missing?): $directory/venv.log"
   exit 1
}
# shellcheck disable=SC2086 # one word per package
"$python" -m pip install -q $wanted >"$directory/pip.log" 2>&1 || {
   echo "vtk-test: pip could not install $wanted: $directory/pip.log"
   exit 1
}
