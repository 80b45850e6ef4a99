# What builds the page of the lab: npm packages at the versions of the lock file; sourced by tools/setup.

setup_page() {
  local wanted note=tools/page/node_modules/.plumb.note
  wanted=$(fingerprint tools/page/package-lock.json)
  if same_as "$note" "$wanted"; then return; fi

  say "installs the npm packages of the lab's page"
  (cd tools/page && PATH=$root/.venv/bin:$PATH "$root/.venv/bin/npm" ci --no-audit --no-fund) >"$log" 2>&1 ||
    stop "npm failed: $(grep -i 'error' "$log" | head -n 1) (all of it in .setup.log)"
  printf '%s\n' "$wanted" >"$note"
}
