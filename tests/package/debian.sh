#!/usr/bin/env bash
# Installs the packages in a new Debian, uses them there as an ordinary user, and removes them:
#   tests/package/debian.sh bookworm|trixie [FOLDER]
# FOLDER has .debs for that Debian; without it, they are built there from what is committed (half an hour).
# As root, with debootstrap; takes some minutes, and 3 GB in $TMPDIR. Prints what fails, and its exit code says so.
set -euo pipefail
debian=${1:?bookworm or trixie}
debs=${2:-}
here=$(dirname "$(readlink -f "$0")")
# In a mount namespace: what is mounted goes with this process.
[ "${GRAMLOOM_UNSHARED:-}" ] || GRAMLOOM_UNSHARED=1 exec unshare --mount "$0" "$@"

root=$(mktemp -d)/$debian
trap 'umount "$root/proc" && rm -rf --one-file-system "$(dirname "$root")"' EXIT
say() { echo "--- $*" >&2; }
failed=0
fail() { echo "FAILED: $*" >&2; failed=1; }
expect() { eval "$1" || fail "$1"; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive bash -c "$1"; }
install() { inside "apt-get install -y -qq --no-install-recommends $* >/tmp/apt.log 2>&1" || { cat "$root/tmp/apt.log" >&2; exit 1; }; }
user() { inside "su newcomer -c 'cd && $1'"; }  # $1: no single quotes

say "debootstrap $debian"
mkdir -p "$root"
debootstrap --variant=minbase "$debian" "$root" >"$root/../log" 2>&1 || { tail -5 "$root/../log" >&2; exit 1; }
mount -t proc proc "$root/proc"
cp /etc/resolv.conf "$root/etc/"
inside "useradd -m newcomer"

mkdir "$root/debs"
if [ -z "$debs" ]; then
  say "building there"
  mkdir "$root/gramloom"
  git -C "$here/../.." archive HEAD | tar -x -C "$root/gramloom"
  inside "/gramloom/bootstrap package && mv /gramloom/build/packages/*.deb /debs && rm -rf /gramloom"
else
  cp "$debs"/*.deb "$root/debs"
fi
inside "apt-get update -qq"

say "the program alone"
install /debs/gramloom_*.deb man-db
expect 'user "gramloom make brick --size 128 --output brick.png --quiet" && [ -s "$root/home/newcomer/brick.png" ]'
expect '! user "gramloom run /usr/share/gramloom/configs/quickstart.toml --quiet" 2>"$root/tmp/errors"'
expect '[ "$(grep -c "install the package gramloom-neural" "$root/tmp/errors")" = 1 ]'
cat "$root/tmp/errors"
inside "rm -r /home/newcomer/*"

say "and the neural part: the first picture"
install /debs/gramloom-neural_*.deb
TIMEFORMAT="first picture after %R s, of the processors %U s"
time expect 'user "gramloom run /usr/share/gramloom/configs/quickstart.toml --quiet"'
expect '[ -s "$root/home/newcomer/out/quickstart/pebbles/neural/seed1.png" ]'
expect 'user "gramloom make /usr/share/gramloom/data/pebbles.png --size 128 --kind quilting --output made.png --quiet" && [ -s "$root/home/newcomer/made.png" ]'
for page in gramloom gramloom-run gramloom-config; do expect "user 'man -w $page' >/dev/null"; done
expect 'user "gramloom new mine.toml --from /usr/share/gramloom/data && gramloom check mine.toml" >/dev/null'

say "programs that use the libraries"
install /debs/libgramloom-dev_*.deb cmake g++ make
expect 'user "cmake -S /usr/share/doc/libgramloom-dev/examples -B examples && cmake --build examples" >"$root/tmp/examples.log" || ! tail "$root/tmp/examples.log"'
expect 'user "examples/marble a.png b.png" && [ -s "$root/home/newcomer/b.png" ]'

say "the Python module"
install /debs/python3-gramloom_*.deb
expect 'user "python3 -c \"import gramloom\""'

say "removed"
inside "apt-get purge -y -qq '.*gramloom.*' >/dev/null 2>&1"
left=$(inside "find / -xdev -iname '*gramloom*' -not -path '/home/*' -not -path '/debs/*' -not -path '/proc/*'")
expect '[ -z "$left" ]'
echo "$left"

say "lintian"
install lintian
expect 'inside "lintian --allow-root --fail-on error /debs/*.deb"'
exit $failed
