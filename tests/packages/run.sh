#!/usr/bin/env bash
# Builds the Debian packages, checks them with lintian, installs them in a bare system of the same
# release made by debootstrap, and runs them there: the command, the Python module, a program built with the
# development package, and their removal. Needs root, a Debian mirror, and the packages debootstrap,
# fakeroot, dpkg-dev and lintian. Takes some minutes; not part of ctest.
#
#   tests/packages/run.sh [FOLDER]     FOLDER: packages that cmake/make_packages.sh built already
#
# Environment: MIRROR (default: that of this machine), SCRATCH, the folder for the bare system
# (default: a new one in /tmp, removed in the end; if given, it is kept, and used again if it exists).
set -euo pipefail
cd "$(dirname "$0")/../.."
packages=$(realpath --canonicalize-missing "${1:-out/packages}")
mirror=${MIRROR:-http://deb.debian.org/debian}
release=$(source /etc/os-release && echo "$VERSION_CODENAME")
version=$(sed -n 's/^project(msc_vo VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

say() { printf '\n== %s (%d s)\n' "$*" "$SECONDS"; }
fail() { echo "tests/packages/run.sh: $*" >&2; exit 1; }
[[ $EUID -eq 0 ]] || fail "debootstrap and chroot need root"
for program in debootstrap fakeroot lintian dpkg-shlibdeps; do
  command -v "$program" >/dev/null || [[ -x /usr/sbin/$program ]] || fail "needs $program"
done

if [[ $# -eq 0 ]]; then
  say "Build"
  export DEBFULLNAME=${DEBFULLNAME:-msc_vo} DEBEMAIL=${DEBEMAIL:-msc-vo@example.org}
  cmake/make_packages.sh "$packages"
fi
debs=("$packages"/*.deb)
[[ -e ${debs[0]} ]] || fail "no packages in $packages"

say "lintian"
lintian --fail-on error --allow-root "${debs[@]}"

if [[ -n ${SCRATCH:-} ]]; then
  bare=$SCRATCH
else
  bare=$(mktemp --directory /tmp/msc-vo-packages.XXXXXX)
fi
clean_up() {
  umount --quiet "$bare/proc" "$bare/dev/pts" "$bare/dev" || true
  if [[ -z ${SCRATCH:-} ]]; then rm -rf --one-file-system "$bare"; fi
}
trap clean_up EXIT

say "Bare $release in $bare"
if [[ ! -e $bare/usr/bin/apt-get ]]; then
  debootstrap --variant=minbase "$release" "$bare" "$mirror"
fi
mount -t proc proc "$bare/proc"
mount --bind /dev "$bare/dev"
mount --bind /dev/pts "$bare/dev/pts"
mkdir -p "$bare/packages" "$bare/data" "$bare/consumer"
rm -f "$bare"/packages/*.deb
cp "${debs[@]}" "$bare/packages"
cp -r data/room "$bare/data"
cp -r tests/consumer/project/. "$bare/consumer"
for file in /etc/apt/apt.conf.d/*proxy* /etc/resolv.conf; do  # how this machine reaches the mirror
  if [[ -e $file ]]; then cp --dereference "$file" "$bare$file"; fi
done
inside() {
  chroot "$bare" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
         DEBIAN_FRONTEND=noninteractive "${proxy[@]}" "$@"
}
proxy=()
for name in http_proxy https_proxy no_proxy; do
  if [[ -n ${!name:-} ]]; then proxy+=("$name=${!name}"); fi
done

say "Install"
inside sh -c 'dpkg-query -W -f "\${Package}\n" "*msc-vo*" 2>/dev/null | xargs --no-run-if-empty dpkg --purge' >/dev/null
inside apt-get update --quiet --quiet
before=$(inside dpkg-query -W -f '${Package}\n' | wc -l)
inside sh -c 'apt-get install --yes --quiet --quiet --no-install-recommends /packages/msc-vo_*.deb' >/dev/null
echo "msc-vo: $(($(inside dpkg-query -W -f '${Package}\n' | wc -l) - before)) packages"

say "Command"
[[ $(inside msc_vo --version) == "msc_vo $version" ]] || fail "msc_vo --version is not $version"
inside msc_vo replay /data/room --output /tmp/room --quiet
inside msc_vo evaluate /data/room/groundtruth.txt /tmp/room/trajectory.txt
inside test -s /usr/share/man/man1/msc_vo-replay.1.gz
inside bash -c 'source /usr/share/bash-completion/completions/msc_vo && complete -p msc_vo'
inside grep --quiet BSD-3-Clause /usr/share/doc/msc-vo/copyright
if inside msc_vo fuse /data/room /tmp/room/trajectory.txt --output /tmp/room.ply 2>/tmp/fuse.$$; then
  fail "fuse works without msc-vo-fusion"
fi
grep msc-vo-fusion /tmp/fuse.$$
rm /tmp/fuse.$$

if compgen -G "$packages/msc-vo-fusion_*.deb" >/dev/null; then
  say "Surface fusion"
  inside sh -c 'apt-get install --yes --quiet --quiet --no-install-recommends /packages/msc-vo-fusion_*.deb' >/dev/null
  inside msc_vo fuse /data/room /tmp/room/trajectory.txt --output /tmp/room.ply --voxel 0.03
fi

say "Python"
inside sh -c 'apt-get install --yes --quiet --quiet --no-install-recommends /packages/python3-msc-vo_*.deb' >/dev/null
inside python3 -c "
import msc_vo
sequence = msc_vo.Sequence('/data/room')
msc_vo.replay(sequence).write_trajectory('/tmp/python.txt')
print(msc_vo.__version__, msc_vo.__file__)
print(msc_vo.evaluate('/data/room/groundtruth.txt', '/tmp/python.txt'))"
cmp "$bare/tmp/python.txt" "$bare/tmp/room/trajectory.txt"

say "Development files"
inside sh -c 'apt-get install --yes --quiet --quiet --no-install-recommends \
                g++ cmake make pkg-config /packages/libmsc-vo-dev_*.deb' >/dev/null
for program in solver odometry; do
  inside cmake -S /consumer -B "/tmp/$program" -DPROGRAM=$program -DCOMPONENT=$program
  inside cmake --build "/tmp/$program"
  inside "/tmp/$program/${program}_consumer"
done
inside sh -c 'c++ -std=c++17 -O2 /consumer/solver_consumer.cc -o /tmp/with_pkg_config \
                $(pkg-config --cflags --libs msc_vo-solver) && /tmp/with_pkg_config'

say "Removal"
inside apt-get purge --yes --quiet --quiet libmsc-vo-dev msc-vo 'msc-vo-fusion*' python3-msc-vo >/dev/null
left=$(inside find /usr /etc -path '*msc[-_]vo*' -not -path '/usr/share/doc/msc-vo')
[[ -z $left ]] || fail "left after purging: $left"

say "All packages work in a bare $release"
