#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# bare_machine.sh package|run [FOLDER]: what this project does on a bare Debian 12, in a root folder
# of its own that debootstrap makes in FOLDER (default: a temporary one, removed afterwards; one that
# is there is used again).
#   package  installs build/grisaille_*.deb with apt and nothing else, renders on both backends from
#            several folders, then adds what the package suggests and takes the time from
#            `new-effect` to a picture of the new effect
#   run      adds git, clones what is committed here and calls `./dev run`
# Needs root, the network, and debootstrap; downloads 200 to 600 MB.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

what=${1:-}
[[ $what =~ ^(package|run)$ ]] || { sed -n '3,11s/^# //p' "$0" >&2; exit 2; }
((EUID == 0)) || { echo "bare_machine.sh: needs root, for debootstrap and chroot" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "bare_machine.sh: apt install debootstrap" >&2; exit 1; }

folder=${2:-$(mktemp -d)}
root=$folder/root
leave() {
  umount -q "$root/dev" "$root/proc" || true
  [[ -n ${keep:-} ]] || rm -rf --one-file-system "$folder"
}
[[ -z ${2:-} ]] || keep=1
trap leave EXIT
[[ -x $root/usr/bin/apt-get ]] || debootstrap --variant=minbase bookworm "$root" >/dev/null
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
cp /etc/resolv.conf "$root/etc/"
cat >"$root/root/install.sh" <<'EOF'
apt-get update -q >/dev/null
DEBIAN_FRONTEND=noninteractive apt-get install -y -q "$@" >/root/apt.log 2>&1 || {
  tail -n 20 /root/apt.log
  exit 1
}
grep 'newly installed' /root/apt.log
EOF

inside() { env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb chroot "$root" bash -euo pipefail -c "$1"; }

package() {
  cp build/grisaille_*.deb "$root/root/grisaille.deb"
  inside 'bash /root/install.sh /root/grisaille.deb'
  # shellcheck disable=SC2016  # for the shell inside
  inside 'for folder in / /root /tmp /usr/share; do
      cd "$folder"
      for backend in opengl vulkan; do
        grisaille render --backend "$backend" --write ao=/tmp/$backend.png --write color=/tmp/color.png
      done
    done'
  inside 'bash /root/install.sh --no-install-recommends cmake g++ glslc make'
  inside 'cd /tmp && rm -rf glow glow.png
    time {
      grisaille new-effect glow
      (cd glow && cmake --workflow --preset effect) | tail -n 3
      grisaille render --plugin-path glow/build/lib/grisaille/effects --effects glow --write visibility=glow.png
    }'
}

run() {
  inside 'bash /root/install.sh --no-install-recommends git ca-certificates'
  rm -rf "$root/root/grisaille"
  git clone -q --no-local . "$root/root/grisaille"
  inside 'cd /root/grisaille && time ./dev run && ls -l grisaille.png'
}

"$what"
