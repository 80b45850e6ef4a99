// How much of the sheet is drawn: Ctrl with the wheel, two fingers, a double click and buttons enlarge it, a drag moves it.
import { useMemo, useRef, useState } from "preact/hooks";
import { moved, scaleOf, type View, WHOLE } from "./scale";
import { type Pair, pointIn } from "./view";

const STEP = 1.6; // of a button
const TWICE_MS = 350; // between the clicks of a double click
const STILL = 6; // [px] that a finger slips in a click

export type Zoom = ReturnType<typeof useZoom>;

/** The zoom of a sheet with this size [mm], drawn so wide [px]. */
export function useZoom([width, height]: Pair, wide: number) {
  const [view, setView] = useState(WHOLE);
  const size = [width, height] as const;
  const scale = useMemo(() => scaleOf(size, wide, view), [width, height, wide, view]);
  const held = useRef({ fingers: new Map<number, Pair>(), path: 0, click: 0 }).current;
  const { plot } = scale;
  const middle = [(plot.left + plot.right) / 2, (plot.top + plot.bottom) / 2] as const;
  const move = (by: number, from: Pair, to = from) =>
    setView((now: View) => moved(size, wide, now, by, from, to));
  const release = (event: PointerEvent) => held.fingers.delete(event.pointerId);
  return {
    scale,
    times: view.times,
    enlarge: () => move(STEP, middle),
    lessen: () => move(1 / STEP, middle),
    all: () => setView(WHOLE),
    /** Brings a place of the drawing [px] into the middle. */
    show: (place: Pair) => move(1, place, middle),
    /** Whether a click ends a drag, or is the second of a double click, which enlarges. */
    takesClick: (event: MouseEvent) => {
      const isSecond = event.timeStamp - held.click < TWICE_MS;
      held.click = isSecond ? 0 : event.timeStamp;
      if (held.path > STILL) return true;
      if (isSecond) move(STEP ** 2, pointIn(event));
      return isSecond;
    },
    pointer: {
      onWheel: (event: WheelEvent) => {
        if (!event.ctrlKey && !event.metaKey) return;
        event.preventDefault();
        move(2 ** Math.max(-0.5, Math.min(0.5, -event.deltaY / 100)), pointIn(event));
      },
      // Two fingers are for the sheet; a single finger scrolls the page, until the sheet is enlarged.
      onTouchStart: (event: TouchEvent) => {
        if (event.touches.length > 1) event.preventDefault();
      },
      onPointerDown: (event: PointerEvent) => {
        if (held.fingers.size === 0) held.path = 0;
        held.fingers.set(event.pointerId, pointIn(event));
      },
      onPointerMove: (event: PointerEvent) => {
        const { fingers } = held;
        const before = fingers.get(event.pointerId);
        if (!before) return;
        const now = pointIn(event);
        fingers.set(event.pointerId, now);
        held.path += far(before, now);
        if (held.path > STILL)
          (event.currentTarget as SVGElement).setPointerCapture(event.pointerId);
        const [other] = [...fingers].filter(([id]) => id !== event.pointerId);
        if (!other) return move(1, before, now);
        const [, still] = other;
        move(far(now, still) / far(before, still), between(before, still), between(now, still));
      },
      onPointerUp: release,
      onPointerCancel: release,
    },
  };
}

const far = ([x, y]: Pair, [x2, y2]: Pair) => Math.hypot(x - x2, y - y2);
const between = ([x, y]: Pair, [x2, y2]: Pair): Pair => [(x + x2) / 2, (y + y2) / 2];
