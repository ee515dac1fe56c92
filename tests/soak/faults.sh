#!/usr/bin/env bash
# Runs on which the system's calls fail at random (libfiu: Debian's fiu-utils), on a disk that is
# full, beyond a quota (btrfs-progs), and in a folder that cannot be written or vanishes: never a
# crash, never a result called done that is not whole; exit code 0 only where all of the run is there
# and whole, 1 only with a line for each job that is not; and afterwards --resume ends with an
# undisturbed run's bytes. Needs root for the full disk and the quota.
#   tests/soak/faults.sh [TIMES] [build/gramloom] [FORMAT]      of the textures' files: png, tif, exr, jpg
set -uo pipefail
times=${1:-20}
gramloom=$(readlink -f "${2:-build/gramloom}")
format=${3:-png}
data=$(dirname "$(readlink -f "$0")")/../../data
command -v fiu-run >/dev/null || { echo "faults.sh: fiu-run is not installed (Debian: fiu-utils)" >&2; exit 77; }
folder=$(mktemp -d)
clean_up() { umount "$folder/small" "$folder/shared" 2>/dev/null; rm -rf "$folder"; }
trap clean_up EXIT
cd "$folder" || exit 1

{
  printf 'size = [72, 64]\nseeds = [1, 2]\nformat = "%s"\n' "$format"
  printf '[[exemplar]]\nname = "granite"\nimage = "%s/granite.png"\nmax_side = 72\n' "$data"
  for kind in quilting patchmatch phase; do printf '[[method]]\nname = "%s"\nkind = "%s"\n' $kind $kind; done
  printf '[[method]]\nname = "neural"\nkind = "neural"\nlayout = "noise"\niterations = [20]\n'
} >all.toml
# oneDNN writes its code to memory that it asks for by mmap, and crashes where it gets none: known, and
# not ours to mend. With --jobs it fails its job alone. So does libcpuinfo, which LibTorch asks what the
# processor can, where what it reads of /proc and /sys fails.
head -n -5 all.toml >classic.toml  # without the last method
arguments=(--quiet --threads 1)
for config in all classic; do  # into folders of their names
  "$gramloom" run $config.toml "${arguments[@]}" --output $config || { echo "the undisturbed run failed" >&2; exit 1; }
done

faults=0 runs=0 failed=0
fault() { echo "FAULT ($what): $*" >&2; faults=$((faults + 1)); }

# The page itself says which views it lacks.
files() { (cd "$1" && find . -type f ! -name '.*.tmp' ! -name '*.lock' ! -path './page/*' -printf '%P\n' | sort); }
is_done() { grep -qs '"status": "done"' "$1"; }
scores() { cut -d, -f1-5,8- "$1"; }  # without time and memory

expect_all() {  # that a folder holds all of the undisturbed run of $config
  local file
  diff <(files "$1") <(files $config) >&2 || fault "other files than an undisturbed run's"
  while read -r file; do
    case $file in
      *.png | *."$format" | */diversity.json) cmp "$1/$file" "$config/$file" >&2 || fault "$file differs" ;;
      */seed*.json) is_done "$1/$file" || fault "$file is not done" ;;
      scores.csv) diff <(scores "$1/$file") <(scores "$config/$file") >&2 || fault "other scores" ;;
      index.html) tail -n 2 "$1/$file" | grep -q '</html>' || fault "the page is cut off" ;;
    esac
  done < <(files $config)
}

judge() {  # exit code, folder
  local record job
  runs=$((runs + 1))
  [ "$1" = 0 ] || failed=$((failed + 1))
  for record in $config/*/*/seed*.json; do
    job=${record#"$config"/} job=${job%.json}
    if is_done "$2/$job.json"; then
      cmp -s "$2/$job.$format" "$config/$job.$format" || fault "$job is called done and is not whole"
    elif [ "$1" = 1 ]; then
      grep -q "^$job: failed: .\|^gramloom: [^n]" log || fault "exit code 1 and no word of $job"
    fi
  done
  case $1 in
    0) expect_all "$2" ;;
    1) [ -s log ] || fault "exit code 1 without a word" ;;
    2) [ "$(wc -l <log)" = 1 ] || fault "exit code 2 and not one line" ;;
    *) fault "exit code $1" ;;
  esac
  [ $faults = "$known" ] || { known=$faults; tail -n 20 log >&2; }
}
known=0

resume() {
  rm -f log
  "$gramloom" run $config.toml "${arguments[@]}" --output "$1" --resume >log 2>&1 || fault "resuming failed: $(tail -n 1 log)"
  expect_all "$1"
  known=$faults
}

expect_lines() {  # that all that was said are lines of this trouble, no more than there are things to write
  grep -v "$1" log >&2 && fault "other words than of: $1"
  [ "$(wc -l <log)" -le 20 ] || fault "$(wc -l <log) lines"
}

for call in posix/io/rw/write posix/io/rw/read posix/io/oc/open posix/io/sync/fsync posix/io/dir/rename \
            posix/io/oc/close posix/mm/mmap libc/mm/malloc libc/mm/realloc; do
  for ((i = 0; i < times; ++i)); do
    what="$call, time $i"
    rm -rf out
    probability=0.$(printf '%03d' $((1 << RANDOM % 8)))
    [[ $call == libc/mm/* ]] && probability=0.0000$((RANDOM % 90 + 10))
    config=all
    [[ $call == posix/mm/mmap || $call == posix/io/rw/read ]] && config=classic
    timeout 120 fiu-run -x -c "enable_random name=$call,probability=$probability" \
      "$gramloom" run $config.toml "${arguments[@]}" --output out --jobs $((1 + i % 2)) >log 2>&1
    judge $? out
    [ $((i % 5)) = 0 ] && resume out
  done
done

config=all
needed=$(du -sk all | cut -f1)
mkdir small shared
for ((i = 0; i < times; ++i)); do  # the space ends with the first file, or the last, or between
  kilobytes=$((32 + RANDOM % needed))
  what="full disk of $kilobytes KB"
  if ! mount -t tmpfs -o size=${kilobytes}k tmpfs small 2>/dev/null; then
    echo "no full disk without root" >&2
    break
  fi
  "$gramloom" run all.toml "${arguments[@]}" --output small/out --jobs $((1 + i % 2)) >log 2>&1
  judge $? small/out
  expect_lines 'No space left on device'
  mount -o remount,size=20m small
  resume small/out
  umount small
done

# What a user may use of a disk: of all file systems with quotas, btrfs needs the least of the kernel.
truncate -s 256M disk
if mkfs.btrfs -q disk >/dev/null 2>&1 && mount -o loop disk shared 2>/dev/null && btrfs quota enable shared; then
  for ((i = 0; i < times; ++i)); do
    kilobytes=$((48 + RANDOM % needed))
    what="quota of $kilobytes KB"
    btrfs -q subvolume create shared/user && btrfs qgroup limit ${kilobytes}k shared/user || break
    "$gramloom" run all.toml "${arguments[@]}" --output shared/user/out --jobs $((1 + i % 2)) >log 2>&1
    judge $? shared/user/out
    expect_lines 'Disk quota exceeded'
    btrfs qgroup limit none shared/user
    resume shared/user/out
    btrfs -q subvolume delete -c shared/user
  done
else
  echo "no quota without root, btrfs-progs and a kernel that knows btrfs" >&2
fi

what="folder that cannot be written"
mkdir closed && chmod 500 closed
[ "$(id -u)" = 0 ] || { "$gramloom" run all.toml "${arguments[@]}" --output closed/out >log 2>&1; judge $? closed/out; }

what="folder that vanishes"
"$gramloom" run all.toml "${arguments[@]}" --output gone >log 2>&1 &
sleep 0.4
rm -rf gone
wait $!
judge $? gone

echo "$runs runs, of which $failed said that something failed; $faults faults"
[ $faults = 0 ]
