#!/usr/bin/env bash
# Runs every fuzz target for some seconds, two at a time, and fails when one finds something.
#   cmake --preset fuzz && cmake --build --preset fuzz && tests/fuzz/run.sh [SECONDS] [TARGET...]
# What was found lies in build-fuzz/found, and what reaches new code in build-fuzz/corpus: runs go
# on from there. 20 seconds show what a change has broken, hours what nobody has thought of.
set -uo pipefail
root=$(readlink -f "$(dirname "$0")/../..")
build=${GRAMLOOM_FUZZ_BUILD:-$root/build-fuzz}
seconds=${1:-20}
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(config set network tensors records tables mesh picture)

seeds() {  # what we ship that a target reads
  case $1 in
    config) cp "$root"/configs/*.toml "$2" ;;
    set) printf '%s\n' 'size=[64, 64]' 'method.n.iterations=[5]' 'patch_sizes=[7, 5]' 'exemplar.e.max_side=64' \
           'tile="both"' 'fill.mask=hole.png' | split -l 1 - "$2/set" ;;
    network) cp "$root"/models/*.toml "$2" ;;
    tensors) for file in "$root"/models/*.safetensors; do head -c 65536 "$file" >"$2/$(basename "$file")"; done ;;
    records) find "$root"/tests -name '*.json' -exec cp {} "$2" \; ;;
    tables) printf 'step,evaluations,seconds,loss,a\n1,2,0.5,1e-3,4\n' >"$2/trace"
            printf 'exemplar,method,kind,seed,status,seconds,peak_memory_mb,x\ne,m,k,1,done,1,2,3\n' >"$2/scores"
            printf 'angle,picture\n1,a.png\n2,b.png\n' >"$2/poses" ;;
    mesh) printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n' >"$2/triangle" ;;
    picture) for file in "$root"/data/{granite,clouds_mask}.png; do { printf '\0'; cat "$file"; } >"$2/$(basename "$file")"; done
             printf '\6P6 2 2 255 abcdefghijkl' >"$2/ppm" ;;
  esac
}

fuzz() {
  local target=$1 corpus=$build/corpus/$1 found=$build/found/$1
  mkdir -p "$corpus" "$found"
  seeds "$target" "$corpus" 2>/dev/null
  local log=$found/log
  # No more memory than a reader may want; the leaks of libraries that are never unloaded are theirs.
  # No reader takes a second: a minute is for a machine that is busy with other things.
  { time ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 "$build/tests/fuzz/${target}_fuzz" \
    -max_total_time="$seconds" -timeout=60 -rss_limit_mb=4096 -max_len=65536 -artifact_prefix="$found/" \
    -print_final_stats=1 "$corpus" >"$log" 2>&1; } 2>"$found/cpu"
  local code=$?
  echo "$target: $(sed -n 's/stat::number_of_executed_units: *//p' "$log") executions, $(<"$found/cpu") CPU seconds," \
    "$(find "$found" -name 'crash-*' -o -name 'oom-*' -o -name 'timeout-*' | wc -l) findings"
  return $code
}

TIMEFORMAT='%U + %S'
failed=0 running=0
for target in "${targets[@]}"; do
  fuzz "$target" &
  if [ $((++running)) = 2 ]; then wait -n || failed=1; running=1; fi
done
while [ $running -gt 0 ]; do wait -n || failed=1; running=$((running - 1)); done
exit $failed
