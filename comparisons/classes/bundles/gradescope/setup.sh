#!/usr/bin/env bash
# Gradescope runs this once, when it makes the image of the autograder: what students need to build with goes here.
set -euo pipefail
root=${AUTOGRADER:-/autograder}
if command -v apt-get > /dev/null; then
    apt-get update && apt-get install -y python3 python3-venv g++ make nodejs
fi
python3 -m venv "$root/venv"
# What pip installs: a wheel of raytruth that lies beside this script, else a release; $RAYTRUTH says otherwise.
wheel=$(ls "$root"/source/raytruth-*.whl 2> /dev/null || true)
"$root/venv/bin/pip" install --quiet "${RAYTRUTH:-${wheel:-raytruth}}"
