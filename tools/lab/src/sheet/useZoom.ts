// Wheel, fingers and mouse change what part of the sheet is in view.
import { useEffect, useRef, useState } from "preact/hooks";
import { type Scale, scaleOf } from "./scale";
import { type Pair, panned, type View, WHOLE, zoomed } from "./view";

export interface Zoom {
  view: View;
  setView: (view: View) => void;
  /** Enlarges around a place [mm]; without one around the middle. */
  enlarge: (ratio: number, place?: Pair) => void;
  /** Whether what somebody does now moves the sheet, so that it points at no mark. */
  isMoved: () => boolean;
}

export function useZoom(
  drawing: { current: SVGSVGElement | null },
  size: Pair,
  wide: number,
): Zoom {
  const [view, setView] = useState(WHOLE);
  const now = useRef(view);
  now.current = view;
  const isMoved = useRef(false);
  const change = (next: View) => {
    now.current = next;
    setView(next);
  };
  const enlarge = (ratio: number, place: Pair = [now.current.x, now.current.y]) =>
    change(zoomed(size, now.current, ratio, place));
  useEffect(() => {
    const svg = drawing.current;
    if (!svg) return;
    const fingers = new Map<number, Pair>();
    const scale = () => scaleOf(size, now.current, wide);
    const wheel = (event: WheelEvent) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      enlarge(Math.exp(-event.deltaY / 200), scale().back(pointIn(svg, event)));
    };
    const down = (event: PointerEvent) => {
      isMoved.current = false;
      fingers.set(event.pointerId, pointIn(svg, event));
    };
    const move = (event: PointerEvent) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const here = pointIn(svg, event);
      const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
      // A finger alone scrolls the page.
      if (!other && event.pointerType === "touch") return;
      if (!other && Math.hypot(here[0] - before[0], here[1] - before[1]) < 4) return;
      isMoved.current = true;
      fingers.set(event.pointerId, here);
      const next = other
        ? pinched(size, now.current, scale(), [before, other], [here, other])
        : panned(size, now.current, shift(scale(), before, here));
      change(next);
    };
    const up = (event: PointerEvent) => fingers.delete(event.pointerId);
    svg.addEventListener("wheel", wheel, { passive: false });
    svg.addEventListener("pointerdown", down);
    addEventListener("pointermove", move);
    addEventListener("pointerup", up);
    addEventListener("pointercancel", up);
    return () => {
      svg.removeEventListener("wheel", wheel);
      svg.removeEventListener("pointerdown", down);
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", up);
      removeEventListener("pointercancel", up);
    };
  }, [drawing, size[0], size[1], wide]);
  return { view, setView: change, enlarge, isMoved: () => isMoved.current };
}

/** Where somebody points in a drawing [px]. */
export function pointIn(svg: SVGSVGElement, event: MouseEvent): Pair {
  const box = svg.getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** How far the view moves [mm] when the sheet is drawn from one place to another. */
function shift({ px }: Scale, [x, y]: Pair, [toX, toY]: Pair): Pair {
  return [(x - toX) / px, (toY - y) / px];
}

/** Two fingers move from two places to two others. */
function pinched(
  size: Pair,
  view: View,
  scale: Scale,
  from: readonly [Pair, Pair],
  to: readonly [Pair, Pair],
): View {
  const middle = ([[x, y], [x2, y2]]: readonly [Pair, Pair]): Pair => [(x + x2) / 2, (y + y2) / 2];
  const gap = ([[x, y], [x2, y2]]: readonly [Pair, Pair]) => Math.hypot(x - x2, y - y2);
  const moved = panned(size, view, shift(scale, middle(from), middle(to)));
  const there = scale.back(middle(from));
  return zoomed(size, moved, gap(to) / Math.max(1, gap(from)), there);
}
