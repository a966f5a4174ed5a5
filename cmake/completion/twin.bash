# Completion of twin's command line for bash: commands and options from its own help, programs, machine files.

# Options of a command, of all groups in its help: _twin_options WORD...
_twin_options() {
  "$@" --help 2>/dev/null | awk '/^  -/ { split($1, names, ","); for (n in names) print names[n] }'
}

# Commands below a command, of all groups in its help: _twin_commands WORD...
_twin_commands() {
  "$@" --help 2>/dev/null | awk '
    /^[A-Z].*:$/ { inside = ($0 !~ /^(Positionals|Options|Examples):$/) }
    inside && /^  [a-z]/ { print $1 }'
}

# Files in a folder of the program's data with an ending, and those here: _twin_files FOLDER ENDING WORD
_twin_files() {
  local data
  data=$(dirname "$(dirname "$(readlink -f "$(command -v twin)")")")/share/twin/$1
  compgen -f -X "!*.$2" -- "$3"
  compgen -d -- "$3"
  [[ -d $data ]] && compgen -W "$(cd "$data" && printf '%s ' *."$2")" -- "$3"
}

_twin() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=(twin) i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    [[ ${COMP_WORDS[i]} == -* ]] && break
    command+=("${COMP_WORDS[i]}")
    [[ ${COMP_WORDS[i]} == rig ]] || break
  done
  case $before in
    --machine) mapfile -t COMPREPLY < <(_twin_files mjcf toml "$word") ;;
    --set)
      mapfile -t COMPREPLY < <(compgen -W "$(twin settings --keys 2>/dev/null)" -S = -- "$word")
      compopt -o nospace
      ;;
    --out | --store) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    --hal) mapfile -t COMPREPLY < <(compgen -W "mujoco ideal rig" -- "$word") ;;
    --trace) mapfile -t COMPREPLY < <(compgen -W "csv hdf5 both none" -- "$word") ;;
    --for)
      [[ ${command[*]} == "twin tune" ]] && mapfile -t COMPREPLY < <(compgen -W "error time" -- "$word")
      ;;
    --vary)
      mapfile -t COMPREPLY < <(compgen -W "$(twin settings --keys 2>/dev/null)" -S = -- "$word")
      compopt -o nospace
      ;;
    --also) mapfile -t COMPREPLY < <(_twin_files nc_programs nc "$word") ;;
    *)
      if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_twin_options "${command[@]}")" -- "$word")
      elif ((${#command[@]} == 1)) || [[ ${command[*]} == "twin rig" ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$(_twin_commands "${command[@]}")" -- "$word")
      else
        mapfile -t COMPREPLY < <(_twin_files nc_programs nc "$word")
      fi
      ;;
  esac
}
complete -o filenames -F _twin twin
