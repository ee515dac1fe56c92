#!/bin/sh
# Seconds of one job of each method, alone and beside one busy process on each core, and the ratio.
# Each is the least of three. Usage, on a machine that does nothing else:
#   tests/bench/busy_cores.sh build/gramloom [EXEMPLAR [SIZE]]
set -eu
gramloom=$(realpath "$1")
exemplar=$(realpath "${2:-$(dirname "$0")/../../data/pebbles.png}")
size=${3:-512}
folder=$(mktemp -d)
busy=
stop_busy() { [ -z "$busy" ] || kill $busy 2>/dev/null || true; busy=; }
trap 'stop_busy; rm -rf "$folder"' EXIT

cores=$(taskset -cp $$ | sed 's/.*: //' | tr ',' ' ')
start_busy() {
  for range in $cores; do
    for core in $(seq "${range%-*}" "${range#*-}"); do
      taskset -c "$core" sh -c 'while :; do :; done' & busy="$busy $!"
    done
  done
}

seconds() {
  best=
  for repeat in 1 2 3; do
    before=$(date +%s%N)
    "$gramloom" run "$folder/job.toml" --output "$folder/out" --quiet
    took=$(( $(date +%s%N) - before ))
    if [ -z "$best" ] || [ "$took" -lt "$best" ]; then best=$took; fi
  done
  echo "$best"
}

printf '%-12s %8s %8s %6s\n' method idle busy ratio
for method in quilting patchmatch pixel pyramid phase markov histogram procedural neural; do
  more=
  case $method in
    procedural) more='texture = "pebbles"' ;;
    neural) more='preset = "fast"' ;;
  esac
  printf 'size = %s\nscores = false\n[[exemplar]]\nname = "e"\nimage = "%s"\n[[method]]\nname = "m"\nkind = "%s"\n%s\n' \
    "$size" "$exemplar" "$method" "$more" > "$folder/job.toml"
  idle=$(seconds)
  start_busy
  beside=$(seconds)
  stop_busy
  echo "$method $idle $beside" |
    awk '{ printf "%-12s %8.2f %8.2f %6.2f\n", $1, $2 / 1e9, $3 / 1e9, $3 / $2 }'
done
