# The project's Python packages in .venv; sourced by tools/setup.

# setup_python SET: SET is "lab" or "all".
setup_python() {
  local wanted note=.venv/requirements.note list=tools/requirements.txt
  wanted=$(fingerprint tools/requirements*.txt)
  if same_as "$note" "$wanted all" || same_as "$note" "$wanted $1"; then return; fi

  [ "$1" = all ] || list=tools/requirements_lab.txt
  if [ ! -x .venv/bin/pip ]; then
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
      stop "needs Python 3.11 or newer as python3"
    say "makes .venv"
    python3 -m venv --clear .venv >"$log" 2>&1 ||
      stop "cannot make .venv: $(tail -n 1 "$log")"
  fi
  say "installs the Python packages of $list"
  install_packages -r "$list"
  printf '%s %s\n' "$wanted" "$1" >"$note"
}

install_packages() {
  .venv/bin/pip install --disable-pip-version-check "$@" >"$log" 2>&1 ||
    stop "pip failed: $(grep -i '^error' "$log" | tail -n 1) (all of it in .setup.log)"
}
