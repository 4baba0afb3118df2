#!/bin/sh
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# install_packages.sh [LIST...]: installs the missing packages of cmake/scripts/packages.txt and of
# other lists (Debian, root or sudo). Does nothing, and needs no network, if all are installed.
# Without the right to install, it prints the command for an administrator, and fails.
# PACKAGE/PROGRAM in a list: not needed if the program exists. A question mark at the end: optional.
set -eu
missing=""
needed=""
for entry in $(cat "$(dirname "$0")/packages.txt" "$@" | sed 's/#.*//'); do
  name=${entry%\?}
  package=${name%/*}
  [ "$package" = "$name" ] || ! command -v "${name#*/}" > /dev/null || continue
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  case "$status" in
    *"install ok installed"*) continue ;;
  esac
  missing="$missing $package"
  [ "$name" != "$entry" ] || needed="$needed $package"
done
[ -n "$missing" ] || exit 0

# fail WHY: goes on if all missing packages are optional.
fail() {
  echo "$1. As an administrator of Debian 12, type" >&2
  echo "apt-get update && apt-get install -y --no-install-recommends$missing" >&2
  [ -n "$needed" ] || { echo "Going on without." >&2; exit 0; }
  exit 1
}
command -v apt-get > /dev/null || fail "packages are missing, and there is no apt-get"
sudo=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo > /dev/null || fail "packages are missing, this is not root, and there is no sudo"
  sudo="sudo"
fi
echo "installing:$missing"
export DEBIAN_FRONTEND=noninteractive
$sudo apt-get update -qq || fail "the list of packages could not be brought up to date"
# shellcheck disable=SC2086
$sudo apt-get install -y -qq --no-install-recommends $missing || fail "packages could not be installed"
