// A value that changes many times a second, throttled for slow drawings.
import { useEffect, useRef, useState } from "preact/hooks";
import { later } from "../api/rest";

const PAUSE_MS = 200;

/** The value, at most one pause old; updated at once if it had not changed for that long. */
export function useRested<Value>(value: Value): Value {
  const [shown, setShown] = useState(value);
  const last = useRef(0);
  useEffect(() => {
    const wait = Math.max(0, last.current + PAUSE_MS - performance.now());
    return later(() => {
      last.current = performance.now();
      setShown(value);
    }, wait);
  }, [value]);
  return shown;
}
