# Completion of "earshotd MISSION.toml [OPTION...]".
_earshotd() {
  local word=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(earshotd --help 2>/dev/null | sed -nE 's/^  (-[^ ]+( -[^ ]+)?).*/\1/p' | tr , ' ')" -- "$word")
  else
    compopt -o default
  fi
}
complete -F _earshotd earshotd
