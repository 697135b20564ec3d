#!/usr/bin/env bash
# Boots systemd in a folder that holds a Debian system: first process of its own namespaces, loopback its only network.
#   unshare --mount --pid --fork --uts --ipc --net --cgroup boot_root.sh ROOT
set -euo pipefail
root="$1"
mount --make-rprivate /
mount --bind "$root" "$root"
cd "$root"
mkdir -p .outside
pivot_root . .outside
cd /
mount -t proc proc /proc
mount -t sysfs -o ro sysfs /sys
mount -t tmpfs tmpfs /run
mount -t tmpfs -o mode=755 tmpfs /dev
while read -r name major minor; do mknod -m 666 "/dev/$name" c "$major" "$minor"; done <<END
null 1 3
zero 1 5
full 1 7
random 1 8
urandom 1 9
tty 5 0
END
mkdir -p /dev/pts /dev/shm
mount -t devpts -o newinstance,ptmxmode=0666 devpts /dev/pts
mount -t tmpfs tmpfs /dev/shm
ln -s pts/ptmx /dev/ptmx
ln -s /proc/self/fd /dev/fd
if [[ -e /.outside/sys/fs/cgroup/cgroup.controllers ]]; then
  mount -t cgroup2 cgroup2 /sys/fs/cgroup
else  # the older hierarchies, one each
  mount -t tmpfs tmpfs /sys/fs/cgroup
  mkdir /sys/fs/cgroup/systemd
  mount -t cgroup -o none,name=systemd cgroup /sys/fs/cgroup/systemd
fi
umount -l /.outside
ip link set lo up
exec env -i container=other PATH=/usr/sbin:/usr/bin:/sbin:/bin /lib/systemd/systemd
