# The package for Windows, compiled here by MinGW, and a Windows Python under Wine that runs it, in
# .build/windows. Sourced by tools/setup.

windows_folder=.build/windows
cpython=org/bytedeco/cpython/3.11.3-1.5.9/cpython-3.11.3-1.5.9-windows-x86_64.jar
cpython_sha256=3263a50b256447bb7b9e604d6587627e419891370fc33b94469e6a06ff4de834

setup_windows() {
  local wanted
  wanted=$(fingerprint tools/windows tools/requirements_lab.txt)
  if ! same_as "$windows_folder/python.note" "$wanted"; then
    rm -rf "$windows_folder"/python "$windows_folder"/*.note
    windows_python
    printf '%s\n' "$wanted" >"$windows_folder/python.note"
  fi
  wanted=$(fingerprint tools/plumb tools/core tools/judge tools/vm tools/dry_run tools/CMakeLists.txt lib src pyproject.toml)
  if ! same_as "$windows_folder/package.note" "$wanted"; then
    windows_package
    printf '%s\n' "$wanted" >"$windows_folder/package.note"
  fi
}

windows_python() {
  local site=$windows_folder/python/lib/site-packages packages=$windows_folder/packages jar=$windows_folder/cpython.jar
  mkdir -p "$packages"
  say "fetches a Python for Windows and its packages"
  if [ ! -f "$jar" ]; then
    .venv/bin/python -c 'import sys, urllib.request; urllib.request.urlretrieve(*sys.argv[1:])' \
      "https://repo1.maven.org/maven2/$cpython" "$jar" >"$log" 2>&1 || stop "cannot fetch Python for Windows: $(tail -n 1 "$log")"
  fi
  echo "$cpython_sha256  $jar" | sha256sum --quiet -c - >"$log" 2>&1 || { rm "$jar"; stop "Python for Windows came damaged"; }
  .venv/bin/python -m zipfile -e "$jar" "$windows_folder/jar"
  mv "$windows_folder/jar/org/bytedeco/cpython/windows-x86_64" "$windows_folder/python"
  rm -r "$windows_folder/jar"

  grep -vE '^(numpy|scipy|nanobind|scikit-build-core|ninja|cmake)\b' tools/requirements_lab.txt >"$packages.txt"
  cat tools/windows/requirements.txt >>"$packages.txt"
  .venv/bin/pip download --disable-pip-version-check --only-binary=:all: --platform win_amd64 --python-version 3.11 \
    --implementation cp -d "$packages" -r "$packages.txt" >"$log" 2>&1 || stop "pip failed: $(tail -n 1 "$log")"
  for wheel in "$packages"/*.whl; do .venv/bin/python -m zipfile -e "$wheel" "$site"; done
  cp tools/windows/sitecustomize.py "$site"
  # Wine 8 lacks the function by which Matplotlib turns its arrows.
  sed -i 's/np.exp(1j \* theta)/(np.cos(theta) + 1j * np.sin(theta))/' "$site/matplotlib/quiver.py"
  x86_64-w64-mingw32-gcc-posix -shared -o "$windows_folder/python/bcryptprimitives.dll" tools/windows/for_wine.c -ladvapi32
}

no_windows() {
  stop "the package for Windows does not compile: $(grep -m 1 -i error "$log") (all of it in .setup.log)"
}

# A wheel is a zip: that of this computer with the modules of Windows, and pip's door to the command.
windows_package() {
  local python=$windows_folder/python build=$windows_folder/build site=$windows_folder/python/lib/site-packages
  say "compiles the package for Windows"
  cmake -S tools -B "$build" -G Ninja -DCMAKE_MAKE_PROGRAM="$root/.venv/bin/ninja" \
    -DCMAKE_TOOLCHAIN_FILE="$root/tools/windows/mingw.cmake" -DPython_EXECUTABLE="$root/.venv/bin/python" \
    -DPython_INCLUDE_DIR="$root/$python/include" -DPython_LIBRARY="$root/$python/libs/python311.lib" \
    -DNB_SUFFIX=.pyd -DNB_SUFFIX_S=.pyd -Dnanobind_DIR="$(.venv/bin/python -m nanobind --cmake_dir)" \
    -DEigen3_DIR=/usr/share/eigen3/cmake -DSKBUILD_SCRIPTS_DIR=scripts >"$log" 2>&1 || no_windows
  .venv/bin/ninja -C "$build" >>"$log" 2>&1 || no_windows
  cmake --install "$build" --prefix "$windows_folder/modules" >>"$log" 2>&1 || no_windows
  .venv/bin/python tools/windows/pack.py "$windows_folder/modules/plumb" "$windows_folder" >"$log" 2>&1 ||
    stop "no wheel for Windows: $(tail -n 1 "$log")"
  rm -rf "$site"/plumb "$site"/plumb_maslow-*
  .venv/bin/python -m zipfile -e "$windows_folder"/plumb_maslow-*.whl "$site"
  # Wine says a lot when it starts for the first time.
  tools/windows/python -c "" </dev/null 2>&1 | cat >"$log" || stop "Wine does not start: $(tail -n 1 "$log")"
}
