# The Grbl senders that tests drive, into .build/senders: CNCjs from npm, bCNC from PyPI.
# Sourced by tools/setup.

senders_list=tools/tests/senders/programs
senders_folder=.build/senders

setup_senders() {
  local wanted
  [ -x .venv/bin/npm ] || stop "the senders need Node.js of .venv; run tools/setup first"
  wanted=$(fingerprint "$senders_list")
  if same_as "$senders_folder/note" "$wanted"; then return; fi

  say "installs CNCjs and bCNC, which tests drive"
  mkdir -p "$senders_folder"
  rm -f "$senders_folder/note"
  cp "$senders_list/package.json" "$senders_list/package-lock.json" "$senders_folder"
  (cd "$senders_folder" && PATH=$root/.venv/bin:$PATH "$root/.venv/bin/npm" ci --ignore-scripts --no-audit --no-fund) \
    >"$log" 2>&1 || stop "cannot install CNCjs: $(grep -i 'error' "$log" | head -n 1)"
  .venv/bin/pip install --disable-pip-version-check --no-deps --upgrade --target "$senders_folder/python" \
    -r "$senders_list/requirements.txt" >"$log" 2>&1 || stop "cannot install what comes from PyPI: $(grep -i '^error' "$log" | tail -n 1)"
  printf '%s\n' "$wanted" >"$senders_folder/note"
}
