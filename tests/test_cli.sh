#!/bin/sh
# shellcheck disable=SC2086 # $short and $long are lists of words
# The command from outside:  sh tests/test_cli.sh ZIPACT SCRATCH
#
# What users and scripts rely on: words, exit statuses, what goes to which stream, which files are written and
# when, that the same input gives the same bytes. Each exit status by a real case. Runs are short (few nodes,
# little time) and, where pictures do not matter, without gnuplot on PATH.
# Needs python3 to read JSON. Last line: "N passed, N failed"; exit status 1 if any failed.

zipact=$1
scratch=$2
if [ ! -x "$zipact" ] || [ -z "$scratch" ]; then
  echo "usage: sh test_cli.sh ZIPACT SCRATCH"
  exit 2
fi
case $zipact in /*) ;; *) zipact=$PWD/$zipact ;; esac
repository=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$scratch" && cd "$scratch" || exit 2
rm -rf cli-test && mkdir cli-test && cd cli-test || exit 2

passed=0
failed=0
short="--set mesh.nodes=5 --set solver.tolerance=0.1 --set solver.end_time=1ms --set output.samples=20 --set output.shapes=3"

ok() { # DESCRIPTION COMMAND...: passes if the command succeeds
  what=$1
  shift
  if "$@"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $what"
    [ -s stderr ] && sed 's/^/    stderr: /' stderr | head -5
  fi
}

zp() { # run without gnuplot; its streams to the files stdout and stderr, status to $status
  PATH=/nowhere "$zipact" "$@" >stdout 2>stderr
  status=$?
}

zp_drawing() { # the same with what PATH has
  "$zipact" "$@" >stdout 2>stderr
  status=$?
}

status_is() { [ "$status" -eq "$1" ] || { echo "    status $status, not $1"; false; }; }
ends() { # STATUS DESCRIPTION WORDS...: the command of these words ends with that status
  expected=$1 title=$2
  shift 2
  zp "$@"
  ok "$title" status_is "$expected"
}
says() { grep -q -e "$1" stderr || { echo "    stderr does not have: $1"; false; }; }
prints() { grep -q -e "$1" stdout || { echo "    stdout does not have: $1"; false; }; }
is_empty() { [ ! -s "$1" ]; }
is_file() { [ -f "$1" ]; }
is_absent() { [ ! -e "$1" ]; }
no_temporaries() { [ -z "$(find "$1" -name '*.tmp' -o -name '.zipact-lock')" ]; }

python=$(command -v python3)
cat >is_json.py <<'END'
"""is_json.py FILE EXPRESSION: FILE holds exactly one JSON object or array, d, for which EXPRESSION is true."""
import json, sys

def refuse(word):
    raise ValueError("not JSON: " + word)

def no_twins(pairs):
    d = dict(pairs)
    if len(d) != len(pairs):
        raise ValueError("a name twice")
    return d

try:
    with open(sys.argv[1], encoding="utf-8") as file:
        d = json.loads(file.read(), parse_constant=refuse, object_pairs_hook=no_twins)
    good = eval(sys.argv[2])
except (OSError, ValueError, LookupError) as error:
    sys.exit("    %s: %s: %s" % (sys.argv[1], type(error).__name__, error))
if not good:
    sys.exit("    not true of %s: %s" % tuple(sys.argv[1:3]))
END
json() { "$python" is_json.py "$1" "$2"; }

complete() { # DIR: every file of a report is there and whole
  is_file "$1/scenario.yaml" && json "$1/summary.json" '"outcome" in d' && is_file "$1/table.csv" &&
    [ "$(head -c 4 "$1/results.h5" | tail -c 3)" = HDF ] && no_temporaries "$1" &&
    [ "$(awk -F, 'NR == 1 { n = NF } NF != n { bad = 1 } END { print bad + 0 }' "$1/table.csv")" = 0 ]
}

# -- words ---------------------------------------------------------------------------------------------

ends 0 "--version" --version
ok "--version prints name and number" grep -Eqx 'zipact [0-9]+\.[0-9]+\.[0-9]+' stdout
for help in --help -h help; do
  ends 0 "$help" $help
  ok "$help names the studies" prints actuate
  ok "$help goes to stdout only" is_empty stderr
done
for study in actuate run; do
  ends 0 "$study --help" $study --help
  ok "$study --help names --set" prints '--set KEY=VALUE'
done
zp help limits
ok "help STUDY" prints '^zipact limits '
ends 0 "keys --help" keys --help
ok "keys --help names its options" prints '^zipact keys \[--yaml\] \[--json\]'
ok "keys --help names no others" [ "$(grep -c -e '--set' stdout)" -eq 0 ]
zp fmu --help
ok "fmu --help: a letter for -o and -h only" [ "$(grep -c -E '^  -[a-z], --' stdout)" -eq 2 ]
ok "fmu --help: --set has none" prints '^  --set KEY=VALUE'

ends 0 "keys" keys
ok "keys has load.mass with its default" prints '^load\.mass .*8 g'
ends 0 "keys --json" keys --json
ok "keys --json is a list of whole entries" json stdout \
  'len(d) > 40 and all(set(k) == {"key", "type", "unit", "default", "min", "max", "choices", "help"} for k in d)'
ok "keys --json is in SI" json stdout '[k["default"] for k in d if k["key"] == "load.mass"] == [0.008]'
ends 0 "keys --yaml" keys --yaml
cp stdout starter.yaml
ends 0 "the starter scenario runs" run starter.yaml $short -o starter
ends 0 "defaults run" actuate $short -o defaults
ok "the starter scenario is the defaults" cmp -s starter/scenario.yaml defaults/scenario.yaml
ok "the starter scenario gives the table of the defaults" cmp -s starter/table.csv defaults/table.csv

mkdir manual
ends 0 "man" man -o manual
ok "man: a page for each study and command, and one for all" [ "$(ls manual/*.1 | wc -l)" -eq $((1 + $("$zipact" --help | grep -c -E '^  [a-z]'))) ]
ok "man: a page has what --help has" grep -q 'print a scenario with all keys' manual/zipact-keys.1
ok "man: what is bold ends" [ "$(cat manual/*.1 | grep -o '\\fB' | wc -l)" -eq "$(cat manual/*.1 | grep -o '\\fR' | wc -l)" ]
ok "man: a page refers to the others, not to itself" [ "$(grep -c -F 'zipact\-keys (1)' manual/zipact-keys.1)" -eq 0 -a "$(grep -c -F 'zipact\-keys (1)' manual/zipact-run.1)" -eq 1 ]
ends 3 "3: man: no such folder" man -o a/b/c
ok "3: man: says where" says 'a/b/c/zipact\.1'
if command -v groff >/dev/null; then
  ok "man: groff has no warnings" [ -z "$(for page in manual/*.1; do groff -man -ww -Tutf8 "$page" 2>&1 >/dev/null; done)" ]
fi

readme=$(sed -n 's|^    build/zipact \(.*[^ ]\)  *#.*|\1|p' "$repository/README.md")
eval "zp $readme"
ok "the command of the README runs" status_is 0
ok "and says what the README asks" prints '^  pull-in  *[0-9.]* kV'

# -- the default run, with pictures ------------------------------------------------------------------------

zp_drawing actuate --json
ok "actuate" status_is 0
ok "it zips" json stdout 'd["outcome"] == "zipped" and d["contraction"] >= 0.99'
ok "with its bead later than dry, 76 ms, and sooner than in a bath, 190 ms" json stdout '0.08 < d["zip_time_s"] < 0.18'
ok "its energy balances" json stdout '0 <= d["energy_error"] < 1e-3'
ok "results go to out/actuate unless told" complete out/actuate
ok "--json prints what summary.json holds" cmp -s stdout out/actuate/summary.json
frames=$(find out/actuate/shapes -name '*.vtp' | wc -l)
ok "one .vtp per shape in shapes.pvd" [ "$frames" -eq "$(grep -c '<DataSet' out/actuate/shapes.pvd)" ]
if command -v gnuplot >/dev/null; then
  ok "a picture of the stroke" grep -q '</svg>' out/actuate/plots/stroke.svg
fi

# -- status 0 to 3 -----------------------------------------------------------------------------------------

ends 0 "0: it never zips, which is an answer" actuate $short --set drive.voltage=0 --json -o never
ok "0: outcome end_time, zip time null" json stdout 'd["outcome"] == "end_time" and d["zip_time_s"] is None'

# a limp chain has no stiffness when straight, so it is settled by steps
zp actuate --set ribbon.model=mass_spring --set mass_spring.shear_coefficient=0 --set solver.max_steps=1000 \
  --json -o not-settled
ok "1: no equilibrium within max_steps" status_is 1
ok "1: --json prints all the same" json stdout 'd["outcome"] == "not_settled" and "1000" in d["message"]'
ok "1: what was reached is kept" complete not-settled
ends 1 "1: too many steps" actuate $short --set solver.time_step=1e-9 --set solver.end_time=10 --set solver.max_steps=10000 --json -o limited
ok "1: outcome step_limit" json stdout 'd["outcome"] == "step_limit" and d["steps"] == 10000'
ok "1: the rows until then are kept" [ "$(wc -l <limited/table.csv)" -gt 2 ]
chain="--set ribbon.model=mass_spring --set electro.force_scale=1000 --set electro.breakdown_cap=false"
ends 1 "1: diverged" actuate $short $chain --set drive.voltage=1MV --json -o diverged
ok "1: outcome diverged" json stdout 'd["outcome"] == "diverged"'
ok "1: its files are whole" complete diverged
ends 1 "1: one bad row of a sweep" actuate $short $chain --set "drive.voltage=[0, 1 MV]" --json -o one-bad
ok "1: both rows are there" json stdout '[r["outcome"] for r in d["rows"]] == ["end_time", "diverged"]'

refused() { # DESCRIPTION PATTERN ARGUMENT...: wrong input, said why, nothing written
  what=$1
  pattern=$2
  shift 2
  rm -rf refused out/actuate
  ends 2 "2: $what" "$@"
  ok "2: $what: message" says "$pattern"
  ok "2: $what: nothing on stdout" is_empty stdout
  ok "2: $what: one line" [ "$(wc -l <stderr)" -le 2 ]
  ok "2: $what: nothing written" is_absent refused
  ok "2: $what: nothing written to out/" is_absent out/actuate
}

refused "no command" 'missing'
refused "unknown study" 'unknown study.*fly; see zipact --help' fly -o refused
refused "unknown option" 'frobnicate' actuate --frobnicate -o refused
refused "--set without a value" 'argument' actuate -o refused --set
refused "two scenarios" 'defaults' actuate starter.yaml defaults/scenario.yaml -o refused
refused "run without a scenario" 'scenario' run -o refused
refused "keys with a scenario" 'keys' keys starter.yaml
refused "keys with -o" 'keys' keys -o refused
refused "keys twice" 'not both' keys --json --yaml
refused "--yaml of a study" 'yaml' actuate --yaml -o refused
refused "bench with --set" 'bench does not take --set' bench --set load.mass=1
refused "bench with -o" 'bench does not take -o' bench -o refused
refused "reproduce with a scenario" 'reproduce does not take a scenario' reproduce starter.yaml -o refused
refused "reproduce with --set" 'reproduce does not take --set' reproduce --set load.mass=1 -o refused
refused "a misspelt study" 'equilibrum; did you mean equilibrium' equilibrum -o refused
refused "a misspelt command" 'reprodcue; did you mean reproduce' reprodcue -o refused
refused "a key without --set" 'load\.mass=8g: .* --set "load\.mass=8g"' actuate load.mass=8g -o refused
refused "a key without --set, behind a scenario" '--set "load\.mass=8g"' actuate starter.yaml load.mass=8g -o refused
refused "a key in place of the study" 'load\.mass=8g: to set a key write zipact STUDY --set "load\.mass=8g"' load.mass=8g
refused "a key as an option" 'load\.mass=8g: to set a key write --set "load\.mass=8g"' actuate --load.mass=8g -o refused
refused "a key as an option, and its value" 'load\.mass: .* --set "load\.mass=VALUE"' actuate --load.mass 8g -o refused
refused "an option in place of the study" 'a study or command comes before --set' --set load.mass=8g actuate -o refused
refused "a scenario in place of the study" 'starter\.yaml: to run a scenario write zipact run starter\.yaml' starter.yaml
refused "what is not modelled" 'temperature is not modelled; give .*medium\.kinematic_viscosity' actuate --set medium.temperature=300 -o refused
refused "man without a folder" 'DIR' man
refused "completion without a shell" 'bash, zsh or fish' completion
refused "completion of no shell" 'unknown shell tcsh' completion tcsh
refused "a misspelt option" 'unknown option --no-plotz; did you mean --no-plots' limits --no-plotz -o refused
refused "an unknown option" 'unknown option -x; see zipact limits --help' limits -x -o refused
refused "an option without its argument" 'missing argument of --set; see zipact limits --help' limits -o refused --set
refused "--resume of one case" 'the scenario has no list of values' stationary --resume -o refused
refused "fmu without a file" 'FILE\.fmu' fmu
refused "missing file" 'absent.yaml.*No such file' run absent.yaml -o refused
refused "no =" 'KEY=VALUE' actuate --set load.mass -o refused
refused "empty value" 'load\.mass.*give a value' actuate --set load.mass= -o refused
refused "unknown key, nearest named" 'load\.mas.*did you mean load\.mass' actuate --set load.mas=8g -o refused
refused "unknown group" 'lod\.mass.*did you mean load\.mass' actuate --set lod.mass=8g -o refused
refused "unknown unit" 'load\.mass.*stone.*in g from 0 g to 1000000 g' actuate --set 'load.mass=1 stonez' -o refused
refused "wrong dimension" 'load\.mass.*mm.*in g from 0 g' actuate --set 'load.mass=1 mm' -o refused
refused "out of range" 'mesh\.nodes=3.*4 to 2001' actuate --set mesh.nodes=3 -o refused
refused "out of range, in people'\''s unit" 'ribbon\.thickness.*1 um to 5000 um' actuate --set 'ribbon.thickness=6 mm' -o refused
refused "a bare number out of range" 'ribbon\.thickness=5: taken as 5 m, which is out of range; 1 um to 5000 um' actuate --set ribbon.thickness=5 -o refused
refused "no number" 'load\.mass.*not a number' actuate --set load.mass=heavy -o refused
refused "NaN" 'load\.mass.*not a number' actuate --set load.mass=nan -o refused
refused "no whole number" 'mesh\.nodes.*whole number' actuate --set mesh.nodes=5.5 -o refused
refused "wrong word, nearest named" 'contact\.model.*did you mean sequential' actuate --set contact.model=sequentail -o refused
refused "keys that contradict" 'platform\.length.*ribbon\.length' actuate --set 'platform.length=95 mm' -o refused
refused "incomplete preset" 'damping\.drag.*paper-text.*33' actuate --set preset=paper-text --set mesh.nodes=33 -o refused
refused "one bad row of a sweep" 'platform\.length' actuate --set 'platform.length=[1 mm, 95 mm]' -o refused

printf 'load_g,stroke_mm\n4,6.1\n8,11.2\n' >aligned.csv
zp calibrate --set data.file=aligned.csv --set calibrate.fit=ribbon.young_modulus --set mesh.nodes=11 -o aligned
ok "fitted keys are aligned with other numbers" [ "$(grep -c -E '^  .{39} (GPa|mm)' stdout)" -eq 2 ]
zp isometric --set liquid.model=none --set mesh.nodes=11 --set drive.voltage=1kV --set 'isometric.separation=[6 mm, 12 mm]' -o aligned
ok "rows show three digits of a small force" prints 'force  0\.00[0-9][0-9][0-9] N\|force 0\.000[0-9][0-9][0-9] N'

cat >bad.yaml <<'END'
load:
  mass: 8 g
ribbon:
  thickness: 50 lightyears
END
refused "file, line, key, value, unit, range" \
  'bad\.yaml:4: ribbon\.thickness = "50 lightyears".*um from 1 um to 5000 um' run bad.yaml -o refused
printf 'load:\n  mass: 8 g\nrobbon:\n  thickness: 50 um\n' >bad.yaml
refused "unknown key in line 3 or 4" 'bad\.yaml:[34]: robbon.*did you mean' run bad.yaml -o refused
printf 'load:\n  mass: 8 g\nambient:\n  humidity: 0.5\n' >bad.yaml
refused "what is not modelled, in a file" 'bad\.yaml:[34]: ambient.*humidity is not modelled' run bad.yaml -o refused
printf 'load:\n  mass: 8 g\n  mass: 9 g\n' >bad.yaml
refused "a key twice" 'bad\.yaml:3: load\.mass.*twice' run bad.yaml -o refused
printf 'load: {mass: 8 g\nribbon: 5' >bad.yaml
refused "broken YAML" 'bad\.yaml:[0-9]' run bad.yaml -o refused
head -c 3000 /dev/urandom >bad.yaml
refused "no text" 'bad\.yaml' run bad.yaml -o refused
printf 'study: fly\n' >bad.yaml
refused "unknown study in a file" 'bad\.yaml:1: study.*actuate' run bad.yaml -o refused

: >a-file
ends 3 "3: -o is a file" actuate $short -o a-file
ok "3: says which" says 'a-file.*not a folder'
ok "3: the file stays" is_empty a-file
ends 3 "3: -o below a file" actuate $short -o a-file/below
ends 3 "3: -o where nothing can be made" actuate $short -o /proc/zipact-cannot-be
ok "3: says where" says '/proc/zipact-cannot-be'
ends 3 "3: -o is empty" actuate $short -o ''
zp_closed() { PATH=/nowhere "$zipact" "$@" >&- 2>stderr; status=$?; }
zp_closed actuate $short --json -o closed-output
ok "a closed standard output: 3" status_is 3
ok "a closed standard output: it says so" says "standard output"
ok "a closed standard output: the files are there" complete closed-output
zp_closed stationary --set mesh.nodes=9 --set 'load.mass=[8 g, 9 g]' --json -o closed-output
ok "a sweep and a closed standard output: 3" status_is 3
zp_closed actuate $short --quiet -o closed-output
ok "nothing is lost where nothing is printed: 0" status_is 0
if [ -c /dev/full ]; then
  PATH=/nowhere "$zipact" actuate $short --json -o full >/dev/full 2>stderr
  status=$?
  ok "3: --json to a full device" status_is 3
  for format in '' --json --yaml; do
    "$zipact" keys $format >/dev/full 2>stderr
    status=$?
    ok "3: keys $format to a full device" status_is 3
  done
  "$zipact" --version >/dev/full 2>stderr
  status=$?
  ok "3: --version to a full device" status_is 3
fi
# -- what a scenario of a stranger, or a folder, may lead to -------------------------------------------------------
printf 'root:x:0:0:secret:/root:/bin/sh\nsecret word\n' >private
printf 'name,secret\nme,hidden\n' >private.csv
for file in private private.csv; do
  for words in "calibrate --set data.file=$file" "stationary --set data.file=$file" "calibrate --set data.file=$file --set data.columns=a=load_g" \
    "actuate --set drive.waveform=table --set drive.file=$file" "actuate --set initial.state=checkpoint --set initial.file=$file"; do
    ends 2 "$words: 2" $words -o reading
    ok "$words: no message quotes a file that is not a table" [ -z "$(grep -E 'secret|hidden' stderr)" ]
  done
done
mkdir outside leads
for name in plots shapes journal.sqlite table.csv; do
  ln -s ../outside "leads/$name"
  ends 3 "3: $name is a link that leads out of the folder" actuate $short -o leads
  ok "3: $name: says so" says "leads/$name: it is a link that leads out of its folder"
  rm "leads/$name"
done
ok "nothing is written there" [ -z "$(ls outside)" ]
mkdir leads/inside && ln -s inside leads/plots
ends 0 "a link inside the folder is allowed" actuate $short -o leads
mkfifo pipe.fmu leads/journal.sqlite
ends 3 "3: a special file in the folder" actuate $short -o leads
ok "3: a special file: says so" says 'journal.sqlite: it is a special file'
ends 3 "3: an FMU as a special file" fmu -o pipe.fmu
ok "3: the special file stays" [ -p pipe.fmu ]
rm -rf pipe.fmu leads private private.csv
if [ "$(id -u)" -ne 0 ]; then
  mkdir locked && chmod 555 locked
  ends 3 "3: no right to write" actuate $short -o locked/here
  ok "3: says so" says 'locked/here.*ermission'
  chmod 755 locked
fi

# -- disk full -----------------------------------------------------------------------------------------------

mkdir -p small
full=0
for size in 4k 16k 32k 48k 64k 96k 128k; do # another file is the one that does not fit
  [ "$(id -u)" -eq 0 ] || break
  mount -t tmpfs -o size=$size tmpfs small 2>/dev/null || break
  trap 'umount "$scratch/cli-test/small" 2>/dev/null' EXIT
  zp actuate $short --set output.samples=1000 -o small/results
  if [ "$status" -ne 0 ]; then
    full=$((full + 1))
    ok "3: disk full at $size" status_is 3
    ok "3: disk full at $size: says so" says 'small/results.*No space left'
    ok "3: disk full at $size: nothing half written" no_temporaries small
    ok "3: disk full at $size: no summary of what is not whole" is_absent small/results/summary.json
  fi
  umount small
  trap - EXIT
done
if [ $full -eq 0 ]; then
  echo "disk full: not tested, a small tmpfs cannot be mounted here"
fi

sweep="stationary --set output.errors=false --no-plots -o filling --set"
zp $sweep 'mesh.nodes=[5, 9]'
mv filling/table.csv before.csv
(
  trap '' XFSZ
  ulimit -f 100 # 50 kB, in some shells 100 kB: too short for a journal of 2001 nodes
  PATH=/nowhere exec "$zipact" $sweep 'mesh.nodes=[5, 9, 2001]' --resume >stdout 2>stderr
)
status=$?
ok "3: a row does not fit" status_is 3
ok "3: a row does not fit: a table of those before" cmp filling/table.csv before.csv

# -- Ctrl-C -----------------------------------------------------------------------------------------------------

cpu_of() { # PID: CPU time so far, in 1/100 s; very long if it has ended
  awk '{ print $3 == "Z" ? 999999 : $14 + $15 }' "/proc/$1/stat" 2>/dev/null || echo 999999
}

has_computed() { # PID TIME: wait until it has computed for that long, in 1/100 s, or has ended
  while [ "$(cpu_of "$1")" -lt "$2" ]; do
    sleep 0.05
  done
}

interrupt() { # TIME ARGUMENT...: Ctrl-C after that much CPU time, in 1/100 s
  wait_for=$1
  shift
  PATH=/nowhere "$zipact" "$@" >stdout 2>stderr &
  pid=$!
  has_computed $pid "$wait_for"
  kill -INT $pid
  wait $pid
  status=$?
}

long="--set mesh.nodes=5 --set solver.time_step=1us --set solver.tolerance=0.1 --set drive.voltage=0 --set solver.end_time=10000"
interrupt 50 actuate $long --json -o interrupted
ok "130: Ctrl-C while it moves" status_is 130
ok "130: --json" json stdout 'd["outcome"] == "interrupted" and d["simulated_time_s"] > 0'
ok "130: what was done is kept" complete interrupted
ok "130: where it stood is kept" is_file interrupted/checkpoint.zps
ok "130: rows are kept" [ "$(wc -l <interrupted/table.csv)" -gt 2 ]
interrupt 50 actuate --set mesh.nodes=2001 --json -o interrupted-early
ok "130: Ctrl-C while it settles" status_is 130
ok "130: --json, too" json stdout 'd["outcome"] == "interrupted"'
ok "130: files, too" complete interrupted-early

# -- a gnuplot that hangs: it blocked for ever, swallowed the first Ctrl-C, and summary.json never came -----------

wait_for_file() { # FILE: until it is there, five minutes at most
  tries=3000
  while [ ! -s "$1" ] && [ $tries -gt 0 ]; do
    sleep 0.1
    tries=$((tries - 1))
  done
}

mkdir hanging-bin
cat >hanging-bin/gnuplot <<'END'
#!/bin/sh
trap '' INT TERM HUP
echo $$ >started
sleep 1000
sleep 1000
END
chmod 755 hanging-bin/gnuplot
PATH=$PWD/hanging-bin:$PATH "$zipact" actuate $short --json -o hanging >stdout 2>stderr &
pid=$!
wait_for_file hanging/plots/started
for file in scenario.yaml summary.json table.csv results.h5; do
  ok "a gnuplot that hangs: $file is there" is_file hanging/$file
done
ok "and the scripts" is_file hanging/plots/stroke.gp
kill -INT $pid
wait $pid
status=$?
ok "130: Ctrl-C while gnuplot hangs" status_is 130
ok "130: says which picture is missing" says 'hanging/plots/.*svg was not drawn: interrupted'
ok "130: --json prints the numbers" cmp -s stdout hanging/summary.json
ok "130: the numbers are whole, and nothing is half written" complete hanging
ok "130: no gnuplot is left" [ -z "$(ps -eo stat=,pgid= | awk -v group="$(cat hanging/plots/started)" '$2 == group && $1 !~ /Z/')" ]

PATH=$PWD/hanging-bin:$PATH "$zipact" actuate $long --json -o hanging-twice >stdout 2>stderr &
pid=$!
wait_for_file hanging-twice/.zipact-lock
has_computed $pid 50
kill -INT $pid
wait_for_file hanging-twice/plots/started
ok "what an interrupted run did is kept before gnuplot hangs" json hanging-twice/summary.json 'd["outcome"] == "interrupted"'
kill -INT $pid
wait $pid
status=$?
ok "130: a second Ctrl-C ends the drawing" status_is 130
ok "130: and leaves a whole report" complete hanging-twice

# -- two runs into one folder: they mixed their files without a word ------------------------------------------------

PATH=/nowhere "$zipact" actuate $long --quiet -o held >/dev/null 2>&1 &
pid=$!
wait_for_file held/.zipact-lock
ends 3 "3: another run has the folder" actuate $short -o held
ok "3: says which process" says "held: process $pid on .* is writing there"
ends 3 "3: another study, too" stationary $short -o held
ok "3: nothing was written" is_absent held/scenario.yaml
ends 0 "another folder is free" actuate $short -o beside-held
kill -KILL $pid
wait $pid 2>/dev/null
echo half >held/.table.csv.zipact-$pid.tmp
echo mine >held/.mine.csv.12.tmp
ends 0 "a killed run is not in the way" actuate $short -o held
ok "what it left is gone" [ -z "$(find held -name '.*zipact*')" ]
ok "what is not ours stays" grep -q mine held/.mine.csv.12.tmp
rm held/.mine.csv.12.tmp
mkdir -p held-report
PATH=/nowhere "$zipact" reproduce --quiet -o held-report >/dev/null 2>&1 &
pid=$!
wait_for_file held-report/.zipact-lock
ends 3 "3: another reproduce has the folder" reproduce -o held-report
ok "3: says which process, too" says "held-report: process $pid on"
kill -INT $pid
wait $pid
rm -rf held-report

# -- checkpoints -------------------------------------------------------------------------------------------------

zp actuate $short --set solver.end_time=4ms -o whole
zp actuate $short -o cut
ok "a run leaves a checkpoint" is_file cut/checkpoint.zps
from="--set initial.state=checkpoint --set initial.file=cut/checkpoint.zps"
ends 0 "resumes from it" actuate $short $from --set solver.end_time=4ms -o rest
ok "to the same state" cmp whole/checkpoint.zps rest/checkpoint.zps
ok "and the same last row" [ "$(tail -1 whole/table.csv | cut -d, -f1-8)" = "$(tail -1 rest/table.csv | cut -d, -f1-8)" ]
ok "scenario.yaml has the file's whole path" grep -q "file: .*/cut/checkpoint.zps" rest/scenario.yaml
zp run rest/scenario.yaml -o rest-again
ok "and runs again" cmp rest/checkpoint.zps rest-again/checkpoint.zps
mkdir -p sub
printf 'initial: {state: checkpoint, file: ../cut/checkpoint.zps}\n' >sub/on.yaml
zp actuate sub/on.yaml $short --set solver.end_time=4ms -o rest-again
ok "a scenario names it from its own folder" cmp rest/checkpoint.zps rest-again/checkpoint.zps
ends 0 "a sweep from it into its own folder" actuate $short $from --set 'solver.end_time=[3 ms, 4 ms]' -o cut
ok "leaves it there" is_file cut/checkpoint.zps
ends 2 "2: another model" actuate $short $from --set ribbon.thickness=60um -o refused
ok "2: names the key and both values" says 'ribbon.thickness is 5e-05 m there, 6e-05 m here'
head -c 999 cut/checkpoint.zps >short.zps
ends 2 "2: cut short" actuate $short $from --set initial.file=short.zps -o refused
ok "2: says where it ends" says 'short.zps: cut short: 999 of [0-9]* bytes'
ok "2: nothing was written" is_absent refused

# -- streams ----------------------------------------------------------------------------------------------------

ends 0 "--quiet" actuate $short --quiet -o quiet
ok "--quiet prints nothing" is_empty stdout
ok "--quiet says nothing" is_empty stderr
zp actuate --quiet --set load.mass=x -o quiet
ok "--quiet says errors" says 'load\.mass'
zp actuate $short --quiet --json -o quiet
ok "--quiet --json prints the object" json stdout 'd["outcome"] == "end_time"'
ok "--quiet --json says nothing" is_empty stderr
zp actuate $short -o missing-gnuplot
ok "without gnuplot: a notice" says gnuplot
ok "without gnuplot: status 0" status_is 0
ok "without gnuplot: the scripts stay" is_file missing-gnuplot/plots/stroke.gp

# -- templates of pictures ------------------------------------------------------------------------------------------
ends 2 "plots without a folder: status 2" plots
ok "plots without a folder: says what it needs" says 'plots needs a folder to write to: -o FOLDER'
zp plots -o mine-too --quiet
ok "plots --quiet prints nothing" is_empty stdout
ends 0 "plots: status 0" plots -o mine
ok "plots: says how to draw with them" prints '^zipact STUDY --templates mine draws'
ok "plots writes the templates" is_file mine/stroke.gp
ends 2 "plots does not write over them: status 2" plots -o mine
ok "plots does not write over them: says so" says 'mine/.*: exists already'
echo '# edited' >>mine/stroke.gp
ends 0 "--templates: status 0" actuate $short --templates mine -o edited
ok "--templates: the script has what was edited" grep -q '^# edited' edited/plots/stroke.gp
ok "--templates is not in scenario.yaml, which others may run" [ -z "$(grep templates edited/scenario.yaml)" ]
mkdir evil
printf 'system "touch escaped"\n!touch escaped\n' >evil/stroke.gp
printf 'study: actuate\noutput: {templates: evil}\n' >stranger.yaml
zp_drawing run stranger.yaml -o stranger
ok "a scenario names templates: status 2" status_is 2
ok "a scenario names templates: says where they belong" says '--templates FOLDER'
ok "a scenario names templates: none of their commands ran" is_absent escaped
ends 2 "--templates of no folder: status 2" actuate $short --templates nowhere -o nothing
ok "--templates of no folder: says so" says '--templates: there is no folder nowhere'

cat >terminal.py <<'END'
"""Run a command with stderr on a terminal => what it wrote there."""
import os, pty, subprocess, sys

master, slave = pty.openpty()
child = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=slave, env={"PATH": "/nowhere"})
os.close(slave)
text = b""
try:
    while piece := os.read(master, 4096):
        text += piece
except OSError:
    pass
child.wait()
sys.stdout.write(text.decode())
END
if "$python" -c 'import pty; pty.openpty()' 2>/dev/null; then # a bare chroot has no terminals to lend
  "$python" terminal.py "$zipact" actuate --set mesh.nodes=41 --set solver.end_time=1ms -o terminal >stdout 2>stderr
  ok "a progress bar on a terminal" prints '\[#*\.*\] *[0-9]* %'
fi
"$python" terminal.py "$zipact" actuate --quiet --set mesh.nodes=41 --set solver.end_time=1ms -o terminal >stdout 2>stderr
ok "no progress bar with --quiet" is_empty stdout
zp actuate --set mesh.nodes=41 --set solver.end_time=1ms -o terminal
ok "no progress bar into a file" [ "$(grep -c '\[#' stderr)" -eq 0 ]

# -- the summary on the terminal --------------------------------------------------------------------------------------

numbers() { grep -v note: stdout | grep -c -E '^  [a-z].* +[-0-9.e+]+( |$)'; } # lines "  name   12.3 mm"
for study in actuate equilibrium limits modes isometric profile stationary; do
  zp $study --set mesh.nodes=11 -o terminal-summary
  ok "$study prints some numbers, at most ten: $(numbers)" [ "$(numbers)" -ge 3 -a "$(numbers)" -le 10 ]
  ok "$study says nothing of steps and speed" [ "$(grep -c -i -E 'step|real.time|iterations' stdout)" -eq 0 ]
  ok "$study: values end in one column" [ "$(grep -v note: stdout | sed -n 's/^  .\{27\}\( *[-0-9.e+]*\).*/\1/p' | awk '{ print length($0) }' | sort -u | wc -l)" -eq 1 ]
done
zp equilibrium --set output.errors=true -o terminal-summary
ok "an estimated error stands behind its number" prints '^  pull-in  *[0-9.]* kV  +- [0-9]'
zp stationary --set load.mass=0.008 -o unitless
ok "a number without a unit is noted" says '^zipact: load\.mass: 0\.008 taken as 0\.008 kg$'
zp stationary --set 'load.mass=[1 g, 0.008]' --set gravity=0 --set mesh.nodes=21 -o unitless
ok "in a list, too" says 'load\.mass: 0\.001 taken as'
ok "a zero and a pure number are not" [ "$(wc -l <stderr)" -le 2 ]
zp run unitless/scenario.yaml -o unitless-again
ok "the scenario that a run leaves has units everywhere" [ "$(grep -c 'taken as' stderr)" -eq 0 ]
zp stationary --set load.mass=0.008 --quiet -o unitless
ok "--quiet says nothing of it" is_empty stderr

zp actuate $short -o noted
ok "notes are printed, each" [ "$(grep -c '^  note: ' stdout)" -eq "$("$python" -c 'import json; print(len(json.load(open("noted/summary.json"))["notes"]))')" ]
ok "there is one" prints '^  note: '
zp equilibrium --set mesh.nodes=9 --set output.errors=true -o terminal-summary
error=$("$python" -c 'import json; print("%.2g" % (1e-3 * abs(json.load(open("terminal-summary/summary.json"))["pull_in_voltage_error_V"])))')
ok "an estimated error has the unit of its number: $error" prints "^  pull-in  *[0-9.]* kV  +- $error\$"
zp stationary --set mesh.nodes=5 --set 'load.mass=1 g .. 9 g : 103' --no-plots -o rows-shown
ok "a hundred rows of 103, and how many more" [ "$(grep -c '^  load.mass = ' stdout)" -eq 100 ]
ok "a hundred rows of 103: three more" prints '^  \.\.\. and 3 more rows in table\.csv'
ends 0 "--jobs 1024 is allowed" stationary --set mesh.nodes=5 --jobs 1024 -o most-jobs
printf 'study: limits\nmesh: {nodes: 5}\nload: {mass: 9 g}\n' >a=b.yaml
zp stationary a=b.yaml --json -o named
ok "a scenario with = in its name; the word before it says which study" json stdout 'd["study"] == "stationary"'
ok "its keys are taken" grep -q 'mass: 9 g' named/scenario.yaml
zp fmu -o default.fmu
ok "an FMU of FMI 3 unless told" prints 'FMI 3\.0$'
rm -f default.fmu

# -- preset < file < --set ------------------------------------------------------------------------------------------

printf 'mesh: {nodes: 21}\nribbon: {thickness: 80 um}\nsolver: {end_time: 1 ms}\npreset: paper-code\n' >order.yaml
ends 0 "a preset runs" run order.yaml -o order
ok "the preset gives what the file does not" grep -q 'force_scale: 6.6' order/scenario.yaml
ok "the file wins over the preset, wherever it is written" grep -q 'thickness: 80 um' order/scenario.yaml
zp run order.yaml --set 'ribbon.thickness=70 um' -o order
ok "--set wins over the file" grep -q 'thickness: 70 um' order/scenario.yaml
printf 'mesh: {nodes: 21}\nribbon: {thickness: 80 um}\nsolver: {end_time: 1 ms}\n' >order.yaml
zp run order.yaml --set preset=paper-code -o order
ok "the file wins over a preset of --set" grep -q 'thickness: 80 um' order/scenario.yaml
ok "and the preset of --set is taken" grep -q 'force_scale: 6.6' order/scenario.yaml
zp run order.yaml --set load.mass=1g --set load.mass=2g -o order
ok "the later --set wins" grep -q 'mass: 2 g' order/scenario.yaml

# -- sweeps ------------------------------------------------------------------------------------------------------------

ends 0 "a sweep" actuate $short --set 'drive.voltage=[0, 1 kV, 2 kV]' --set 'load.mass=[8 g, 20 g]' --json -o sweep
ok "the product of the lists, the last key fastest" json stdout \
  '[(r["load.mass"], r["drive.voltage"]) for r in d["rows"]] == [(m, u) for m in (0.008, 0.02) for u in (0, 1000, 2000)]'
ok "one row of table.csv each" [ "$(wc -l <sweep/table.csv)" -eq 7 ]
ok "columns for the list keys" grep -q '^load\.mass_kg,drive\.voltage_V,' sweep/table.csv
ok "its files are whole" complete sweep
zp actuate $short --set 'load.mass=[8 g]' --json -o sweep-of-one
ok "a list of one is a sweep" json stdout 'len(d["rows"]) == 1'
zp cycle --set mesh.nodes=11 --set liquid.model=none --set 'damping.internal=5 ms' --set 'drive.voltage=8 kV' --set drive.waveform=sine --set 'drive.frequency=[2 Hz, 3 Hz, 5 Hz]' -o cycles
ok "a sweep of cycles says up to which frequency the actuator closes" prints '^closes fully up to 3 Hz, of these$'
ok "in summary.json, too" json cycles/summary.json 'd["largest_closing_frequency_Hz"] == 3 and [r["closes"] for r in d["rows"]] == [1, 1, 0]'

# -- same input, same bytes ------------------------------------------------------------------------------------------------

cat >without_times.py <<'END'
"""Print summary.json without what follows from wall time."""
import json, sys

def strip(d):
    if isinstance(d, dict):
        return {k: strip(v) for k, v in d.items() if k not in ("wall_time_s", "real_time_factor")}
    return [strip(x) for x in d] if isinstance(d, list) else d

print(json.dumps(strip(json.load(open(sys.argv[1])))))
END
same_report() { # DIR DIR
  "$python" without_times.py "$1/summary.json" >first.txt && "$python" without_times.py "$2/summary.json" >second.txt &&
    cmp first.txt second.txt && diff -r -q -x summary.json -x journal.sqlite "$1" "$2"
}
zp_drawing actuate $short --set drive.voltage=5kV -o twice-a
zp_drawing actuate $short --set drive.voltage=5kV -o twice-b
ok "same input, same bytes, pictures and all" same_report twice-a twice-b
ends 0 "scenario.yaml runs again" run twice-a/scenario.yaml -o rerun
ok "to the same table" cmp twice-a/table.csv rerun/table.csv
ok "to the same results.h5" cmp twice-a/results.h5 rerun/results.h5
ok "and to itself" cmp twice-a/scenario.yaml rerun/scenario.yaml
zp run sweep/scenario.yaml -o rerun-sweep
ok "a sweep runs again to the same table" cmp sweep/table.csv rerun-sweep/table.csv
ok "and to the same results.h5" cmp sweep/results.h5 rerun-sweep/results.h5
ok "in all its bytes" same_report sweep rerun-sweep
zp run order/scenario.yaml -o rerun-order
ok "with a preset, too" same_report order rerun-order
LC_ALL=de_DE.UTF-8 PATH=/nowhere "$zipact" run twice-a/scenario.yaml -o rerun >stdout 2>stderr
ok "in any locale" cmp twice-a/table.csv rerun/table.csv

# -- what else is in the folder -----------------------------------------------------------------------------------------------

mkdir -p foreign/plots foreign/shapes foreign/own
for name in notes.txt table.csv.bak plots/mine.svg shapes/mine.vtp own/table.csv .hidden; do
  echo "mine: $name" >"foreign/$name"
done
find foreign -type f -exec cksum {} + | sort >before.txt
zp actuate $short --set output.shapes=10 -o foreign
zp actuate $short --set output.shapes=3 -o foreign
ok "results beside what is there" complete foreign
find foreign -type f -exec cksum {} + | sort >after.txt
ok "foreign files are not touched" [ "$(comm -12 before.txt after.txt | wc -l)" -eq 6 ]
ok "shapes of the run before are gone" [ "$(find foreign/shapes -name 'shape_*' | wc -l)" -eq "$(grep -c '<DataSet' foreign/shapes.pvd)" ]
zp actuate $short --set 'load.mass=[8 g, 9 g]' -o foreign
ok "a sweep has no shapes, and none of before" is_absent foreign/shapes.pvd
ok "and no checkpoint" is_absent foreign/checkpoint.zps

# -- no NaN in any file ----------------------------------------------------------------------------------------------------------

ends 0 "kind ribbon" actuate --set actuator.kind=ribbon $short -o ribbon
ends 0 "no load, no weight, no voltage" actuate $short --set load.mass=0 --set gravity=0 --set drive.voltage=0 -o nothing
zp_drawing actuate $short --no-plots -o bare
ok "--no-plots: 0" status_is 0
ok "--no-plots: no folder for pictures" is_absent bare/plots
ok "--no-plots: says nothing of plots/" [ -z "$(grep plots/ stdout)" ]
ends 2 "--no-plots of keys: 2" keys --no-plots
for jobs in 0 -1 two 1e3 2000 ''; do
  ends 2 "--jobs '$jobs': 2" actuate $short --jobs "$jobs" -o wrong-jobs
  ok "--jobs '$jobs': says what it takes" says "jobs takes a number from 1 to 1024"
  ok "--jobs '$jobs': nothing written" is_absent wrong-jobs
done
grep -rliE --include='*.csv' --include='*.json' --include='*.yaml' --include='*.pvd' '(^|[^a-z])(nan|inf|infinity)([^a-z]|$)' . \
  >nan.txt
ok "no NaN or infinity in any file: $(tr '\n' ' ' <nan.txt)" is_empty nan.txt
ok "no temporary file is left anywhere" no_temporaries .

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
