#!/usr/bin/env bash
# clang-tidy over every translation unit of the release build. A unit that passed is not read again until it, a
# header of the repository or the rules change: lint.sh JOBS
set -euo pipefail
cache=${XDG_CACHE_HOME:-$HOME/.cache}/copse-lint
mkdir -p "$cache"
rules=$(cat .clang-tidy $(git ls-files '*.h') | sha256sum | cut -c1-32)
export cache rules

check() {
  local key
  key=$(printf '%s %s' "$rules" "$(sha256sum <"$1")" | sha256sum | cut -c1-32)
  [ -e "$cache/$key" ] && return 0
  clang-tidy-19 --quiet -p build/release --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-deprecated-declarations "$1" 2>/dev/null || {
    printf 'lint: %s breaks a rule of .clang-tidy (above)\n' "$1" >&2
    return 1
  }
  : >"$cache/$key"
}
export -f check

# CGAL's headers are not for clang 19, so the files that see them are left to the compiler.
git ls-files 'lib/*.cpp' 'tools/*.cpp' 'bench/*.cpp' 'tests/*.cpp' | grep -v '_cgal\.cpp$' |
  while read -r file; do grep -qF "/$file\"" build/release/compile_commands.json && printf '%s\n' "$file"; done |
  xargs -P "$1" -I{} bash -c 'check "$1"' _ {}
