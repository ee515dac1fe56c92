#!/usr/bin/env bash
# Runs whose clock is set back or on by an hour, a day or a year, in the middle (faketime: Debian's
# faketime) and between a run that is stopped and the one that goes on (the files then have times of
# the future or the past): finished jobs are kept, unfinished ones done, nothing hangs or tells of
# negative times, and the end has an undisturbed run's bytes. The clock that never goes back is left
# alone, as the system leaves it.
#   tests/soak/clock.sh [TIMES] [build/gramloom]
set -uo pipefail
times=${1:-10}
gramloom=$(readlink -f "${2:-build/gramloom}")
data=$(dirname "$(readlink -f "$0")")/../../data
library=$(find /usr/lib -name libfaketimeMT.so.1 2>/dev/null | head -n 1)
[ -n "$library" ] || { echo "clock.sh: libfaketime is not installed (Debian: faketime)" >&2; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export XDG_CACHE_HOME=$folder/cache

{
  printf 'size = [72, 64]\nseeds = [1, 2]\nformat = "exr"\n[[exemplar]]\nname = "granite"\nimage = "%s/granite.png"\nmax_side = 72\n' "$data"
  for kind in quilting pixel phase; do printf '[[method]]\nname = "%s"\nkind = "%s"\n' $kind $kind; done
  printf '[[method]]\nname = "neural"\nkind = "neural"\nlayout = "noise"\niterations = [20]\n'
} >config.toml
"$gramloom" run config.toml --threads 1 --quiet --output whole || { echo "the undisturbed run failed" >&2; exit 1; }

"$gramloom" check config.toml >/dev/null  # measures the machine's speed

faults=0 runs=0
fault() { echo "FAULT (jump $jump, time $i): $*" >&2; faults=$((faults + 1)); }

pictures() { (cd "$1" && find . -name '*.png' -o -name '*.exr' | sort); }
run() {
  LD_PRELOAD=$library DONT_FAKE_MONOTONIC=1 FAKETIME_DONT_FAKE_MONOTONIC=1 NO_FAKE_STAT=1 \
    FAKETIME_NO_CACHE=1 FAKETIME_TIMESTAMP_FILE=$folder/now timeout 120 \
    "$gramloom" run config.toml --threads 1 --output out "$@"
}
finished() { grep -ls '"status": "done"' out/*/*/seed*.json | sed 's/json$/exr/' | xargs -r stat -c '%n %i %Y'; }

for jump in -1h -1d +1h +1y -1y; do
  for ((i = 0; i < times; ++i)); do
    runs=$((runs + 1))
    rm -rf out
    echo +0 >now
    run --jobs $((1 + i % 2)) >log 2>&1 &
    process=$!
    sleep "0.$((RANDOM % 9 + 1))"
    echo $jump >now  # in the middle
    if [ $((i % 3)) != 0 ]; then
      sleep "0.$((RANDOM % 9 + 1))"
      pkill -TERM -P $process  # of timeout's child, which ends orderly
      wait $process
      case $? in 0 | 130) ;; *) fault "stopped with $?"; tail -n 3 log >&2 ;; esac
      # As where the clock was set the other way since.
      case $jump in -*) by="+${jump#-}" ;; *) by="-${jump#+}" ;; esac
      by=$(sed 's/h$/ hour/; t; s/d$/ day/; t; s/y$/ year/' <<<"$by")
      [ -d out ] && find out cache -type f -exec touch -h -d "$by" {} +
      before=$(finished)
      run --resume --jobs $((1 + RANDOM % 2)) >>log 2>&1 || fault "resuming failed: $(tail -n 1 log)"
      [ -z "$(comm -23 <(sort <<<"$before") <(finished | sort))" ] || fault "finished jobs were done again"
    else
      wait $process || fault "failed: $(tail -n 1 log)"
    fi
    diff <(pictures out) <(pictures whole) >&2 || fault "other pictures"
    while read -r file; do cmp "out/$file" "whole/$file" >&2 || fault "$file differs"; done < <(pictures whole)
    diff <(cut -d, -f1-5,8- out/scores.csv) <(cut -d, -f1-5,8- whole/scores.csv) >&2 || fault "other scores"
    grep -E '(in|left|after) -[0-9]' log >&2 && fault "negative times"
    grep -rE '"(score_)?seconds": -' out --include='*.json' >&2 && fault "negative times"
    find out -name '.*.tmp' -o -name '*.lock' -o -name '*.checkpoint*' | grep . >&2 && fault "left-overs"
  done
done
echo "$runs runs, $faults faults"
[ $faults = 0 ]
