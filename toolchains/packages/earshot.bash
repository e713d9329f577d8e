# Completion of "earshot VERB [OPTION...]": verbs from earshot help, options from the verb's --help. (bash-completion loads it at the first Tab.)
_earshot() {
  local word=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)) || { ((COMP_CWORD == 2)) && [[ ${COMP_WORDS[1]} == help ]]; }; then
    mapfile -t COMPREPLY < <(compgen -W "$(earshot help 2>/dev/null | sed -n 's/^  \([a-z][a-z-]*\) .*/\1/p') help --version" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(earshot help "${COMP_WORDS[1]}" 2>/dev/null | sed -nE 's/^  (-[^ ]+( -[^ ]+)?).*/\1/p' | tr , ' ')" -- "$word")
  else
    compopt -o default
  fi
}
complete -F _earshot earshot
