#!/bin/bash
# Whole processes beside another program's: wall and CPU seconds of one picture and of ten (one
# process of ours with ten seeds, ten of theirs), in turn, the least of some. Usage:
#   [REPEATS=5] tests/bench/peers.sh build/gramloom METHOD 'COMMAND OF THE PEER' [EXEMPLAR [SIZE]]
# The command reads $EXEMPLAR, writes $RESULT and may use $SIZE and $SEED:
#   tests/bench/peers.sh build/gramloom patchmatch 'gmic $EXEMPLAR syntexturize_matchpatch $SIZE,$SIZE -o $RESULT'
#   tests/bench/peers.sh build/gramloom phase 'gmic $EXEMPLAR syntexturize $SIZE,$SIZE -o $RESULT'
set -eu
gramloom=$(realpath "$1") method=$2 peer=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export EXEMPLAR=$(realpath "${4:-$(dirname "$0")/../../data/pebbles.png}") SIZE=${5:-512}
export RESULT=$folder/peer.png SEED=1
TIMEFORMAT='%R %U %S'

ours() {
  printf 'size = %s\nscores = false\nseeds = [%s]\n[[exemplar]]\nname = "e"\nimage = "%s"\n[[method]]\nname = "m"\nkind = "%s"\n' \
    "$SIZE" "$(seq -s , "$1")" "$EXEMPLAR" "$method" > "$folder/job.toml"
  "$gramloom" run "$folder/job.toml" --output "$folder/out" --quiet
}
theirs() { for SEED in $(seq "$1"); do bash -c "$peer"; done; }

for count in 1 10; do
  for _ in $(seq "${REPEATS:-3}"); do
    for who in ours theirs; do
      { time $who "$count" > /dev/null 2>> "$folder/messages"; } 2> "$folder/time" ||
        { cat "$folder/messages" >&2; exit 1; }
      echo "$who $(cat "$folder/time")" >> "$folder/$count"
    done
  done
  awk -v count="$count" '
    { cpu = $3 + $4
      if (!($1 in wall) || $2 < wall[$1]) wall[$1] = $2
      if (!($1 in least) || cpu < least[$1]) least[$1] = cpu }
    END { printf "%2d picture%s  wall %6.2f beside %6.2f s: %.2f   CPU %6.2f beside %6.2f s: %.2f\n",
            count, (count > 1 ? "s" : " "), wall["ours"], wall["theirs"], wall["ours"] / wall["theirs"],
            least["ours"], least["theirs"], least["ours"] / least["theirs"] }' "$folder/$count"
done
