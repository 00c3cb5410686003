#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Does what a newcomer does on a bare Debian 12: a system of debootstrap's smallest variant with git, a clone of what is
# committed here, and a command in it. So a package that ./cmake/run forgets to install is found, on whatever machine this runs.
#
#   tests/bare_machine.sh [command]      default: a short ./cmake/run demo, not optimised, to save time
#
# Needs root and debootstrap; elsewhere it says so and ends with 77, "skipped". The new system takes half a minute and 350 MB
# before the command, and is removed afterwards. Ends as the command does.
set -euo pipefail

# Behind each command of the compiler, as CMake calls it.
unoptimised="printf '#!/bin/sh\nexec \"\$@\" -O0\n' >/tmp/unoptimised && chmod 755 /tmp/unoptimised"
command=${1:-$unoptimised && CMAKE_CXX_COMPILER_LAUNCHER=/tmp/unoptimised ./cmake/run demo --bounds 1000 --seconds 1}
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
skip() {
  echo "Skipped: a bare Debian 12 is made by $1."
  exit 77
}
[[ $EUID -eq 0 ]] || skip "root"
command -v debootstrap >/dev/null || skip "debootstrap, which is not installed (Debian: debootstrap)"
command -v unshare >/dev/null || skip "unshare, which is not installed (Debian: util-linux)"

if [[ -z ${BARE_MACHINE_MOUNTS:-} ]]; then
  # Mounts of this namespace are gone when it ends, however it ends: nothing but the new system's own files can be removed.
  unshare --mount --propagation private true 2>/dev/null || skip "a root who may mount, which this one may not"
  BARE_MACHINE_MOUNTS=own exec unshare --mount --propagation private bash "${BASH_SOURCE[0]}" "$command"
fi

# Debian's packages come from where this machine gets them; from debootstrap's own choice if this is not a Debian.
mirror=$(apt-get indextargets --format '$(SITE)' 'Origin: Debian' 'Codename: bookworm' 2>/dev/null | head -n 1 || true)
work=$(mktemp -d)
trap 'umount "$work"/system/{proc,dev} 2>/dev/null || true; rm -rf --one-file-system "$work"' EXIT
echo "Making a bare Debian 12"
if ! debootstrap --variant=minbase --include=ca-certificates,git bookworm "$work/system" ${mirror:+"$mirror"} \
  >"$work/log" 2>&1; then
  tail -n 3 "$work/log" >&2
  echo "bare_machine.sh: debootstrap could not make a system; see above" >&2
  exit 1
fi
cp /etc/resolv.conf "$work/system/etc/"
# How this machine reaches its mirror: proxies and the like.
{ grep -ls '^Acquire' /etc/apt/apt.conf.d/* || true; } | xargs -r cp -t "$work/system/etc/apt/apt.conf.d/"
git -c safe.directory='*' clone -q "$project" "$work/system/root/shaftcull"
mount --bind /proc "$work/system/proc"
mount --bind /dev "$work/system/dev"

echo "There: $command"
status=0
chroot "$work/system" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb \
  bash -c "cd ~/shaftcull && $command" </dev/null || status=$?
echo "On a bare Debian 12, '$command' ended with $status after $SECONDS s, the system's making included."
exit $status
