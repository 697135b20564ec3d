#!/usr/bin/env bash
# The Debian package: built from this build, installed with dpkg into an empty root, served from there, removed, purged.
#   package_test.sh BUILD_FOLDER
set -euo pipefail
build="$1"
scratch="$(mktemp -d)"
server=0
clean_up() {
  ((server == 0)) || kill -KILL "$server" 2>/dev/null || true
  rm -rf "$scratch"
}
trap clean_up EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

cpack --config "$build/CPackConfig.cmake" -G DEB -B "$scratch/package" >"$scratch/cpack.log" 2>&1 || { cat "$scratch/cpack.log"; fail "cpack"; }
package="$(echo "$scratch"/package/seaway_*.deb)"

echo "== what it says of itself"
[[ "$(dpkg-deb -f "$package" Package)" == seaway ]] || fail "its name"
depends="$(dpkg-deb -f "$package" Depends)"
for library in adduser libgrpc++1.51 libsqlite3-0 libp4est-2.2; do [[ "$depends" == *"$library"* ]] || fail "depends on no $library: $depends"; done
[[ "$(dpkg-deb --ctrl-tarfile "$package" | tar -xO ./conffiles)" == /etc/seaway/seawayd.yaml ]] || fail "conffiles"
for script in postinst prerm postrm; do dpkg-deb --ctrl-tarfile "$package" | tar -xO "./$script" | sh -n || fail "$script"; done
! dpkg-deb -c "$package" | grep -E ' \./(var|usr/local|root|home|tmp)' || fail "it owns what it should not"
! dpkg-deb -c "$package" | grep -v ' root/root ' || fail "owners"

echo "== install"
root="$scratch/root"
mkdir -p "$root/var/lib/dpkg/info" "$root/var/lib/dpkg/updates" "$root/var/log"
: >"$root/var/lib/dpkg/status"
in_root() { dpkg --root="$root" --log="$scratch/dpkg.log" --force-depends --force-not-root --force-script-chrootless "$@" >>"$scratch/out.log" 2>&1 || { cat "$scratch/out.log"; fail "dpkg $*"; }; }
in_root --install "$package"
for file in usr/bin/seawayd usr/bin/seaway-run usr/bin/seaway etc/seaway/seawayd.yaml lib/systemd/system/seawayd.service \
            usr/share/doc/seaway/copyright usr/share/doc/seaway/examples/nginx.conf usr/share/seaway/python/seaway/v1/job_service_pb2.py; do
  [[ -s "$root/$file" ]] || fail "$file is missing"
done
[[ "$(stat -c %a "$root/var/lib/seaway")" == 750 ]] || fail "the data folder is open to others"
if command -v systemd-analyze >/dev/null; then
  sed "s|=/usr/bin/|=$root/usr/bin/|" "$root/lib/systemd/system/seawayd.service" >"$scratch/seawayd.service"
  systemd-analyze verify --man=no "$scratch/seawayd.service" 2>"$scratch/unit.log" || true
  ! grep -F seawayd.service "$scratch/unit.log" || fail "the unit"
fi

echo "== serve from there, as the unit does"
sed -e "s|/var/lib/seaway|$root/var/lib/seaway|" -e "s|/usr/bin/|$root/usr/bin/|" "$root/etc/seaway/seawayd.yaml" >"$scratch/config.yaml"
start() {
  rm -f "$scratch/address"
  "$root/usr/bin/seawayd" --config "$scratch/config.yaml" --port 0 --address-file "$scratch/address" 2>>"$scratch/server.log" &
  server=$!
  for ((i = 0; i < 300; ++i)); do
    [[ -s "$scratch/address" ]] && break
    kill -0 "$server" 2>/dev/null || { cat "$scratch/server.log"; fail "the server ended"; }
    sleep 0.1
  done
  SEAWAY_SERVER="$(cat "$scratch/address")" && export SEAWAY_SERVER
}
stop() {
  kill -TERM "$server"
  wait "$server" || fail "the server did not end well"
  server=0
}
seaway() { "$root/usr/bin/seaway" "$@"; }
start
seaway server | grep -q process || fail "the executor"
for example in "$root"/usr/share/seaway/examples/*.yaml; do seaway validate "$example" >/dev/null || fail "$example"; done
seaway submit "$root/usr/share/seaway/examples/dtmb5415_section_beam_waves.yaml" >/dev/null
for ((i = 0; i < 300; ++i)); do
  seaway show | grep -qE '^samples +[1-9]' && break
  ((i < 299)) || fail "no sample came: $(seaway show)"
  sleep 0.1
done
seaway kill latest >/dev/null
stop

echo "== remove and purge"
in_root --remove seaway
[[ ! -e "$root/usr/bin/seawayd" ]] || fail "the programs are left"
[[ -s "$root/etc/seaway/seawayd.yaml" ]] || fail "the configuration is gone"
[[ -s "$root/var/lib/seaway/seaway.db" ]] || fail "the jobs are gone"
in_root --install "$package"
start
seaway list | grep -qi cancelled || fail "the job is gone after the second install"
stop
in_root --purge seaway
[[ ! -e "$root/etc/seaway" ]] || fail "the configuration is left after a purge"
[[ -s "$root/var/lib/seaway/seaway.db" ]] || fail "the jobs are gone after a purge"
grep -q "is left with its jobs" "$scratch/out.log" || fail "nobody is told of the data"
echo "package: ok"
