#!/usr/bin/env bash
# What the program takes before it does any work: the least CPU time and the largest memory of ten
# starts, for commands that need no picture, a job of a formula and a job with an exemplar.
#   tests/bench/startup.sh [PROGRAM]        needs GNU time (package time)
set -euo pipefail
program=$(readlink -f "${1:-build/gramloom}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >formula.toml <<'END'
size = [32, 32]
scores = false
[[method]]
name = "noise"
kind = "procedural"
texture = "noise"
END
"$program" run formula.toml --quiet >/dev/null
cp "$(find out -name '*.png' | head -1)" exemplar.png
cat >exemplar.toml <<'END'
size = [32, 32]
scores = false
[[exemplar]]
name = "e"
image = "exemplar.png"
[[method]]
name = "phase"
kind = "phase"
END

measure() {  # gramloom's arguments
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    /usr/bin/time -a -o times -f '%U %S %M' "$program" "$@" >/dev/null
  done
  awk -v command="gramloom $*" '
    { cpu = $1 + $2; if (NR == 1 || cpu < least) least = cpu; if ($3 > most) most = $3 }
    END { printf "%-40s %5.2f s CPU %6.0f MB\n", command, least, most / 1024 }' times
  rm times
}

measure --help
measure list
measure check formula.toml
measure run formula.toml --quiet
measure run exemplar.toml --quiet
