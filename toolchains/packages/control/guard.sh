# refuse_under_a_mission WHAT: says why nothing is replaced or removed, and ends, while a mission runs: its program, also where the file was replaced under it,
# or a unit that systemd is about to start again.
refuse() {
  echo "earshot: a mission is running ($1): no package of Earshot is $2 meanwhile; mission and packages stay as they are. End the mission, then try again: systemctl stop 'earshotd@*', or, where no systemd runs, stop it at its supervisor, or kill -TERM its process. A search under way ends in ABORT: the vehicle comes up." >&2
  exit 1
}
refuse_under_a_mission() {
  program=/usr/bin/earshotd
  for process in /proc/[0-9]*; do
    case $(readlink "$process/exe" 2>/dev/null) in
      "$program" | "$program (deleted)") [ "$process/root" -ef / ] || continue ;;
      *) [ "$process/exe" -ef "$program" ] || continue ;;
    esac
    # Whoever started it chose its words: what a terminal would obey is left out.
    words=$(tr '\0' ' ' <"$process/cmdline" 2>/dev/null | LC_ALL=C tr -c '[:print:]' '?' || true)
    refuse "process ${process#/proc/} of $(stat -c %U "$process" 2>/dev/null || echo nobody): $words" "$1"
  done
  if [ -d /run/systemd/system ]; then
    unit=$(systemctl list-units --plain --no-legend --state=active,activating,reloading,deactivating 'earshotd@*' 2>/dev/null | head -n 1 | cut -d ' ' -f 1)
    [ -z "$unit" ] || refuse "$unit" "$1"
  fi
}
