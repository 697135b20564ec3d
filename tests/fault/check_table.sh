#!/usr/bin/env bash
# Each fault from F1 to F24 has a row in README.md, and each test that the rows name exists.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
wrong=0
complain() { echo "tests/fault/README.md: $*"; wrong=$((wrong + 1)); }

for number in $(seq 1 24); do
  row="$(grep -E "^\| F$number \|" fault/README.md || true)"
  [ -n "$row" ] || { complain "F$number has no row"; continue; }
  tests="$(cut -d '|' -f 5 <<<"$row" | grep -oE '`[^`]+`' | tr -d '`' || true)"
  [ -n "$tests" ] || complain "F$number has no test"
  while read -r name; do
    case "$name" in
      *.*) grep -rqE "^TEST(_F|_P)?\(${name%%.*}, ${name#*.}\)" --include='*.cpp' . || complain "F$number: no test $name" ;;
      "stress "*) grep -q "{\"${name#stress }\"" fault/stress_main.cpp || complain "F$number: seaway-stress has no ${name#stress }" ;;
      fuzz_*) [ -f "fuzz/${name#fuzz_}.cpp" ] || complain "F$number: no fuzz target $name" ;;
      *) grep -rqE "NAME $name " --include=CMakeLists.txt . || complain "F$number: ctest has no $name" ;;
    esac
  done <<<"$tests"
done
[ "$wrong" -eq 0 ]
