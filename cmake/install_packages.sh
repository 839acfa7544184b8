#!/usr/bin/env bash
# Installs the missing packages of cmake/debian_packages.txt without asking, with --optional also those of
# cmake/debian_packages_optional.txt that the distribution has. If none is missing, it needs neither root
# nor a network.
set -euo pipefail
cd "$(dirname "$0")"
if [[ $# -gt 1 || ($# -eq 1 && $1 != --optional) ]]; then
  echo "usage: cmake/install_packages.sh [--optional]" >&2
  exit 2
fi

if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: assuming that the packages of cmake/debian_packages.txt are installed."
  exit 0
fi

# The packages of a list that are not installed.
missing_of() {
  local package status
  grep --invert-match --extended-regexp '^(#|$)' "$1" | while read -r package; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || echo "$package"
  done
}

mapfile -t missing < <(missing_of debian_packages.txt)
optional=()
if [[ $# -eq 1 ]]; then
  mapfile -t optional < <(missing_of debian_packages_optional.txt)
fi
if [[ ${#missing[@]} -eq 0 && ${#optional[@]} -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "Neither root nor sudo: install these packages and run again." >&2
    exit 1
  fi
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --yes --quiet)
"${apt[@]}" update
for package in "${optional[@]}"; do
  if [[ -n $(apt-cache show "$package" 2>/dev/null) ]]; then
    missing+=("$package")
  else
    echo "Left out: this distribution has no $package"
  fi
done
echo "Installing ${missing[*]}"
"${apt[@]}" install --no-install-recommends "${missing[@]}"
