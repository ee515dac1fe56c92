#!/bin/bash
# Filling holes beside other programs: wall and CPU seconds of whole processes, in turn, the least of
# some. Usage:
#   [REPEATS=3] tests/bench/fill_peers.sh build/gramloom PHOTO MASK 'NAME: COMMAND' ...
# A command reads $PHOTO and $MASK (white is to be filled) and writes $RESULT:
#   'matchpatch: gmic $PHOTO $MASK inpaint_matchpatch[0] [1] keep[0] -o $RESULT'
set -eu
gramloom=$(realpath "$1")
export PHOTO=$(realpath "$2") MASK=$(realpath "$3")
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
TIMEFORMAT='%R %U %S'
names=(gramloom)
commands=("$gramloom fill \$PHOTO --mask \$MASK --output \$RESULT --quiet")
for peer in "$@"; do
  names+=("${peer%%:*}")
  commands+=("${peer#*: }")
done

for _ in $(seq "${REPEATS:-3}"); do
  for i in "${!names[@]}"; do
    export RESULT=$folder/${names[$i]}.png
    { time bash -c "${commands[$i]}" > /dev/null 2>> "$folder/messages"; } 2> "$folder/time" ||
      { cat "$folder/messages" >&2; exit 1; }
    echo "${names[$i]} $(cat "$folder/time")" >> "$folder/times"
  done
done
awk '{ cpu = $3 + $4
       if (!($1 in wall) || $2 < wall[$1]) wall[$1] = $2
       if (!($1 in least) || cpu < least[$1]) least[$1] = cpu }
     END { for (name in wall) printf "%-12s wall %7.2f s  CPU %7.2f s  wall of gramloom / its %.2f\n",
             name, wall[name], least[name], wall["gramloom"] / wall[name] }' "$folder/times"
[ -z "${KEEP:-}" ] || cp "$folder"/*.png "$KEEP"
