#!/usr/bin/env bash
# Make .venv and install the project into it, and the system's packages that some of it needs.
# Usage, in the project's folder: tools/make_environment.sh WHAT_PIP_INSTALLS SYSTEM_PACKAGE...
set -euo pipefail

is_new_enough() {
    "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null
}

find_python() {
    local candidate
    for candidate in ${PYTHON:+"$PYTHON"} python3 python3.13 python3.12 python3.11; do
        if is_new_enough "$candidate"; then
            printf '%s\n' "$candidate"
            return
        fi
    done
    echo "raytruth needs Python 3.11 or newer and found none; install one, or name it: make run PYTHON=/path/to/python" >&2
    return 1
}

make_venv() {
    local python version
    python=$(find_python)
    # Debian ships Python without the means to make environments.
    if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
        version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
        bash tools/install_system_packages.sh "python$version-venv"
        if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
            echo "$python cannot make an environment: install its modules venv and ensurepip." >&2
            return 1
        fi
    fi
    "$python" -m venv .venv
}

what=$1
shift
# An environment whose interpreter is gone or too old is made anew.
if ! is_new_enough .venv/bin/python; then
    echo "Making the environment .venv …"
    rm -rf .venv
    make_venv
fi
echo "Installing raytruth and what it needs into .venv …"
# The system's packages come from elsewhere and take as long: both at once.
bash tools/install_system_packages.sh "$@" &
.venv/bin/python -m pip install --quiet --disable-pip-version-check --no-input --constraint constraints.txt --editable "$what"
# Blender asks for NumPy 1, for its audio module alone, which is not used: so it is installed without what it asks for.
# There is a wheel of this version for one Python only.
if ! .venv/bin/python -m pip install --quiet --disable-pip-version-check --no-input --no-deps --only-binary :all: \
    --constraint constraints.txt bpy 2>/dev/null; then
    echo "There is no bpy for this Python. raytruth works without, with fewer renderers or tests."
fi
wait
