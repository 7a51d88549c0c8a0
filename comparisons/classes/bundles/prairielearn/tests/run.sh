#!/usr/bin/env bash
# PrairieLearn runs this for each submission; results/results.json is there afterwards, whatever happens.
set -u
root=${GRADE:-/grade}
raytruth=${RAYTRUTH_COMMAND:-raytruth}
mkdir -p "$root/results" "$root/class"
cp -R "$root/student" "$root/class/submission"
# shellcheck disable=SC2086 - the command may have several words
$raytruth grade-all "$root/class" --assignment "$root/tests/assignment.toml" --workers 1 --out "$root/graded" \
    --results-for prairielearn
status=$?
# What is not gradable costs no attempt.
cp "$root/graded/students/submission/results.json" "$root/results/results.json" || printf '%s\n' \
    "{\"gradable\": false, \"message\": \"raytruth itself failed (exit status $status): this is no grade.\"}" \
    > "$root/results/results.json"
