# Sourced by who replaces a folder of results whole, at the end or not at all (policy/tables/make, policy/frozen/measure).

# begin_folder FOLDER: makes the folder $work beside it, to put the new one together in $work/new. Both go when the script ends, however it ends, and with them
# the processes that it has begun in groups of their own (in_group).
begin_folder() {
  replaced_folder=$1
  groups=()
  work=$(mktemp -d "$(dirname "$1")/.$(basename "$1").XXXXXX")
  mkdir "$work/new"
  trap end_folder EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
}

# in_group COMMAND...: in the background, with all that it starts, to be ended whole; its number is $!
in_group() {
  set -m
  "$@" </dev/null &
  groups+=($!)
  set +m
}

# put_in_place: what was there goes, and stays until the new one is there
put_in_place() {
  chmod 755 "$work/new"
  [ ! -e "$replaced_folder" ] || mv -T "$replaced_folder" "$work/replaced"
  mv -T "$work/new" "$replaced_folder"
}

end_folder() {
  trap '' INT TERM HUP
  [ ${#groups[@]} -eq 0 ] || { kill -- "${groups[@]/#/-}" 2>/dev/null || true; wait "${groups[@]}" 2>/dev/null || true; }
  [ ! -e "$work/replaced" ] || [ -e "$replaced_folder" ] || mv -T "$work/replaced" "$replaced_folder"
  rm -rf "$work"
}
