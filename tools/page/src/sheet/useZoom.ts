// How large the sheet is drawn: enlarged, it is wider than its frame, which then scrolls.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Pair } from "./view";

const STEP = 1.6; // of a press
const MOST = 16;

export interface Zoom {
  times: number;
  enlarge: () => void;
  lessen: () => void;
  all: () => void;
  /** Brings a place of the drawing [px] into the middle of the frame. */
  show: (place: Pair) => void;
}

export function useZoom(frame: { current: HTMLElement | null }): Zoom {
  const [times, setTimes] = useState(1);
  const before = useRef(times);
  // Keep the middle where it is.
  useLayoutEffect(() => {
    const ratio = times / before.current;
    before.current = times;
    const {
      scrollLeft = 0,
      scrollTop = 0,
      clientWidth = 0,
      clientHeight = 0,
    } = frame.current ?? {};
    show([(scrollLeft + clientWidth / 2) * ratio, (scrollTop + clientHeight / 2) * ratio]);
  }, [times]);
  const show = ([x, y]: Pair) =>
    frame.current?.scrollTo(x - frame.current.clientWidth / 2, y - frame.current.clientHeight / 2);
  return {
    times,
    enlarge: () => setTimes((now) => Math.min(MOST, now * STEP)),
    lessen: () => setTimes((now) => Math.max(1, now / STEP)),
    all: () => setTimes(1),
    show,
  };
}
