# The project's own Python in .venv, with the packages of tools/requirements.txt; sourced by tools/setup.

setup_python() {
  local wanted note=.venv/requirements.note
  wanted=$(fingerprint tools/requirements.txt)
  if same_as "$note" "$wanted"; then return; fi

  if [ ! -x .venv/bin/pip ]; then
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
      stop "needs Python 3.11 or newer as python3"
    say "makes .venv"
    python3 -m venv --clear .venv >"$log" 2>&1 ||
      stop "cannot make .venv: $(tail -n 1 "$log")"
  fi
  say "installs the Python packages of tools/requirements.txt"
  .venv/bin/pip install --disable-pip-version-check -r tools/requirements.txt >"$log" 2>&1 ||
    stop "pip failed: $(grep -i '^error' "$log" | tail -n 1) (all of it in .setup.log)"
  printf '%s\n' "$wanted" >"$note"
}
