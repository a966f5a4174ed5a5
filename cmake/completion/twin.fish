# Completion of twin's command line for fish: commands and options from its own help, programs, machine files.
function __twin_help_words
    set -l words (commandline -opc)
    set -l command twin
    for word in $words[2..]
        string match -q -- '-*' $word; and break
        set -a command $word
        test $word = rig; or break
    end
    if test $argv[1] = options
        $command --help 2>/dev/null | awk '/^  -/ { split($1, names, ","); for (n in names) print names[n] }'
    else
        $command --help 2>/dev/null | awk '
            /^[A-Z].*:$/ { inside = ($0 !~ /^(Positionals|Options|Examples):$/) }
            inside && /^  [a-z]/ { print $1 }'
    end
end
function __twin_data
    set -l prefix (dirname (dirname (realpath (command -v twin))))
    for file in $prefix/share/twin/$argv[1]/*.$argv[2] *.$argv[2]
        basename $file
    end
end
complete -c twin -f -n 'test (count (commandline -opc)) -eq 1' -a '(__twin_help_words commands)'
complete -c twin -f -n 'test (count (commandline -opc)) -eq 2; and contains rig (commandline -opc)' -a '(__twin_help_words commands)'
complete -c twin -n 'test (count (commandline -opc)) -ge 2' -a '(__twin_data nc_programs nc)'
complete -c twin -n 'string match -q -- "-*" (commandline -ct)' -a '(__twin_help_words options)'
complete -c twin -l machine -x -a '(__twin_data mjcf toml)'
complete -c twin -l hal -x -a 'mujoco ideal rig'
complete -c twin -l trace -x -a 'csv hdf5 both none'
complete -c twin -l also -x -a '(__twin_data nc_programs nc)'
