# The packages of debian_packages.txt, from Debian or Ubuntu; sourced by tools/setup.

# setup_debian SET: SET is "lab" or "all".
setup_debian() {
  local missing
  if ! command -v apt-get >/dev/null; then
    command -v g++ cmake python3 >/dev/null ||
      stop "there is no apt-get here; install what these packages bring: $(packages_for "$1" | xargs)"
    return
  fi
  missing=$(missing_packages "$1")
  [ -n "$missing" ] || return 0

  local as_root=()
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || needs_administrator "$missing"
    sudo -v 2>/dev/null || needs_administrator "$missing"
    as_root=(sudo)
  fi
  say "installs with ${as_root[*]:+sudo }apt-get: $missing"
  "${as_root[@]}" apt-get update >"$log" 2>&1 ||
    stop "apt-get update failed: $(tail -n 1 "$log") (all of it in .setup.log)"
  # shellcheck disable=SC2086  # one word per package
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
    $missing >>"$log" 2>&1 ||
    stop "apt-get install failed: $(tail -n 1 "$log") (all of it in .setup.log)"
}

needs_administrator() {
  stop "an administrator has to install packages first: apt-get install --no-install-recommends $1"
}

# The packages that a set needs, a line each.
packages_for() {
  awk -F ' *[|] *' -v set="$1" '/^[^#]/ && ($2 == "lab" || $2 == set) { print $1 }' "$root/tools/steps/debian_packages.txt"
}

# Those of them that are not installed, on one line.
missing_packages() {
  local package missing=()
  for package in $(packages_for "$1"); do
    [ "$(dpkg-query -W -f '${db:Status-Abbrev}' "$package" 2>/dev/null)" = "ii " ] || missing+=("$package")
  done
  printf '%s' "${missing[*]}"
}
