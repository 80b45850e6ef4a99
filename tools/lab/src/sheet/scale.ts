// How places of the sheet [mm, machine frame] become places of the drawing [px], for all that is drawn on it.
import { createContext } from "preact";
import { useContext } from "preact/hooks";
import { extent, type Pair, type View } from "./view";

export interface Scale {
  /** The place in the drawing. */
  at: (place: Pair) => Pair;
  /** The place on the sheet. */
  back: (place: Pair) => Pair;
  px: number; // of a mm
  plot: { left: number; right: number; top: number; bottom: number };
}

const EDGE = { left: 50, right: 10, top: 10 };

/** The scale of a drawing that is so wide [px]. */
export function scaleOf(size: Pair, view: View, wide: number): Scale {
  const [width, height] = extent(size, view.times);
  const px = Math.max(1, wide - EDGE.left - EDGE.right) / width;
  const plot = {
    left: EDGE.left,
    right: EDGE.left + width * px,
    top: EDGE.top,
    bottom: EDGE.top + height * px,
  };
  const [x0, y0] = [(plot.left + plot.right) / 2, (plot.top + plot.bottom) / 2];
  return {
    at: ([x, y]) => [x0 + (x - view.x) * px, y0 - (y - view.y) * px],
    back: ([x, y]) => [view.x + (x - x0) / px, view.y - (y - y0) / px],
    px,
    plot,
  };
}

export const ScaleContext = createContext<Scale>(
  scaleOf([2440, 1220], { x: 0, y: 0, times: 1 }, 800),
);
export const useScale = () => useContext(ScaleContext);
