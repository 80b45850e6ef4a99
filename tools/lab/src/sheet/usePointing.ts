// Which mark is meant: by a mouse that points at it, a finger that touches it, keys that go to it.
import { useRef, useState } from "preact/hooks";
import type { SheetParts } from "./Sheet";
import type { Scale } from "./scale";
import { pointIn, type Zoom } from "./useZoom";
import { markAt, nearest, showing, WHOLE } from "./view";

const [MOUSE, FINGER] = [24, 32]; // [px] as far as a mark is meant
const STEP = 1.6; // of a key that enlarges

interface Drawing {
  current: SVGSVGElement | null;
}

export function usePointing(
  parts: SheetParts,
  scale: Scale,
  zoom: Zoom,
  factor: number,
  drawing: Drawing,
) {
  const [inner, setInner] = useState<number>();
  const isPinned = useRef(false);
  const [selected, select] = parts.select ? [parts.selected, parts.select] : [inner, setInner];
  const pin = (mark: number | undefined) => {
    isPinned.current = mark !== undefined;
    select(mark);
  };
  const meant = (event: MouseEvent, reach: number) =>
    drawing.current ? meantAt(parts, scale, factor, drawing.current, event, reach) : undefined;
  return {
    selected,
    pointer: {
      onPointerMove: (event: PointerEvent) => {
        if (event.pointerType === "touch" || event.buttons || isPinned.current) return;
        const mark = meant(event, MOUSE);
        if (mark !== selected) select(mark);
      },
      onPointerLeave: () => {
        if (!isPinned.current && selected !== undefined) select(undefined);
      },
      onClick: (event: MouseEvent) => {
        if (zoom.isMoved()) return;
        const mark = meant(event, FINGER);
        pin(mark);
        if (mark !== undefined) parts.press?.(mark);
      },
      onDblClick: (event: MouseEvent) =>
        drawing.current && zoom.enlarge(2, scale.back(pointIn(drawing.current, event))),
    },
    onKeyDown: (event: KeyboardEvent) => {
      // Where brackets need AltGr, some systems call that Ctrl and Alt.
      const isCommand = event.ctrlKey || event.metaKey || event.altKey;
      if (isCommand && !event.getModifierState("AltGraph")) return;
      if (!pressed(event.key, parts, zoom, selected, pin)) return;
      event.preventDefault();
      event.stopPropagation();
    },
  };
}

/** The mark whose place or arrow is near to where somebody points. */
function meantAt(
  { marks, states, shown = 0 }: SheetParts,
  scale: Scale,
  factor: number,
  svg: SVGSVGElement,
  event: MouseEvent,
  reach: number,
): number | undefined {
  const errors = states?.[shown]?.errors;
  const targets = marks.map(({ target }) => scale.at(target));
  const tips = marks.map(({ target: [x, y] }, i) => {
    const error = errors?.[i];
    return error ? scale.at([x + error[0] * factor, y + error[1] * factor]) : null;
  });
  const which = nearest(pointIn(svg, event), [...targets, ...tips], reach);
  return which === undefined ? undefined : which % marks.length;
}

/** What a key does; whether it does anything. */
function pressed(
  key: string,
  { marks, states = [], shown = 0, show, press, size }: SheetParts,
  zoom: Zoom,
  selected: number | undefined,
  pin: (mark: number | undefined) => void,
): boolean {
  const places = marks.map(({ target }) => target);
  const mark = markAt(key, places, selected);
  if (mark !== undefined) {
    pin(mark);
    const place = places[mark];
    if (place) zoom.setView(showing(size, zoom.view, place));
  } else if (key === "Escape") pin(undefined);
  else if (key === "+" || key === "=") zoom.enlarge(STEP);
  else if (key === "-") zoom.enlarge(1 / STEP);
  else if (key === "0") zoom.setView(WHOLE);
  else if (key === "[") show?.(Math.max(0, shown - 1));
  else if (key === "]") show?.(Math.min(states.length - 1, shown + 1));
  else if (key === "Enter" && selected !== undefined) press?.(selected);
  else return false;
  return true;
}
