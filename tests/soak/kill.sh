#!/usr/bin/env bash
# Kills and stops runs at random moments and looks at what they leave: every file under its own name
# must be whole and the same as an undisturbed run's, and going on must end with that run's bytes.
#   tests/soak/kill.sh [KILLS] [build/gramloom]      1000 kills take about half an hour
# The runs, of one thread so that neural textures are the same bytes too, are plain ones, such of two
# processes (--jobs 2), and two shards in one folder at once; most with --resume, some from the start,
# some with another size. They get SIGKILL, or SIGTERM or SIGHUP, which must end them as Ctrl-C does;
# with --jobs also all processes at once, as a service manager does it.
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
other=(--set 'size=[48,56]')
arguments=(run config.toml --quiet --threads 1)

"$gramloom" "${arguments[@]}" --output whole && "$gramloom" "${arguments[@]}" "${other[@]}" --output other ||
  { echo "the undisturbed run failed" >&2; exit 1; }

pictures() { (cd "$1" && find . -name '*.png' ! -name '.*' | sort); }

faults=0
fault() { echo "FAULT after kill $done_kills ($how): $*" >&2; faults=$((faults + 1)); }

check() {  # that whatever is there is whole
  [ -d out ] || return
  local file record
  while read -r file; do
    # A neural job that was stopped has left the picture that it had so far.
    record=out/$(sed -E 's/(seed[0-9]+).*/\1.json/' <<<"$file")
    if grep -qs '"status": "done"' "$record" || [[ $file != */seed* ]]; then
      cmp -s "out/$file" "whole/$file" || cmp -s "out/$file" "other/$file" || fault "$file differs"
    else
      tail -c 12 "out/$file" | grep -q IEND || fault "$file is cut off"
    fi
  done < <(pictures out)
  while read -r file; do
    [ "$(tail -c 2 "$file")" = "}" ] || fault "$file is cut off"
    grep -q '"status": "failed"' "$file" && fault "$file says failed: $(grep '"error"' "$file")"
    grep -q '"status": "done"' "$file" || continue
    [ -f "${file%.json}.png" ] || fault "$file is done, its picture is missing"
  done < <(find out -name 'seed*.json' ! -name '.*')
  if [ -f out/index.html ] && ! tail -n 2 out/index.html | grep -q '</html>'; then fault "the page is cut off"; fi
}

compare() {  # a finished run with the undisturbed one
  local file
  diff <(pictures out) <(pictures whole) >&2 || fault "other pictures"
  while read -r file; do cmp "out/$file" "whole/$file" >&2 || fault "$file differs"; done < <(pictures whole)
  diff <(cut -d, -f1-5,8- out/scores.csv) <(cut -d, -f1-5,8- whole/scores.csv) >&2 || fault "other scores"
  find out -name '.*.tmp' -o -name '*.lock' -o -name '*.checkpoint*' | grep . >&2 && fault "left-overs"
}

begin() {  # one of the ways to run, each process with its workers as a session of its own
  local words=("${arguments[@]}" --output out)
  [ $((RANDOM % 5)) = 0 ] || words+=(--resume)
  [ $((RANDOM % 8)) = 0 ] && words+=("${other[@]}")
  case $((RANDOM % 3)) in
    0) shards=('') ;;
    1) shards=(--jobs=2) ;;
    2) shards=(--shard=1/2 --shard=2/2) ;;
  esac
  signal=$(shuf -n 1 -e KILL KILL TERM HUP) processes=()
  how="$signal ${words[*]:5} ${shards[*]}"
  for shard in "${shards[@]}"; do
    setsid "$gramloom" "${words[@]}" $shard 2>>log &
    processes+=($!)
  done
}

# Whether a process has begun to wait for signals: until then they end it as they do any program.
listens() { (($((16#$(sed -n 's/^SigBlk:\t*//p' "/proc/$1/status" 2>/dev/null || echo 0))) & 1 << 14)); }

stop() {  # what runs, and sees how it ends
  local process ended listened=()
  for process in "${processes[@]}"; do
    listens "$process" && listened[process]=yes
    if [ "$signal" != KILL ] && [ $((RANDOM % 3)) = 0 ]; then
      pkill "-$signal" -s "$process" && done_kills=$((done_kills + 1)) how+=", all at once"
    else
      kill "-$signal" -- "-$process" 2>/dev/null && done_kills=$((done_kills + 1))
    fi
  done
  for process in "${processes[@]}"; do
    wait "$process" 2>/dev/null
    ended=$?
    case $signal,$ended,${listened[process]-} in
      *,0,* | KILL,137,* | TERM,130,* | HUP,130,*) ;;
      TERM,143, | HUP,129,) ;;
      *) fault "exit code $ended; $(tail -n 1 log)" ;;
    esac
  done
}

finish() {  # what was stopped, with --resume or from the start, and compare
  local resume=--resume
  [ $((RANDOM % 3)) = 0 ] && resume='' && touch begun
  how="then run $resume"
  "$gramloom" "${arguments[@]}" --output out $resume 2>>log || fault "it failed: $(tail -n 1 log)"
  [ -z $resume ] && find out -name 'seed*.*' ! -newer begun | grep . >&2 && fault "these were not done again"
  compare
  finished=$((finished + 1))
  rm -rf out
}

done_kills=0 finished=0
while [ $done_kills -lt "$kills" ]; do
  begin
  sleep "$(printf '%d.%03d' $((RANDOM % 2)) $((RANDOM % 1000)))"
  stop
  check
  [ $((RANDOM % 10)) = 0 ] && [ -d out ] && finish
done
[ -d out ] && finish
echo "$done_kills kills, $finished runs finished and compared, $faults faults"
[ $faults = 0 ]
