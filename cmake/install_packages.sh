#!/usr/bin/env bash
# Installs the missing packages of cmake/debian_packages.txt without asking.
#
#   install_packages.sh [report] [optional] [developer] [tests] [clang] [arm64]
#
# The arguments name further lists, cmake/debian_packages_NAME.txt. It goes on without a package of
# these that the release does not have or that cannot be installed. If no package is missing, it needs
# neither root nor a network.
set -euo pipefail
cd "$(dirname "$0")"
for list in "$@"; do
  if [[ ! -f debian_packages_$list.txt ]]; then
    echo "usage: cmake/install_packages.sh [report] [optional] [developer] [tests] [clang] [arm64]" >&2
    exit 2
  fi
done

if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: assuming that the packages of cmake/debian_packages.txt are installed."
  exit 0
fi

# Prints the packages of a list that are not installed.
missing_of() {
  local package status
  while read -r package; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || echo "$package"
  done < <(grep --invert-match --extended-regexp '^(#|$)' "$1")
}

mapfile -t missing < <(missing_of debian_packages.txt)
optional=()
for list in "$@"; do
  mapfile -t -O "${#optional[@]}" optional < <(missing_of "debian_packages_$list.txt")
done
if [[ $((${#missing[@]} + ${#optional[@]})) -eq 0 ]]; then
  exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    if [[ ${#missing[@]} -eq 0 ]]; then
      echo "Neither root nor sudo: going on without the optional packages ${optional[*]}"
      exit 0
    fi
    echo "Neither root nor sudo: install ${missing[*]} and run again." >&2
    exit 1
  fi
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --yes --quiet)
install=("${apt[@]}" install --no-install-recommends)
if [[ ${#missing[@]} -gt 0 ]]; then
  echo "Installing ${missing[*]}"
  "${apt[@]}" update
  "${install[@]}" "${missing[@]}"
else
  "${apt[@]}" update || true
fi

# Packages that the release does not have would keep the others from being installed with them.
present=()
for package in "${optional[@]}"; do
  if apt-cache show "$package" >/dev/null 2>&1; then
    present+=("$package")
  else
    echo "Going on without $package, which this release does not have and msc_vo does not need."
  fi
done
if [[ ${#present[@]} -eq 0 ]]; then exit 0; fi
echo "Installing ${present[*]}"
if ! "${install[@]}" "${present[@]}"; then
  for package in "${present[@]}"; do
    "${install[@]}" "$package" || echo "Going on without $package, which is optional."
  done
fi
