#!/usr/bin/env bash
# Installs a build into a folder of its own and uses it from there, by a program that is started elsewhere
# and by the examples as a project of their own:
#   tests/package/install.sh BUILD-FOLDER [EXAMPLE ...]      all examples, if none is named
set -euo pipefail
build=$(readlink -f "${1:?the build folder}")
shift
examples=$(readlink -f "$(dirname "$0")/../../examples")
temp=$(mktemp -d)
trap 'rm -rf "$temp"' EXIT
unset LD_LIBRARY_PATH GRAMLOOM_MODELS

cmake --install "$build" --prefix "$temp/usr" >/dev/null
mkdir "$temp/home"
cd "$temp/home"
gramloom=$temp/usr/bin/gramloom
share=$temp/usr/share/gramloom

# Our libraries are found beside each other, and none in the build folder.
if ldd "$gramloom" "$temp"/usr/lib/gramloom/*.so | grep -e 'gramloom.*not found' -e "$build"; then exit 1; fi
"$gramloom" check "$share/configs/quickstart.toml" >/dev/null
"$gramloom" make "$share/data/pebbles.png" --kind quilting --size 64 --output made.png --quiet
test -s made.png
# What its pages show and link came along.
documents=$temp/usr/share/doc/gramloom
for page in "$documents"/README.md "$documents"/docs/*.md; do
  for link in $(grep -oE '\]\([^)#: ]+' "$page" | cut -c3- || true); do
    test -e "$(dirname "$page")/$link" || { echo "$page: there is no $link"; exit 1; }
  done
done

# Every public header can be included with what the package asks for.
mkdir "$temp/headers"
(cd "$temp/usr/include/gramloom" && find . -name '*.h' -printf '#include "%P"\n' | sort) >"$temp/headers/all.cpp"
echo "static_assert(GRAMLOOM_VERSION_MAJOR >= 0 && sizeof GRAMLOOM_VERSION > 1);" >>"$temp/headers/all.cpp"
cat >"$temp/headers/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES CXX)
find_package(gramloom 0.1 REQUIRED)
add_library(headers OBJECT all.cpp)
target_link_libraries(headers PRIVATE gramloom::jobs gramloom::report)
add_subdirectory(${EXAMPLES} examples)
END
cmake -G Ninja -S "$temp/headers" -B "$temp/build" -DCMAKE_PREFIX_PATH="$temp/usr" -DEXAMPLES="$examples" >"$temp/log" 2>&1 ||
  { cat "$temp/log"; exit 1; }
targets=(headers)
for example; do targets+=("example_$example"); done
[ $# -gt 0 ] || targets=(all)
cmake --build "$temp/build" -j 2 --target "${targets[@]}" >"$temp/log" 2>&1 || { tail -30 "$temp/log"; exit 1; }
"$temp/build/examples/marble" block.png cut.png
test -s cut.png
