#!/bin/sh
# GNU parallel gives lines of cases to as many zipact batch as there are processors, or, with -S one,two, to machines.
# Answers have the order of the lines:  sh parallel.sh < cases.jsonl > answers.jsonl
exec parallel --will-cite --pipe -N 2 --keep-order "zipact batch --jobs 1 --set liquid.model=none --set output.errors=false"
