#!/usr/bin/env bash
# Install Debian packages where that is possible without asking; otherwise say in one line what is missing.
# Usage: tools/install_system_packages.sh PACKAGE...
# Always succeeds: whoever needs a package says so when it runs without it.
set -uo pipefail

is_installed() {
    [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing=()
for package in "$@"; do
    is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

if ! command -v apt-get >/dev/null; then
    echo "Not found: ${missing[*]} (names of Debian packages). raytruth works without, with fewer renderers or tests."
    exit 0
elif [ "$(id -u)" -eq 0 ]; then
    as_root=(env)
elif sudo -n true 2>/dev/null; then
    as_root=(sudo -n env)
else
    echo "Missing: ${missing[*]}. To have all renderers and tests: sudo apt-get install ${missing[*]}"
    exit 0
fi

install() {
    "${as_root[@]}" DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends -qq "${missing[@]}" \
        >/dev/null 2>&1 </dev/null
}

echo "Installing ${missing[*]} …"
# A new machine has no package lists yet, an old one outdated ones.
if ! install && ! { "${as_root[@]}" apt-get update -qq >/dev/null 2>&1 </dev/null && install; }; then
    echo "Missing: ${missing[*]}; apt-get cannot install it here. raytruth works without, with fewer renderers or tests."
fi
exit 0
