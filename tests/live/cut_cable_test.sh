#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# cut_cable_test.sh SUPERVISOR ADIT SHERIFF
# Two computers whose cable is cut and mended: nothing stops, both know what they do not know, and what was
# ordered meanwhile is done. Before that, what the one in charge shows of the other: its state, what its
# processes print, in files too; and that a list is read again on both.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
supervisor=$1; adit=$2; sheriff=$3
. "$here/two_computers.sh"
ask() { local who=$1; shift; "$adit" "$@" --socket "$scratch/$who.sock"; }
await_ps() {
  for _ in $(seq 500); do ask "$1" ps 2>/dev/null | grep -Eq "$2" && return; sleep 0.02; done
  ask "$1" ps; fail "$1 does not show: $2"
}

write_list() {
  cat > "$scratch/list.cfg" <<EOF
cmd "near" { exec = "sh -c 'echo \$LCM_DEFAULT_URL \$ADIT_CONFIG; exec sleep $sleep_s'"; deputy = "robot"; }
cmd "own" { exec = "LCM_DEFAULT_URL=memq:// sh -c 'echo \$LCM_DEFAULT_URL; exec sleep $sleep_s'"; deputy = "robot"; }
cmd "far" { exec = "sh -c 'while :; do echo tick; sleep 0.2; done'"; deputy = "sensors"; depends_on = "near"; }
cmd "late" { exec = "sleep $1"; deputy = "sensors"; auto_respawn = "true"; }
script "go" { start cmd "near" wait "running"; start cmd "own"; start cmd "far" wait "running" timeout_s 20; }
EOF
}
write_list "$sleep_s"
sed -i "s|^supervisor: {|&log_dir: $scratch/logs, |" "$scratch/robot.yaml"
start_robot --lcm-url 'udpm://239.255.76.67:7667?ttl=2'
start_sensors

# Both are seen, and what the one in charge orders is done on the other.
near=$("$sheriff" await robot near running) || fail "near"
far=$("$sheriff" await sensors far running) || fail "far"
ask robot start late || fail "adit start late"
late=$("$sheriff" await sensors late running) || fail "late"

# What the others print is shown here, and what one's own print is in files.
for _ in $(seq 100); do ask robot logs far | grep -q tick && break; sleep 0.02; done
ask robot logs far | grep -q '^tick$' || fail "adit logs of another computer"
url="udpm://239.255.76.67:7667?ttl=2 $scratch/robot.yaml"
[[ $(ask robot logs near) == "$url" ]] || fail "near was told: $(ask robot logs near)"
[[ $(ask robot logs own) == "memq://" ]] || fail "own was told: $(ask robot logs own)"
grep -qF "Z $url" "$scratch/logs/near.log" || fail "no file of near"

# The list of each is its own: where it is read again, what has changed is restarted, and a bad one is refused.
write_list "$sleep_s 0"
[[ $(ask sensors reload) == "changed: late" ]] || fail "reload"
changed=$late
for _ in $(seq 20); do
  [[ $changed != "$late" ]] && break
  changed=$("$sheriff" await sensors late running)
done
[[ $changed != "$late" ]] || fail "late is not restarted"
echo 'cmd "near" { ' > "$scratch/list.cfg"
ask robot reload 2>"$scratch/refused" && fail "a bad list was taken"
grep -q "list.cfg:.*the old process list stays" "$scratch/refused" || fail "$(cat "$scratch/refused")"
kill -HUP "$robot"
for _ in $(seq 100); do grep -q "the old process list stays" "$scratch/robot.err" && break; sleep 0.02; done
[[ $(grep -c "the old process list stays" "$scratch/robot.err") == 1 ]] || fail "no word after SIGHUP"
write_list "$sleep_s 0"
[[ $(ask robot reload) == "changed: late" ]] || fail "reload of the one in charge"

# Five seconds after the cable is cut, each knows that it does not know, and nobody stops.
nsenter -t "$other" -n ip link set cable1 down
await_ps robot '^far .*unknown'
await_ps sensors '^near .*unknown'
ask sensors ps | grep -Eq '^far .*running' || fail "far has stopped"
ask robot ps | grep -Eq '^near .*running' || fail "near has stopped"
"$sheriff" await robot near running >/dev/null || fail "a computer without a carrier does not hear itself"
ask robot stop late || fail "adit stop late"
kill -0 "$near" "$far" "$changed" || fail "somebody has stopped"

# When it is mended, what was ordered meanwhile is done, and the rest was never touched.
nsenter -t "$other" -n bash -c 'ip link set cable1 up && ip route add 224.0.0.0/4 dev cable1'
"$sheriff" await sensors late stopped >/dev/null || fail "late was not stopped"
await_ps robot '^far .*running'
[[ $("$sheriff" await robot near running) == "$near" ]] || fail "near was restarted"
[[ $("$sheriff" await sensors far running) == "$far" ]] || fail "far was restarted"

# What depends on others goes first, on whichever computer.
ask robot stop --all || fail "adit stop --all"
"$sheriff" await robot near stopped >/dev/null || fail "near does not stop"
ask sensors ps | grep -Eq '^far .*stopped' || fail "near was stopped before far"
kill -TERM "$robot" "$sensors"
wait "$robot" || fail "the one in charge ended with $?"
wait "$sensors" || fail "the other ended with $?"
