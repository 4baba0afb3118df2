#!/bin/sh
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# install_packages.sh [LIST...]: installs the packages of scripts/packages.txt, and of other lists,
# that are missing (Debian, root or sudo). Does nothing, and needs no network, when all are there.
# PACKAGE/PROGRAM in a list: not where there is such a program already.
set -eu
missing=""
for entry in $(cat "$(dirname "$0")/packages.txt" "$@" | sed 's/#.*//'); do
  package=${entry%/*}
  [ "$package" = "$entry" ] || ! command -v "${entry#*/}" > /dev/null || continue
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  case "$status" in
    *"install ok installed"*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0
echo "installing:$missing"
sudo=""
[ "$(id -u)" -eq 0 ] || sudo="sudo"
export DEBIAN_FRONTEND=noninteractive
$sudo apt-get update -qq
# shellcheck disable=SC2086
$sudo apt-get install -y -qq --no-install-recommends $missing
