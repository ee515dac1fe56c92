#!/usr/bin/env bash
# Kills runs at random moments and looks at what they leave: every file under its own name must be
# whole and the same as an undisturbed run's, and resuming must end with that run's bytes.
#   tests/soak/kill.sh [KILLS] [build/gramloom]      1000 kills take about half an hour
# The runs, of one thread so that neural textures are the same bytes too, are plain ones, such of two processes (--jobs 2), and two shards in one folder at once.
set -uo pipefail
kills=${1:-1000}
gramloom=$(readlink -f "${2:-build/gramloom}")
data=$(dirname "$(readlink -f "$0")")/../../data
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

{
  printf 'size = [72, 64]\nseeds = [1, 2]\n'
  for name in granite pebbles; do
    printf '[[exemplar]]\nname = "%s"\nimage = "%s/%s.png"\nmax_side = 72\n' $name "$data" $name
  done
  for kind in quilting pixel patchmatch histogram phase; do
    printf '[[method]]\nname = "%s"\nkind = "%s"\n' $kind $kind
  done
  printf '[[method]]\nname = "marble"\nkind = "procedural"\ntexture = "marble"\n'
  printf '[[method]]\nname = "neural"\nkind = "neural"\nlayout = "noise"\niterations = [20]\n'
} >config.toml

"$gramloom" run config.toml --output whole --quiet --threads 1 || { echo "the undisturbed run failed" >&2; exit 1; }

pictures() { (cd "$1" && find . -name '*.png' ! -name '.*' | sort); }

faults=0
fault() { echo "FAULT after kill $done_kills: $*" >&2; faults=$((faults + 1)); }

check() {  # that whatever is there is whole
  [ -d out ] || return
  local file record
  while read -r file; do
    # A neural job that was stopped has left the picture that it had so far.
    record=out/$(sed -E 's/(seed[0-9]+).*/\1.json/' <<<"$file")
    if grep -qs '"status": "done"' "$record" || [[ $file != */seed* ]]; then
      cmp -s "out/$file" "whole/$file" || fault "$file differs"
    else
      tail -c 12 "out/$file" | grep -q IEND || fault "$file is cut off"
    fi
  done < <(pictures out)
  while read -r file; do
    [ "$(tail -c 2 "$file")" = "}" ] || fault "$file is cut off"
    grep -q '"status": "done"' "$file" || continue
    [ -f "${file%.json}.png" ] || fault "$file is done, its picture is missing"
  done < <(find out -name 'seed*.json' ! -name '.*')
  if [ -f out/index.html ] && ! tail -n 2 out/index.html | grep -q '</html>'; then fault "the page is cut off"; fi
}

compare() {  # a finished run with the undisturbed one
  diff <(pictures out) <(pictures whole) >&2 || fault "other pictures"
  diff <(cut -d, -f1-5,8- out/scores.csv) <(cut -d, -f1-5,8- whole/scores.csv) >&2 || fault "other scores"
  find out -name '.*.tmp' -o -name '*.lock' -o -name '*.checkpoint*' | grep . >&2 && fault "left-overs"
}

begin() {  # one of the ways to run, as a process group of its own
  case $((RANDOM % 3)) in
    0) setsid "$gramloom" run config.toml --output out --resume --quiet --threads 1 2>>log & groups=($!) ;;
    1) setsid "$gramloom" run config.toml --output out --resume --quiet --threads 1 --jobs 2 2>>log & groups=($!) ;;
    2) setsid "$gramloom" run config.toml --output out --resume --quiet --threads 1 --shard 1/2 2>>log & groups=($!)
       setsid "$gramloom" run config.toml --output out --resume --quiet --threads 1 --shard 2/2 2>>log & groups+=($!) ;;
  esac
}

done_kills=0 finished=0
while [ $done_kills -lt "$kills" ]; do
  begin
  sleep "$(printf '%d.%03d' $((RANDOM % 2)) $((RANDOM % 1000)))"
  for group in "${groups[@]}"; do
    kill -9 -- "-$group" 2>/dev/null && done_kills=$((done_kills + 1))
  done
  wait "${groups[@]}" 2>/dev/null
  check
  if [ $((RANDOM % 10)) = 0 ]; then
    "$gramloom" run config.toml --output out --resume --quiet --threads 1 || fault "resuming failed"
    compare
    finished=$((finished + 1))
    rm -rf out
  fi
done
"$gramloom" run config.toml --output out --resume --quiet --threads 1 || fault "resuming failed"
compare
echo "$done_kills kills, $finished runs finished and compared, $faults faults"
[ $faults = 0 ]
