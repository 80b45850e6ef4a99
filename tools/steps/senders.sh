# The Grbl senders that tests drive, into .build/senders: CNCjs from npm, bCNC and two libraries from PyPI.
# Sourced by tools/setup.

senders_list=tools/tests/senders/programs
senders_folder=.build/senders

setup_senders() {
  local wanted
  [ -x .venv/bin/npm ] || stop "the senders need Node.js of .venv; run tools/setup first"
  wanted=$(fingerprint "$senders_list")
  if same_as "$senders_folder/note" "$wanted"; then return; fi

  say "installs CNCjs, bCNC and two libraries, which tests drive"
  mkdir -p "$senders_folder"
  rm -f "$senders_folder/note" "$senders_folder/failure"
  cp "$senders_list/package.json" "$senders_list/package-lock.json" "$senders_folder"
  (cd "$senders_folder" && PATH=$root/.venv/bin:$PATH "$root/.venv/bin/npm" ci --ignore-scripts --no-audit --no-fund) \
    >"$log" 2>&1 || no_sender "CNCjs: $(grep -i 'error' "$log" | head -n 1)"
  .venv/bin/pip install --disable-pip-version-check --no-deps --upgrade --target "$senders_folder/python" \
    -r "$senders_list/requirements.txt" >"$log" 2>&1 || no_sender "what comes from PyPI: $(grep -i '^error' "$log" | tail -n 1)"
  printf '%s\n' "$wanted" >"$senders_folder/note"
}

# The tests of senders fail with this line: they are slow ones, and all others can run.
no_sender() {
  printf 'cannot install %s (all of it in .setup.log)\n' "$1" >"$senders_folder/failure"
  stop "$(<"$senders_folder/failure")"
}
