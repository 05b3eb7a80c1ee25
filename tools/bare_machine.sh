#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bare_machine.sh run|test|package [SUITE [FOLDER]]: tests this project on a bare Debian SUITE
# (bookworm, the default, or trixie), in a root folder that debootstrap creates in FOLDER. The
# default is a temporary folder, removed afterwards; a FOLDER that you pass stays and is reused.
#   run      adds git, clones the committed files, runs `./dev run`
#   test     same with `./dev test`
#   package  same with `./dev package`; then installs only the .deb with apt in a second bare root,
#            renders on both backends from several folders, installs the packages that the .deb
#            suggests, and measures the time from `new-effect` to a picture of the new effect
# Prints the number of packages installed, and the time of each part in seconds. Needs root, the
# network and debootstrap; downloads 200 to 900 MB.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

what=${1:-}
suite=${2:-bookworm}
[[ $what =~ ^(run|test|package)$ && $suite =~ ^[a-z]+$ ]] || { sed -n '3,13s/^# \{0,1\}//p' "$0" >&2; exit 2; }
((EUID == 0)) || { echo "bare_machine.sh: needs root, for debootstrap and chroot" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "bare_machine.sh: apt install debootstrap" >&2; exit 1; }

folder=${3:-$(mktemp -d)}
mkdir -p "$folder"
roots=()
leave() {
  local root
  for root in "${roots[@]}"; do umount -q "$root/dev/pts" "$root/dev/shm" "$root/dev" "$root/proc" || true; done
  [[ -n ${keep:-} ]] || rm -rf --one-file-system "$folder"
}
[[ -z ${3:-} ]] || keep=1
trap leave EXIT

# make_root NAME: creates a bare system in $folder/NAME, with only git and certificates.
make_root() {
  root=$folder/$1
  [[ -x $root/usr/bin/apt-get ]] ||
    debootstrap --variant=minbase --include=git,ca-certificates "$suite" "$root" >/dev/null
  roots+=("$root")
  mount -t proc proc "$root/proc"
  # Private: the mounts below must not appear in the machine's own /dev.
  mount --bind --make-private /dev "$root/dev"
  for below in pts shm; do mount --bind "/dev/$below" "$root/dev/$below"; done
  cp /etc/resolv.conf "$root/etc/"
}

inside() { env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb chroot "$root" bash -euo pipefail -c "$1"; }

# dev COMMAND: clones the committed files and runs `./dev COMMAND`.
dev() {
  make_root "$1"
  rm -rf "$root/root/grisaille"
  git clone -q --no-local . "$root/root/grisaille"
  local before after
  before=$(inside "dpkg-query -W | wc -l")
  inside "cd /root/grisaille && time ./dev $1"
  after=$(inside "dpkg-query -W | wc -l")
  echo "== $suite: ./dev $1 passes; $((after - before)) packages installed"
}

install_package() {
  make_root installed
  cp "$folder"/package/root/grisaille/build/grisaille_*.deb "$root/root/grisaille.deb"
  inside 'dpkg-deb -f /root/grisaille.deb Depends
    apt-get update -q >/dev/null
    DEBIAN_FRONTEND=noninteractive apt-get install -y -q /root/grisaille.deb >/root/apt.log 2>&1 ||
      { tail -n 20 /root/apt.log; exit 1; }
    grep -E "newly installed" /root/apt.log'
  # shellcheck disable=SC2016  # for the shell inside
  inside 'for folder in / /root /tmp /usr/share; do
      cd "$folder"
      for backend in opengl vulkan; do
        grisaille render --backend "$backend" --write ao=/tmp/$backend.png --write color=/tmp/color.png
      done
    done'
  inside 'DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends cmake g++ glslc make >/dev/null 2>&1
    cd /tmp && rm -rf glow glow.png
    time {
      grisaille new-effect glow
      (cd glow && cmake --workflow --preset effect) | tail -n 3
      grisaille render --plugin-path glow/build/lib/grisaille/effects --effects glow --write visibility=glow.png
    }'
  echo "== $suite: the package installs, renders and builds an effect"
}

dev "$what"
if [[ $what == package ]]; then install_package; fi
