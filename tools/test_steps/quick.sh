# The short run: what the files touch that differ from the last commit; sourced by tools/test.

quick() {
  local file
  if ! git rev-parse --verify --quiet HEAD >/dev/null; then
    printf 'test: quick asks git what was edited, and this folder is no clone; use tools/test\n' >&2
    exit 2
  fi
  suites=()
  rooms=()
  to_check=("${quick_checks[@]}")
  builds_firmware=no
  for file in $(edited); do touched_by "$file"; done
  parts=(checks)
  # The other core builds and runs the suites meanwhile.
  checks $(each_once "" "${to_check[@]}") &
  [ "$builds_firmware" = no ] || build_quickly
  if [ "${#suites[@]}" -gt 0 ]; then
    parts+=("host tests")
    host_tests $(each_once --filter "${suites[@]}")
  fi
  wait
  if [ "${#rooms[@]}" -gt 0 ]; then
    parts+=(setup "Python tests")
    one "setup" tools/setup
    python_tests --numprocesses 2 --dist loadfile -m "not slow" $(each_once "" "${rooms[@]}")
  fi
  say_left_out
}

build_quickly() {
  parts+=(firmware)
  one "firmware" .venv/bin/pio run -e megaatmega2560
}

# Files that differ from the last commit, new ones too.
edited() {
  git diff --name-only --diff-filter=d HEAD
  git ls-files --others --exclude-standard
}

# touched_by FILE: adds the suites (folders of test), rooms (folders of tools/tests) and slow checks
# to run.
touched_by() {
  local room project=tools/tests/project
  case "$1" in
    lib/* | src/* | include/* | platformio.ini) builds_firmware=yes ;;
  esac
  case "$1" in
    tools/plumb/* | tools/mypy.ini) to_check+=(annotations generated) ;;
    docs/* | lib/Kinematics/* | src/settings_table.h) to_check+=(generated) ;;
  esac
  case "$1" in
    lib/Kinematics/*) suites+=(test_kinematics test_effects) rooms+=(tools/tests/model) ;;
    lib/GCode/*) suites+=(test_gcode test_dialogues) ;;
    lib/Motion/*) suites+=(test_motion test_control) ;;
    lib/Settings/*) suites+=(test_settings) ;;
    src/board/*) suites+=(test_board) ;;
    src/*) suites+=(test_machine test_dialogues) rooms+=(tools/tests/settings) ;;
    test/dialogues/*) suites+=(test_dialogues) ;;
    test/programs/*) suites+=(test_dialogues) rooms+=(tools/tests/jobs) ;;
    test/test_*/*) suites+=("$(cut -d / -f 2 <<<"$1")") ;;
    test/vm/*) rooms+=(tools/tests/firmware) ;;
    tools/judge/*) suites+=(test_reference) ;;
    tools/vm/*) suites+=(test_control test_dialogues) rooms+=(tools/tests/firmware tools/tests/vm) ;;
    tools/plumb/*/* | tools/tests/*/*)
      room=tools/tests/$(cut -d / -f 3 <<<"$1")
      # An edited test alone asks for itself.
      case "$1" in tools/tests/*/test_*.py) room=$1 ;; esac
      [ ! -e "$room" ] || rooms+=("$room")
      ;;
    tools/checks/*) rooms+=("$project/test_project_checks.py" "$project/test_cxx_checks.py") ;;
    tools/mutation/*) rooms+=("$project/test_mutation.py") ;;
    tools/setup | tools/setup_steps/*) rooms+=("$project/test_setup.py") ;;
    tools/test | tools/test_steps/*) rooms+=("$project/test_test_run.py") ;;
    tools/bench/*) rooms+=("$project/test_bench.py") ;;
    tools/dry_run/*) rooms+=(tools/tests/jobs) ;;
    tools/core/*) rooms+=("$project/test_core_types.py" tools/tests/model) ;;
    tools/*) rooms+=("$project") ;;
    docs/* | *.md) rooms+=("$project/test_docs.py" "$project/test_recipes.py") ;;
  esac
}

# each_once OPTION NAME...: each name once, with an option in front of it unless that is empty.
each_once() {
  local name
  for name in $(printf '%s\n' "${@:2}" | sort -u); do printf '%s ' "$1" "$name"; done
}

say_left_out() {
  local check
  printf '\nLeft out: fuzz, bench, slow Python tests'
  for check in "${slow_checks[@]}"; do
    [[ " ${to_check[*]} " == *" $check "* ]] || printf ', check %s' "$check"
  done
  printf ', and every suite but: %s%s\n' \
    "$(each_once "" "${suites[@]}")" "$(each_once "" "${rooms[@]}")"
}
