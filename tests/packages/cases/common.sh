# What the cases share. A case is a script in a minimal Debian 12 with the packages in /packages, and the same as version 99.0.0 in /newer.

fail() { echo "$*" >&2; exit 1; }

# Newest file names first would do for dpkg, too: it sorts out who needs whom.
install_from() { dpkg -i "$1"/earshot_*.deb "$1"/earshot-sil_*.deb "$1"/earshot-tools_*.deb "$1"/earshot-hil_*.deb; }

# What stands on this machine, in MB, without what apt fetched to install it. Not df, for other machines are on the same disk.
disk_mb() { du -xsm --exclude=/var/lib/apt/lists --exclude=/var/cache --exclude=/packages --exclude=/newer / | cut -f 1; }

# "1.2.3 installed"; "half-installed" and others where dpkg was stopped in the middle.
version_of() { dpkg-query -W -f '${Version} ${db:Status-Status}' "$1"; }
version_in() { dpkg-deb -f "$1"/earshot_*.deb Version; }

# All files but those that change by themselves, with the users.
all_files() {
  find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /tmp -o -path /run -o -path /var/lib/dpkg -o -path /var/cache -o -path /var/log \
    -o -path /var/lib/apt -o -path /etc/passwd- -o -path /etc/group- -o -path /etc/shadow- -o -path /etc/gshadow- -o -path /etc/subuid- -o -path /etc/subgid- \) -prune -o -print | sort
  cut -d : -f 1 /etc/passwd /etc/group | sort
}

# What an operator has: a mission changed, one of his own, a key, a journal.
write_own_files() {
  sed -i 's/^max_steps = 100 /max_steps = 60  /' /etc/earshot/missions/search.toml
  cp /usr/share/earshot/firmware/boards/linux/missions/fixed_source.toml /etc/earshot/missions/mine.toml
  printf secret >/etc/earshot/ops.key
  mkdir -p /var/lib/earshot/mine && echo journal >/var/lib/earshot/mine/journal.lcmlog
}
expect_own_files() {
  grep -q '^max_steps = 60  ' /etc/earshot/missions/search.toml || fail "the operator's change of a mission is gone"
  [ -s /etc/earshot/missions/mine.toml ] || fail "the operator's mission is gone"
  [ "$(cat /etc/earshot/ops.key)" = secret ] || fail "the operator's key is gone"
  [ "$(cat /var/lib/earshot/mine/journal.lcmlog)" = journal ] || fail "the journal is gone"
}

# A mission that waits for START, as the service flies it, without a service manager; or one that was killed goes on.
standbys() { cat /tmp/mission.log 2>/dev/null | grep -c 'UTC: STANDBY$' || true; }
start_mission() {
  before=$(standbys)
  start-stop-daemon --start --background --make-pidfile --pidfile /run/mission.pid --output /tmp/mission.log --chuid earshot --startas /usr/bin/earshotd -- \
    /etc/earshot/missions/search.toml --out /var/lib/earshot/search --resume
  i=0
  until [ "$(standbys)" -gt "$before" ]; do
    i=$((i + 1))
    [ $i -lt 1200 ] || fail "the mission does not start: $(cat /tmp/mission.log)"
    sleep 0.1
  done
}
end_mission() { start-stop-daemon --stop --retry TERM/30 --pidfile /run/mission.pid; }
