#!/usr/bin/env bash
# Installs the missing packages of cmake/debian_packages.txt without asking, with --optional also those of
# cmake/debian_packages_optional.txt. If none is missing, it needs neither root nor a network.
set -euo pipefail
cd "$(dirname "$0")"
lists=(debian_packages.txt)
case ${1:-} in
  '') ;;
  --optional) lists+=(debian_packages_optional.txt) ;;
  *) echo "usage: cmake/install_packages.sh [--optional]" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: assuming that the packages of cmake/debian_packages.txt are installed."
  exit 0
fi

missing=()
while read -r package; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done < <(grep --no-filename --invert-match --extended-regexp '^(#|$)' "${lists[@]}")
if [[ ${#missing[@]} -eq 0 ]]; then
  exit 0
fi

echo "Installing ${missing[*]}"
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
"${apt[@]}" install --no-install-recommends "${missing[@]}"
