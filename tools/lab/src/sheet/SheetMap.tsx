// The sheet from the front, with whatever lies on it. Places are mm in the machine frame: the origin is
// the middle of the sheet, y runs up. Sizes of text and lines are CSS pixels at any width.
import { type ComponentChildren, createContext } from "preact";
import { useContext, useLayoutEffect, useRef, useState } from "preact/hooks";

/** How many mm of the sheet a CSS pixel shows. */
const PixelContext = createContext(2);
export const usePixel = () => useContext(PixelContext);

interface SheetMapParts {
  sheet: readonly [number, number]; // width, height [mm]
  /** What the picture shows, for those who cannot see it. */
  label: string;
  /** Whether something on it can be pressed or moved. */
  acts?: boolean;
  children?: ComponentChildren;
}

export function SheetMap({ sheet, label, acts = false, children }: SheetMapParts) {
  const [width, height] = sheet;
  const edge = width * 0.05; // room for arrows that leave the sheet
  const place = useRef<SVGSVGElement>(null);
  const [pixel, setPixel] = useState(2);
  // Before the first paint, so that nobody sees text in a wrong size.
  useLayoutEffect(() => {
    const drawn = place.current;
    if (!drawn) return;
    const measure = () => setPixel((width + 2 * edge) / Math.max(drawn.clientWidth, 1));
    measure();
    const watch = new ResizeObserver(measure);
    watch.observe(drawn);
    return () => watch.disconnect();
  }, [width, edge]);
  const box = [-width / 2 - edge, -height / 2 - edge, width + 2 * edge, height + 2 * edge];
  return (
    <svg
      ref={place}
      class="sheet"
      viewBox={box.join(" ")}
      role={acts ? "group" : "img"}
      aria-label={label}
    >
      <PixelContext.Provider value={pixel}>
        <rect
          x={-width / 2}
          y={-height / 2}
          width={width}
          height={height}
          fill="var(--panel)"
          stroke="var(--line)"
          stroke-width={pixel}
        />
        <g>{children}</g>
      </PixelContext.Provider>
    </svg>
  );
}
