#!/bin/bash
# What shells complete:  bash tests/test_completion.sh ZIPACT SCRATCH
# In bash by calling the function as readline does; scripts for zsh and fish are checked where these shells are installed.
zipact=$1
scratch=$2
passed=0
failed=0
mkdir -p "$scratch/folder" && cd "$scratch" || exit 2
: >mine.yaml
: >mine.txt
source <("$zipact" completion bash)

completes() { # DESCRIPTION WANTED WORD...: completing the last word gives WANTED, or, with "has X", X among others
  local what=$1 wanted=$2
  shift 2
  COMP_WORDS=(zipact "$@")
  COMP_CWORD=$#
  _zipact
  local given=" ${COMPREPLY[*]} "
  if [ "$given" = " $wanted " ] || { [ "${wanted%% *}" = has ] && [[ $given == *" ${wanted#has } "* ]]; }; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $what:$given, not $wanted"
  fi
}

completes "a study" equilibrium equ
completes "all studies and commands" "has limits" ""
completes "a command" completion compl
completes "an option of a study" --no-plots actuate --no
completes "the options of keys" "--yaml --json --quiet --help" keys --
completes "no option that keys does not take" "" keys --set
completes "a key" load.mass= actuate --set load.ma
completes "a key of a group in a group" lower.ribbon.thickness= actuate --set lower.ribbon.thi
completes "a word of a choice" "plates" actuate --set electro.model = pl
completes "all words of a choice" "plates field" actuate --set electro.model =
completes "true and false" "true false" actuate --set output.plots =
completes "no words of a number" "" actuate --set load.mass =
completes "a scenario and folders, no other file" "mine.yaml folder" actuate ""
completes "the file of -o" "has mine.txt" actuate -o mine.
completes "a shell" zsh completion z
completes "a version of FMI" "2 3" fmu --fmi ""

for shell in zsh fish; do
  "$zipact" completion $shell >script.$shell
  command -v $shell >/dev/null || continue
  if $shell -n script.$shell; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $shell refuses its script"
  fi
done
if command -v fish >/dev/null; then # asks as a terminal would
  for pair in "zipact equ=equilibrium" "zipact actuate --set load.ma=load.mass=" "zipact completion z=zsh"; do
    given=$(fish --no-config -c "source script.fish; complete -C '${pair%%=*}'" | cut -f 1)
    if [ "$given" = "${pair#*=}" ]; then passed=$((passed + 1)); else failed=$((failed + 1)) && echo "FAILED: fish: ${pair%%=*}: $given"; fi
  done
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
