// How places of the sheet [mm, machine frame] become places of the drawing [px], for all that is drawn on it.
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Pair } from "./view";

export interface Scale {
  /** The place in the drawing. */
  at: (place: Pair) => Pair;
  /** The place on the sheet. */
  back: (place: Pair) => Pair;
  px: number; // of a mm
  plot: { left: number; right: number; top: number; bottom: number };
  /** The place on the sheet at the lower left end of the drawing, and at its upper right end [mm]. */
  ends: readonly [Pair, Pair];
}

const EDGE = { left: 50, right: 10, top: 10 };
const ROOM = 0.05; // of the width on each side, for arrows that leave the sheet

/** What is drawn: how many times larger than where all is seen, and around which place [mm]. */
export interface View {
  times: number;
  middle: Pair;
}

export const WHOLE: View = { times: 1, middle: [0, 0] };
const MOST = 40; // times

/** The scale of a drawing of this width [px]. */
export function scaleOf(size: Pair, wide: number, { times, middle: [mx, my] } = WHOLE): Scale {
  const [width, height] = [(1 + 2 * ROOM) * size[0], size[1] + 2 * ROOM * size[0]];
  const fit = Math.max(1, wide - EDGE.left - EDGE.right) / width;
  const plot = {
    left: EDGE.left,
    right: EDGE.left + width * fit,
    top: EDGE.top,
    bottom: EDGE.top + height * fit,
  };
  const [x0, y0] = [(plot.left + plot.right) / 2, (plot.top + plot.bottom) / 2];
  const [px, halfX, halfY] = [fit * times, width / 2 / times, height / 2 / times];
  return {
    at: ([x, y]) => [x0 + (x - mx) * px, y0 - (y - my) * px],
    back: ([x, y]) => [mx + (x - x0) / px, my - (y - y0) / px],
    px,
    plot,
    ends: [
      [mx - halfX, my - halfY],
      [mx + halfX, my + halfY],
    ],
  };
}

/** The view in which what was drawn at a point [px] is drawn at another, so many times larger; never beyond the sheet. */
export function moved(
  size: Pair,
  wide: number,
  view: View,
  by: number,
  from: Pair,
  to: Pair,
): View {
  const times = Math.max(1, Math.min(MOST, view.times * by));
  const place = scaleOf(size, wide, view).back(from);
  const { back, ends } = scaleOf(size, wide, { times, middle: [0, 0] });
  const off = back(to);
  const along = (axis: 0 | 1) => {
    const most = ends[1][axis] * (times - 1);
    return Math.max(-most, Math.min(most, place[axis] - off[axis]));
  };
  return { times, middle: [along(0), along(1)] };
}

export const ScaleContext = createContext<Scale>(scaleOf([2440, 1220], 800));
export const useScale = () => useContext(ScaleContext);

/** Width and height of the machine's sheet [mm]. */
export const SheetSize = createContext<Pair>([2440, 1220]);
/** The settings that a drawing was made from: name and digest. */
export const Stamp = createContext("");
