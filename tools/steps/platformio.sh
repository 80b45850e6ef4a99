# PlatformIO's packages, where its registry cannot be reached: our stand-ins; sourced by tools/setup.

setup_platformio() {
  local wanted note=.platformio/stand_ins.note
  if [ ! -f "$note" ]; then
    # What is here without our note came from the registry.
    [ ! -d .platformio/platforms/atmelavr ] || return 0
    if registry_answers; then
      say "leaves PlatformIO's packages to its registry, which it asks when it first builds"
      return
    fi
  fi
  wanted=$(fingerprint tools/platformio_store)
  if same_as "$note" "$wanted" && stand_ins_are_here; then return; fi

  say "lays stand-ins for PlatformIO's packages into .platformio and .pio (its registry cannot be reached)"
  .venv/bin/python -B tools/platformio_store/install.py "$root" || exit 1
  keep_platformio_offline
  printf '%s\n' "$wanted" >"$note"
}

stand_ins_are_here() {
  ls -d .platformio/{platforms/{atmelavr,native},packages/tool-scons} .pio/libdeps/native/{googletest,ArduinoEigen} \
    >/dev/null 2>&1
}

registry_answers() {
  timeout 6 .venv/bin/python -c 'import sys, urllib.request as web; print(web.urlopen(sys.argv[1], timeout=3).read())' \
    https://api.registry.platformio.org/v3/packages/platformio/platform/atmelavr 2>/dev/null | grep -q '"name": *"atmelavr"'
}

# Without a network PlatformIO would wait for its statistics and its update check at the end of a command.
keep_platformio_offline() {
  .venv/bin/pio settings set enable_telemetry no >"$log" 2>&1
  .venv/bin/pio settings set check_platformio_interval 3650 >>"$log" 2>&1
}
