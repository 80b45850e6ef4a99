# The Python package `plumb` and its compiled parts, from tools/ into .venv; sourced by tools/setup.

# A build holds as long as what it was made of: these files, and what CMake found on this machine.
plumb_sources=(pyproject.toml tools/CMakeLists.txt tools/requirements_lab.txt)

setup_plumb() {
  local wanted note=.venv/plumb.note
  if [ ! -f pyproject.toml ]; then
    say "does not install the package plumb: pyproject.toml is missing"
    return
  fi
  wanted=$(made_of)
  if same_as "$note" "$wanted"; then return; fi

  say "builds and installs the package plumb"
  .venv/bin/pip install --disable-pip-version-check --no-build-isolation --no-deps -e . \
    >"$log" 2>&1 ||
    stop "plumb does not build: $(grep -iE '(^|[ :])error' "$log" | head -n 1) (all of it in .setup.log)"
  printf '%s\n' "$wanted" >"$note"
}

# One number for all that the compiled modules are made of, and for the modules that the installation lists.
made_of() {
  {
    find tools/plumb -name '*.py' | sort
    fingerprint "${plumb_sources[@]}"
    (cd tools && ../.venv/bin/python -B -m plumb.text.compiled)
    "${CXX:-c++}" --version
    cmake --version
    .venv/bin/python --version
    for library in simavr elf; do fingerprint "$(readlink -f "$(library_file "$library")")"; done
    fingerprint /usr/include/eigen3/Eigen/src/Core/util/Macros.h
  } 2>&1 | sha256sum | cut -d ' ' -f 1
}

# Where the compiler finds a library; its bare name if it has none.
library_file() { "${CXX:-c++}" "-print-file-name=lib$1.so"; }
