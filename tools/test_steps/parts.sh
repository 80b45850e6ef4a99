# The parts of a test run: each leaves its output and its counts in $results; sourced by tools/test.

quick_checks=(arrows effects unused size names formatting words prose programs)
slow_checks=(annotations generated)

# Nothing of an earlier run counts.
set_out() {
  rm -rf "$results"
  mkdir -p "$results"
}

# one PART COMMAND...: a part that passes or fails as a whole.
one() {
  local began=$SECONDS
  if "${@:2}" >"$results/$1.log" 2>&1; then
    record "$1" 1 0 "$began"
  else
    record "$1" 0 1 "$began"
    return 1
  fi
}

# many PART FILE COMMAND...: a part whose tests are counted in the JUnit file that the command writes.
many() {
  local began=$SECONDS status
  "${@:3}" >"$results/$1.log" 2>&1
  status=$?
  # A status besides the counts, for a command that died before it could count.
  # shellcheck disable=SC2046  # two words: passed, failed
  record "$1" $("$python" tools/count_tests.py "$2" "$status") "$began"
}

# checks [NAME...]: each check counts as a test; those named, or all, run at once.
checks() {
  local began=$SECONDS check good=0 bad=0 running=() names=("$@")
  [ $# -gt 0 ] || names=("${quick_checks[@]}" "${slow_checks[@]}")
  for check in "${names[@]}"; do
    "$python" "tools/checks/$check.py" >"$results/check_$check.log" 2>&1 &
    running+=("$!")
  done
  for check in "${running[@]}"; do
    if wait "$check"; then good=$((good + 1)); else bad=$((bad + 1)); fi
  done
  for check in "${names[@]}"; do cat "$results/check_$check.log"; done >"$results/checks.log"
  record "checks" "$good" "$bad" "$began"
}

# record PART PASSED FAILED BEGAN: notes the counts and shows the output; two lanes take turns.
record() {
  printf '%s %s %s\n' "$2" "$3" "$((SECONDS - $4))" >"$results/$1.counts"
  {
    flock 9
    printf '\n=== %s ===\n' "$1"
    cat "$results/$1.log"
  } 9>"$results/turn"
}

# One row for each of $parts, then the sum. A part without counts died, or was never reached: it failed.
summary() {
  local part passed failed seconds all_passed=0 all_failed=0
  printf '\n=== summary ===\n'
  for part in "${parts[@]}"; do
    passed=0 failed=1 seconds=-
    [ ! -s "$results/$part.counts" ] || read -r passed failed seconds <"$results/$part.counts"
    printf '%-20s %6d passed %6d failed %6s s\n' "$part" "$passed" "$failed" "$seconds"
    all_passed=$((all_passed + passed)) all_failed=$((all_failed + failed))
  done
  printf '%d passed, %d failed in %d s\n' "$all_passed" "$all_failed" "$SECONDS"
  [ "$all_failed" = 0 ] && [ "$all_passed" -gt 0 ]
}
