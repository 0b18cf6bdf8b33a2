#!/bin/bash
# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# link_loss_test.sh SUPERVISOR ADIT SHERIFF
# Two computers lose the link between them: no process stops, both supervisors report the state of the other
# computer as unknown, and orders are executed after the link is restored. Before that: the supervisor in charge
# shows state and output of the processes of the other computer, also in files, and both reload their lists.
set -u
here=$(dirname "$(readlink -f "$0")")

if [[ ${ADIT_PRIVATE_NETWORK:-} != yes ]]; then
  ADIT_PRIVATE_NETWORK=yes exec "$here/in_private_network.sh" "$0" "$@"
fi
supervisor=$1; adit=$2; sheriff=$3
. "$here/two_computers.sh"
kListError="; the [a-z]+ process list stays"   # the reason precedes it
on() { local computer=$1; shift; "$adit" "$@" --socket "$scratch/$computer.sock"; }
await_ps() {
  for _ in $(seq 500); do on "$1" ps 2>/dev/null | grep -Eq "$2" && return; sleep 0.02; done
  on "$1" ps; fail "$1 does not show: $2"
}

write_list() {
  cat > "$scratch/list.cfg" <<EOF
cmd "near" { exec = "sh -c 'echo \$LCM_DEFAULT_URL \$ADIT_CONFIG; exec sleep $sleep_s'"; deputy = "robot"; }
cmd "own" { exec = "LCM_DEFAULT_URL=memq:// sh -c 'echo \$LCM_DEFAULT_URL; exec sleep $sleep_s'"; deputy = "robot"; }
cmd "far" { exec = "sh -c 'while :; do echo tick; sleep 0.2; done'"; deputy = "sensors"; depends_on = "near"; }
cmd "late" { exec = "sleep $1"; deputy = "sensors"; auto_respawn = "true"; }
script "start_all" { start cmd "near" wait "running"; start cmd "own"; start cmd "far" wait "running" timeout_s 20; }
EOF
}
write_list "$sleep_s"
sed -i "s|^supervisor: {|&log_dir: $scratch/logs, |" "$scratch/robot.yaml"
start_robot --lcm-url 'udpm://239.255.76.67:7667?ttl=2'
start_sensors

# The supervisor in charge starts processes on both computers.
near=$("$sheriff" await robot near running) || fail "near"
far=$("$sheriff" await sensors far running) || fail "far"
on robot start late || fail "adit start late"
late=$("$sheriff" await sensors late running) || fail "late"

# Output of the other computer is available here; output of local processes is in files.
for _ in $(seq 100); do on robot logs far | grep -q tick && break; sleep 0.02; done
on robot logs far | grep -q '^tick$' || fail "adit logs of another computer"
url="udpm://239.255.76.67:7667?ttl=2 $scratch/robot.yaml"
[[ $(on robot logs near) == "$url" ]] || fail "environment of near: $(on robot logs near)"
[[ $(on robot logs own) == "memq://" ]] || fail "environment of own: $(on robot logs own)"
grep -qF "Z $url" "$scratch/logs/near.log" || fail "no file of near"

# Each computer reloads its own list: changed processes restart, and an invalid list is rejected.
write_list "$sleep_s 0"
[[ $(on sensors reload) == "changed: late" ]] || fail "reload"
changed=$late
for _ in $(seq 20); do
  [[ $changed != "$late" ]] && break
  changed=$("$sheriff" await sensors late running)
done
[[ $changed != "$late" ]] || fail "late did not restart"
echo 'cmd "near" { ' > "$scratch/list.cfg"
on robot reload 2>"$scratch/rejected" && fail "an invalid list was accepted"
grep -Eq "list.cfg:.*$kListError" "$scratch/rejected" || fail "$(cat "$scratch/rejected")"
kill -HUP "$robot"
for _ in $(seq 100); do grep -Eq "$kListError" "$scratch/robot.err" && break; sleep 0.02; done
[[ $(grep -Ec "$kListError" "$scratch/robot.err") == 1 ]] || fail "no error message after SIGHUP"
write_list "$sleep_s 0"
[[ $(on robot reload) == "changed: late" ]] || fail "reload on the computer in charge"

# Five seconds after the link loss, both report the remote state as unknown, and all processes run.
nsenter -t "$other" -n ip link set link1 down
await_ps robot '^far .*unknown'
await_ps sensors '^near .*unknown'
on sensors ps | grep -Eq '^far .*running' || fail "far has stopped"
on robot ps | grep -Eq '^near .*running' || fail "near has stopped"
"$sheriff" await robot near running >/dev/null || fail "a computer without carrier does not receive its own messages"
on robot stop late || fail "adit stop late"
kill -0 "$near" "$far" "$changed" || fail "a process has stopped"

# After the link is restored, the pending order is executed, and no other process is restarted.
nsenter -t "$other" -n bash -c 'ip link set link1 up && ip route add 224.0.0.0/4 dev link1'
"$sheriff" await sensors late stopped >/dev/null || fail "late was not stopped"
await_ps robot '^far .*running'
[[ $("$sheriff" await robot near running) == "$near" ]] || fail "near was restarted"
[[ $("$sheriff" await sensors far running) == "$far" ]] || fail "far was restarted"

# Dependent processes stop first, also across computers.
on robot stop --all || fail "adit stop --all"
"$sheriff" await robot near stopped >/dev/null || fail "near does not stop"
on sensors ps | grep -Eq '^far .*stopped' || fail "near was stopped before far"
kill -TERM "$robot" "$sensors"
wait "$robot" || fail "the supervisor in charge exited with $?"
wait "$sensors" || fail "the other supervisor exited with $?"
