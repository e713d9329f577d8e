# Completion of "earshot VERB [SUBCOMMAND] [OPTION [VALUE]...]", all from what earshot help and --help say. (bash-completion loads it at the first Tab.)

# The lines "  NAME  what it is" below a heading of --help.
_earshot_names_below() { sed -n "/^$1/,/^\$/s/^  \([a-z][a-z_-]*\) .*/\1/p"; }

# The values of an option: {a,b} in --help, or names that a list of the verb has.
_earshot_values() {
  local verb=$1 option=$2 help=$3
  case $verb:$option in
    evaluate:--policies) _earshot_names_below 'By name:' <<<"$help" ;;
    hil:--case) earshot hil --list 2>/dev/null | sed 's/ .*//' ;;
    *) sed -nE "s/^ +(-[^ ]+,)?${option} [^{]*\{([^}]*)\}.*/\2/p" <<<"$help" | tr , '\n' ;;
  esac
}

_earshot() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]} help values subcommands verbs=() i begin=''
  COMPREPLY=()
  if ((COMP_CWORD == 1)) || { ((COMP_CWORD == 2)) && [[ $verb == help ]]; }; then
    # Of all verbs those that are installed.
    for i in $(earshot help 2>/dev/null | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p'); do
      ! command -v "earshot-$i" >/dev/null || verbs+=("$i")
    done
    mapfile -t COMPREPLY < <(compgen -W "${verbs[*]} help --version" -- "$word")
    return
  fi
  help=$(earshot help "$verb" 2>/dev/null)
  subcommands=$(_earshot_names_below Subcommands: <<<"$help")
  if [[ -n $subcommands ]] && ((COMP_CWORD > 2)) && grep -qx -- "${COMP_WORDS[2]}" <<<"$subcommands"; then
    help=$(earshot "$verb" "${COMP_WORDS[2]}" --help 2>/dev/null)
    subcommands=''
  fi
  # An option that takes several values: hil --case one two.
  for ((i = COMP_CWORD - 1; i > 1; --i)); do
    [[ ${COMP_WORDS[i]} != -* ]] || break
  done
  [[ $verb != hil || ${COMP_WORDS[i]} != --case ]] || before=--case
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -nE 's/^  (-[^ ]+( -[^ ]+)?).*/\1/p' <<<"$help" | tr , ' ')" -- "$word")
  elif [[ $before == -* ]] && values=$(_earshot_values "$verb" "$before" "$help") && [[ -n $values ]]; then
    # Of names between commas the last is written.
    [[ $before != --policies || $word != *,* ]] || begin=${word%,*},
    mapfile -t COMPREPLY < <(compgen -P "$begin" -W "$values" -- "${word#"$begin"}")
  elif [[ -n $subcommands ]] && ((COMP_CWORD == 2)); then
    mapfile -t COMPREPLY < <(compgen -W "$subcommands" -- "$word")
  fi
  # Else a file.
  ((${#COMPREPLY[@]} > 0)) || compopt -o default 2>/dev/null
}
complete -F _earshot earshot
