#!/usr/bin/env bash
# Runs on which the system's calls fail at random (libfiu: Debian's fiu-utils), on a disk that is
# full, and in a folder that cannot be written or vanishes: never a crash, never a result called done
# that is not whole, and afterwards --resume ends with an undisturbed run's bytes. Needs root for the
# full disk.
#   tests/soak/faults.sh [TIMES] [build/gramloom]
set -uo pipefail
times=${1:-20}
gramloom=$(readlink -f "${2:-build/gramloom}")
data=$(dirname "$(readlink -f "$0")")/../../data
command -v fiu-run >/dev/null || { echo "faults.sh: fiu-run is not installed (Debian: fiu-utils)" >&2; exit 77; }
folder=$(mktemp -d)
clean_up() { umount "$folder/small" 2>/dev/null; rm -rf "$folder"; }
trap clean_up EXIT
cd "$folder" || exit 1

{
  printf 'size = [72, 64]\nseeds = [1, 2]\n[[exemplar]]\nname = "granite"\nimage = "%s/granite.png"\nmax_side = 72\n' "$data"
  for kind in quilting patchmatch phase; do printf '[[method]]\nname = "%s"\nkind = "%s"\n' $kind $kind; done
  printf '[[method]]\nname = "neural"\nkind = "neural"\nlayout = "noise"\niterations = [20]\n'
} >config.toml
# oneDNN writes its code to memory that it asks for by mmap, and crashes where it gets none: known, and
# not ours to mend. With --jobs it fails its job alone.
head -n -5 config.toml >classic.toml  # without the last method
arguments=(run config.toml --quiet --threads 1)
"$gramloom" "${arguments[@]}" --output whole || { echo "the undisturbed run failed" >&2; exit 1; }

faults=0 runs=0 failed=0
fault() { echo "FAULT ($what): $*" >&2; faults=$((faults + 1)); }

judge() {  # exit code, folder
  runs=$((runs + 1))
  [ "$1" = 0 ] || failed=$((failed + 1))
  case $1 in 0 | 1 | 2) ;; *) fault "exit code $1"; tail -n 3 log >&2 ;; esac
  local record picture
  for record in "$2"/*/*/seed*.json; do
    [ -f "$record" ] && grep -q '"status": "done"' "$record" || continue
    picture=${record%.json}.png
    cmp -s "$picture" "whole/${picture#"$2"/}" || fault "$picture is called done and is not whole"
  done
}

resume() {
  "$gramloom" "${arguments[@]}" --output "$1" --resume || fault "resuming failed"
  local file
  while read -r file; do cmp "$1/$file" "whole/$file" >&2 || fault "$file differs"; done < <(cd whole && find . -name '*.png')
}

for call in posix/io/rw/write posix/io/rw/read posix/io/oc/open posix/io/sync/fsync posix/io/dir/rename \
            posix/io/oc/close posix/mm/mmap libc/mm/malloc libc/mm/realloc; do
  for ((i = 0; i < times; ++i)); do
    what="$call, time $i"
    rm -rf out
    probability=0.$(printf '%03d' $((1 << RANDOM % 8)))
    [[ $call == libc/mm/* ]] && probability=0.0000$((RANDOM % 90 + 10))
    config=config.toml
    [ $call = posix/mm/mmap ] && config=classic.toml
    timeout 120 fiu-run -x -c "enable_random name=$call,probability=$probability" \
      "$gramloom" run $config --quiet --threads 1 --output out --jobs $((1 + i % 2)) >log 2>&1
    judge $? out
    [ $((i % 5)) = 0 ] && resume out
  done
done

what="full disk"
mkdir small
if mount -t tmpfs -o size=200k tmpfs small 2>/dev/null; then
  "$gramloom" "${arguments[@]}" --output small/out >log 2>&1
  judge $? small/out
  mount -o remount,size=20m small
  resume small/out
else
  echo "no full disk without root" >&2
fi

what="folder that cannot be written"
mkdir closed && chmod 500 closed
[ "$(id -u)" = 0 ] || { "$gramloom" "${arguments[@]}" --output closed/out >log 2>&1; judge $? closed/out; }

what="folder that vanishes"
"$gramloom" "${arguments[@]}" --output gone >log 2>&1 &
sleep 0.4
rm -rf gone
wait $!
judge $? gone

echo "$runs runs, of which $failed said that something failed; $faults faults"
[ $faults = 0 ]
