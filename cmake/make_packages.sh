#!/usr/bin/env bash
# Builds the Debian packages of docs/packages.md into a folder (default: out/packages). Needs what
# cmake/debian_packages.txt lists, fakeroot and dpkg-dev, and for all packages what
# cmake/debian_packages_report.txt and cmake/debian_packages_optional.txt list. Environment: JOBS, the number of parallel processes
# (default: one per processor); BUILD, the build folder (default: build-packages); DEBFULLNAME and DEBEMAIL,
# name and mail address of the maintainer, for packages that others get.
set -euo pipefail
cd "$(dirname "$0")/.."
output=$(realpath --canonicalize-missing "${1:-out/packages}")
build=$(realpath --canonicalize-missing "${BUILD:-build-packages}")

maintainer=()
if [[ -n ${DEBFULLNAME:-} && -n ${DEBEMAIL:-} ]]; then
  maintainer=(-DMSC_VO_PACKAGE_MAINTAINER="$DEBFULLNAME <$DEBEMAIL>")
fi
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr \
      -DCMAKE_INSTALL_DOCDIR=share/doc/msc-vo -DMSC_VO_BUILD_APPS=ON -DMSC_VO_BUILD_TESTS=OFF \
      -DMSC_VO_NATIVE=OFF "${maintainer[@]}"
cmake --build "$build" --parallel "${JOBS:-$(nproc)}"
rm -f "$build"/*.deb
(cd "$build" && fakeroot cpack -G DEB)
mkdir -p "$output"
rm -f "$output"/*.deb
mv "$build"/*.deb "$output"
ls -l "$output"
