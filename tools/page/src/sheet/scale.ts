// How places of the sheet [mm, machine frame] become places of the drawing [px], for all that is drawn on it.
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import type { Pair } from "./view";

export interface Scale {
  /** The place in the drawing. */
  at: (place: Pair) => Pair;
  px: number; // of a mm
  plot: { left: number; right: number; top: number; bottom: number };
  /** The place on the sheet at the lower left end of the drawing, and at its upper right end [mm]. */
  ends: readonly [Pair, Pair];
}

const EDGE = { left: 50, right: 10, top: 10 };
const ROOM = 0.05; // of the width on each side, for arrows that leave the sheet

/** The scale of a drawing of this width [px]. */
export function scaleOf(size: Pair, wide: number): Scale {
  const [width, height] = [(1 + 2 * ROOM) * size[0], size[1] + 2 * ROOM * size[0]];
  const px = Math.max(1, wide - EDGE.left - EDGE.right) / width;
  const plot = {
    left: EDGE.left,
    right: EDGE.left + width * px,
    top: EDGE.top,
    bottom: EDGE.top + height * px,
  };
  const [x0, y0] = [(plot.left + plot.right) / 2, (plot.top + plot.bottom) / 2];
  return {
    at: ([x, y]) => [x0 + x * px, y0 - y * px],
    px,
    plot,
    ends: [
      [-width / 2, -height / 2],
      [width / 2, height / 2],
    ],
  };
}

export const ScaleContext = createContext<Scale>(scaleOf([2440, 1220], 800));
export const useScale = () => useContext(ScaleContext);

/** Width and height of the machine's sheet [mm]. */
export const SheetSize = createContext<Pair>([2440, 1220]);
/** The settings that a drawing was made from: name and digest. */
export const Stamp = createContext("");
