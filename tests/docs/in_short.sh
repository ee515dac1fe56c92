#!/usr/bin/env bash
# Stands for gramloom where its commands would take too long for a test: configs are checked instead of
# run, what one line would make is printed as a config, and pictures are small. Options that `check`
# does not know are left out.
set -euo pipefail
command=$1
shift
left_out=() add=()
case $command in
  run | train) left_out=(--output --threads --jobs --shard --baseline --quiet --resume) && command=check ;;
  make | fill) add=(--print-config) ;;
  preview) left_out=(--size --samples) && add=(--size 48,48 --samples 1) ;;
  generate | tile) left_out=(--size) && add=(--size 256x256) ;;
esac
words=()
while [ $# -gt 0 ]; do
  if [[ " ${left_out[*]} " = *" $1 "* ]]; then
    case $1 in --quiet | --resume) ;; *) shift ;; esac # the others have a value
  else
    words+=("$1")
  fi
  shift
done
exec "$GRAMLOOM" "$command" "${words[@]}" "${add[@]}"
