// A value that changes many times a second, taken over now and then: for what is slow to draw.
import { useEffect, useRef, useState } from "preact/hooks";
import { later } from "../api/rest";

const PAUSE_MS = 200;

/** The value as it was at most a pause ago; at once where it had rested for that long. */
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
