#!/usr/bin/env bash
# Grades the repository that it is run in: the points go to the workflow's output, the text to the job's page.
set -u
raytruth=${RAYTRUTH_COMMAND:-raytruth}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/class/submission"
tar --exclude=./.git --exclude=./.github -cf - . | tar -xf - -C "$work/class/submission"
# shellcheck disable=SC2086 - the command may have several words
$raytruth grade-all "$work/class" --assignment .github/classroom/assignment.toml --workers 1 --out "$work/graded" \
    --results-for github-classroom
status=$?
results=$work/graded/students/submission/results.json
if [ ! -f "$results" ] || [ "$status" -eq 3 ]; then
    echo "raytruth itself failed (exit status $status): this is no grade." | tee -a "$GITHUB_STEP_SUMMARY"
    exit 1
fi
echo "result=$(base64 -w 0 < "$results")" >> "$GITHUB_OUTPUT"
python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["markdown"])' "$results" >> "$GITHUB_STEP_SUMMARY"
