# Compilers, simulator and libraries from Debian or Ubuntu; sourced by tools/setup.

debian_packages=(
  gcc-avr binutils-avr avr-libc arduino-core-avr avrdude  # the firmware
  simavr libsimavr-dev libelf-dev                         # the virtual machine
  g++ cmake libeigen3-dev googletest                      # host tests and the Python module
  python3-venv                                            # the project's own Python packages
)

setup_debian() {
  if ! command -v apt-get >/dev/null; then
    command -v g++ cmake simavr >/dev/null ||
      say "no apt-get here; install by other means what these packages hold: ${debian_packages[*]}"
    return
  fi
  local missing
  missing=$(missing_packages)
  [ -n "$missing" ] || return 0

  local as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  say "installs with ${as_root[*]:+sudo }apt-get:${missing//$'\n'/ }"
  "${as_root[@]}" apt-get update >"$log" 2>&1 ||
    stop "apt-get update failed: $(tail -n 1 "$log") (all of it in .setup.log)"
  # shellcheck disable=SC2086  # one word per package
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
    $missing >>"$log" 2>&1 ||
    stop "apt-get install failed: $(tail -n 1 "$log") (all of it in .setup.log)"
}

# Those of debian_packages that are not installed, each after a space.
missing_packages() {
  local installed package
  installed=" $(dpkg-query -W -f '${binary:Package}=${db:Status-Abbrev} ' "${debian_packages[@]}" \
    2>/dev/null | sed 's/:[a-z0-9]*=/=/g') " || true
  for package in "${debian_packages[@]}"; do
    [[ $installed == *" $package=ii "* ]] || printf ' %s' "$package"
  done
}
