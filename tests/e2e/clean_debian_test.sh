#!/usr/bin/env bash
# The Debian package on a clean Debian 12 that is booted: installed, run in the sandbox of its unit, restarted, crashed,
# kept from its start, reached through nginx, upgraded, removed, installed again, purged.
#   clean_debian_test.sh BUILD_FOLDER
# Needs root, mmdebstrap and a Debian mirror; exit code 77 (skipped) without them.
set -euo pipefail
build="$1"
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
skip() { echo "skipped: $*"; exit 77; }
((EUID == 0)) || skip "this is not root"
command -v mmdebstrap >/dev/null || skip "there is no mmdebstrap"
unshare --mount --pid --fork --uts --ipc --net --cgroup true 2>/dev/null || skip "no namespaces here"

scratch="$(mktemp -d)"
root="$scratch/root"
init=0
clean_up() {
  ((init == 0)) || { kill -KILL "$init" && wait "$booted"; } 2>/dev/null || true
  rm -rf --one-file-system "$scratch"
}
trap clean_up EXIT
inside() { nsenter -t "$init" -a env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
fail() {
  echo "FAILED: $*" >&2
  ((init == 0)) || inside journalctl --no-pager -n 40 >&2 || true
  exit 1
}
within() {  # seconds, what, command...: true before so many seconds are over
  local left=$((10 * $1)) what="$2"
  shift 2
  until "$@" >/dev/null 2>&1; do
    ((left-- > 0)) || fail "$what"
    sleep 0.1
  done
}

cpack --config "$build/CPackConfig.cmake" -G DEB -B "$scratch/package" >"$scratch/log" 2>&1 || { cat "$scratch/log"; fail "cpack"; }
echo "== a clean Debian, what the package needs, and no package"
mmdebstrap --variant=minbase --include=systemd,systemd-sysv,dbus,iproute2,nginx-light,openssl,ca-certificates \
  --customize-hook="copy-in $scratch/package /root" \
  --customize-hook='chroot "$1" sh -c "apt-get install -y --no-install-recommends /root/package/*.deb && dpkg -P seaway && deluser --quiet seaway && rm -rf /var/lib/seaway"' \
  bookworm "$root" >"$scratch/log" 2>&1 || { tail -5 "$scratch/log"; grep -qE 'Temporary failure|Could not|Unable to (fetch|connect)' "$scratch/log" && skip "no mirror"; fail "mmdebstrap"; }

unshare --mount --pid --fork --uts --ipc --net --cgroup bash "$here/boot_root.sh" "$root" >"$scratch/boot.log" 2>&1 </dev/null &
booted=$!
for ((i = 0; i < 50 && init == 0; ++i)); do sleep 0.1; init="$(pgrep -P "$booted" || echo 0)"; done
((init != 0)) || { cat "$scratch/boot.log"; fail "nothing was booted"; }
within 60 "systemd is not up" inside systemctl is-system-running

active() { [[ "$(inside systemctl is-active seawayd)" == active ]]; }
answers() { inside seaway list; }
samples() { inside seaway show latest | awk '$1 == "samples" {print $2}'; }
more_than() { (("$(samples)" > $1)); }
main_pid() { inside systemctl show -p MainPID --value seawayd; }
enough_restarts() { (("$(inside systemctl show -p NRestarts --value seawayd)" >= 7)); }
another_than() { [[ "$(main_pid)" != "$1" ]] && answers; }

echo "== install"
inside sh -c 'dpkg -i /root/package/*.deb' >"$scratch/log" 2>&1 || { cat "$scratch/log"; fail "dpkg -i"; }
within 30 "the service did not start" answers
[[ "$(inside stat -c '%U %a' /var/lib/seaway)" == "seaway 750" ]] || fail "the data folder"
inside seaway submit /usr/share/seaway/examples/dtmb5415_section_beam_waves.yaml >/dev/null || fail "submit"
within 120 "no sample came" more_than 0

echo "== restart, crash of the server"
inside systemctl restart seawayd
answers || fail "it does not answer after a restart"
kept="$(samples)"
within 120 "it does not go on after a restart" more_than "$kept"
before="$(main_pid)"
inside systemctl kill -s KILL --kill-who=main seawayd
within 30 "systemd did not start it again" another_than "$before"
kept="$(samples)"
within 120 "it does not go on after a crash" more_than "$kept"

echo "== a start that fails: for want of the port as long as it takes, with a wrong configuration once"
inside systemctl stop seawayd
echo 'server { listen 127.0.0.1:7411; }' >"$root/etc/nginx/conf.d/in_the_way.conf"
inside systemctl restart nginx
inside systemctl start --no-block seawayd
within 60 "systemd gave up" enough_restarts
rm "$root/etc/nginx/conf.d/in_the_way.conf"
inside systemctl restart nginx
within 30 "it did not come back by itself" answers
inside sed -i 's/^workers:/wrokers:/' /etc/seaway/seawayd.yaml
! inside systemctl restart seawayd 2>/dev/null || fail "it started with a wrong configuration"
sleep 3
[[ "$(inside systemctl show -p ActiveState --value seawayd)" == failed ]] || fail "a wrong configuration is tried again"
inside journalctl --no-pager -u seawayd | grep -q 'wrokers' || fail "the journal does not name the wrong key"
inside sed -i 's/^wrokers:/workers:/' /etc/seaway/seawayd.yaml
inside systemctl restart seawayd || fail "systemctl restart"
answers || fail "it is called up before it answers"

echo "== through nginx"
inside sh -c 'mkdir -p /etc/ssl/seaway && cd /etc/ssl/seaway && openssl req -x509 -newkey rsa:2048 -nodes -keyout key.pem -out fullchain.pem \
  -days 2 -subj /CN=seaway.example.org -addext subjectAltName=DNS:seaway.example.org 2>/dev/null
  echo "127.0.0.1 localhost seaway.example.org" >/etc/hosts
  cp /usr/share/doc/seaway/examples/nginx.conf /etc/nginx/conf.d/seaway.conf && nginx -t && systemctl restart nginx' >"$scratch/log" 2>&1 ||
  { cat "$scratch/log"; fail "nginx"; }
inside seaway --server seaway.example.org:443 --ca /etc/ssl/seaway/fullchain.pem list | grep -q running || fail "no answer through nginx"

echo "== upgrade"
inside sed -i 's/level: info/level: debug/' /etc/seaway/seawayd.yaml
before="$(main_pid)"
inside sh -c 'dpkg -i /root/package/*.deb' >"$scratch/log" 2>&1 || { cat "$scratch/log"; fail "the upgrade"; }
within 30 "an upgrade did not restart it" another_than "$before"
inside grep -q 'level: debug' /etc/seaway/seawayd.yaml || fail "an upgrade lost a change of the configuration"

echo "== remove, install again, purge"
inside dpkg -r seaway >"$scratch/log" 2>&1 || fail "dpkg -r"
! active || fail "it runs without its package"
inside test -s /var/lib/seaway/seaway.db || fail "the jobs are gone"
inside sh -c 'dpkg -i /root/package/*.deb' >"$scratch/log" 2>&1 || fail "the second install"
within 30 "the service did not start again" answers
inside seaway list | grep -q 'DTMB 5415' || fail "the job is gone after the second install"
inside dpkg -P seaway >"$scratch/log" 2>&1 || fail "dpkg -P"
grep -q "is left with its jobs" "$scratch/log" || fail "nobody is told of the data"
inside test ! -e /etc/seaway || fail "the configuration is left after a purge"
inside test -s /var/lib/seaway/seaway.db || fail "the jobs are gone after a purge"
! inside systemctl list-unit-files | grep -q seawayd || fail "the unit is left"
echo "clean_debian: ok"
