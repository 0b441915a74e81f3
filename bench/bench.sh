#!/usr/bin/env bash
# ./run bench [NAME]: one benchmark, or all of them. Called by ./run, which has built them into build/bench.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$PWD/build/bench/bin
export PATH=$bin:$PATH

names() {
  for script in bench/*.py; do basename "$script" .py; done
  for program in "$bin"/bench_*; do [ -x "$program" ] && basename "$program" | sed 's/^bench_//'; done
}

run_one() {
  printf '\n== %s\n' "$1"
  if [ -f "bench/$1.py" ]; then
    python3 "bench/$1.py"
  elif [ -x "$bin/bench_$1" ]; then
    "$bin/bench_$1"
  else
    printf 'run: error: there is no benchmark %s; there are: %s\n' "$1" "$(names | tr '\n' ' ')" >&2
    exit 2
  fi
}

if [ "$1" = all ]; then
  for name in $(names); do run_one "$name"; done
else
  run_one "$1"
fi
