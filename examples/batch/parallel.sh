#!/bin/bash
# GNU parallel, which may also spread over machines (--sshloginfile): one part a job.
#   examples/batch/parallel.sh meshes parts/*.stl
output=$1
shift
mkdir -p "$output"
parallel --joblog "$output/jobs.log" --resume-failed "${HOLDFAST:-holdfast} mesh {} -o $output/{/.}.vtu --time-limit 600 -q" ::: "$@"
