#!/usr/bin/env bash
# clang-tidy over the translation units of the release build: lint.sh JOBS all|names
# `names` checks the naming rules alone, in lib and tools: what CI has the time for.
# A unit that passed is not read again until it, a header of the repository or the rules change.
set -euo pipefail
cache=${XDG_CACHE_HOME:-$HOME/.cache}/copse-lint
mkdir -p "$cache"
only=() folders=(lib tools bench tests)
if [ "$2" = names ]; then only=(--checks=-*,readability-identifier-naming) folders=(lib tools); fi
rules=$(cat <(printf '%s\n' "${only[@]}") .clang-tidy $(git ls-files '*.h') | sha256sum | cut -c1-32)
export cache rules
export tidy_checks="${only[*]}"

check() {
  local key
  key=$(printf '%s %s' "$rules" "$(sha256sum <"$1")" | sha256sum | cut -c1-32)
  [ -e "$cache/$key" ] && return 0
  # shellcheck disable=SC2086  # none, or one word
  clang-tidy-19 --quiet $tidy_checks -p build/release --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-deprecated-declarations "$1" 2>/dev/null || {
    printf 'lint: %s breaks a rule of .clang-tidy (above)\n' "$1" >&2
    return 1
  }
  : >"$cache/$key"
}
export -f check

# CGAL's headers are not for clang 19, so the files that see them are left to the compiler.
git ls-files -- "${folders[@]/%//*.cpp}" | grep -v '_cgal\.cpp$' |
  while read -r file; do grep -qF "/$file\"" build/release/compile_commands.json && printf '%s\n' "$file"; done |
  xargs -P "$1" -I{} bash -c 'check "$1"' _ {}
