// Which mark is pointed at: by mouse, finger or keys.
import { useRef, useState } from "preact/hooks";
import type { SheetParts } from "./Sheet";
import type { Zoom } from "./useZoom";
import { markAt, nearest, pointIn } from "./view";

const [MOUSE, FINGER] = [24, 32]; // [px] how near a mark has to be

export function usePointing(parts: SheetParts, zoom: Zoom, factor: number) {
  const { marks, states, shown = 0, press } = parts;
  const { scale } = zoom;
  const [inner, setInner] = useState<number>();
  const isPinned = useRef(false);
  const [selected, select] = parts.select ? [parts.selected, parts.select] : [inner, setInner];
  const pin = (mark: number | undefined) => {
    isPinned.current = mark !== undefined;
    select(mark);
  };
  /** The mark whose place or arrow is near the pointer. */
  const meant = (event: MouseEvent, reach: number) => {
    const errors = states?.[shown]?.errors;
    const targets = marks.map(({ target }) => scale.at(target));
    const tips = marks.map(({ target: [x, y] }, i) => {
      const error = errors?.[i];
      return error ? scale.at([x + error[0] * factor, y + error[1] * factor]) : null;
    });
    const which = nearest(pointIn(event), [...targets, ...tips], reach);
    return which === undefined ? undefined : which % marks.length;
  };
  /** Handles a key; false if it is not one of its keys. */
  const pressed = (key: string): boolean => {
    const places = marks.map(({ target }) => target);
    const mark = markAt(key, places, selected);
    const place = places[mark ?? -1];
    if (place) {
      pin(mark);
      zoom.show(scale.at(place));
    } else if (key === "Escape") pin(undefined);
    else if (key === "+" || key === "=") zoom.enlarge();
    else if (key === "-") zoom.lessen();
    else if (key === "0") zoom.all();
    else if (key === "Enter" && selected !== undefined) press?.(selected);
    else return false;
    return true;
  };
  return {
    selected,
    pointer: {
      ...zoom.pointer,
      onPointerMove: (event: PointerEvent) => {
        zoom.pointer.onPointerMove(event);
        if (event.pointerType === "touch" || event.buttons || isPinned.current) return;
        const mark = meant(event, MOUSE);
        if (mark !== selected) select(mark);
      },
      onPointerLeave: () => {
        if (!isPinned.current && selected !== undefined) select(undefined);
      },
      onClick: (event: MouseEvent) => {
        if (zoom.takesClick(event)) return;
        const mark = meant(event, FINGER);
        pin(mark);
        if (mark !== undefined) press?.(mark);
      },
    },
    onKeyDown: (event: KeyboardEvent) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !pressed(event.key)) return;
      event.preventDefault();
      event.stopPropagation();
    },
  };
}
