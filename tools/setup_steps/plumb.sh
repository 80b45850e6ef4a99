# The Python package `plumb` and its compiled parts, from tools/ into .venv; sourced by tools/setup.

# A change in one of these needs a new build; other Python files are used where they stand.
plumb_sources=(
  tools/pyproject.toml tools/CMakeLists.txt tools/core tools/dry_run tools/judge tools/vm lib src
  tools/requirements_lab.txt
)

setup_plumb() {
  local wanted note=.venv/plumb.note
  if [ ! -f tools/pyproject.toml ]; then
    say "does not install the package plumb: tools/pyproject.toml is missing"
    return
  fi
  wanted=$(fingerprint "${plumb_sources[@]}")
  if same_as "$note" "$wanted"; then return; fi

  say "builds and installs the package plumb"
  .venv/bin/pip install --disable-pip-version-check --no-build-isolation --no-deps -e tools \
    >"$log" 2>&1 ||
    stop "plumb does not build: $(grep -iE '(^|[ :])error' "$log" | head -n 1) (all of it in .setup.log)"
  printf '%s\n' "$wanted" >"$note"
}
