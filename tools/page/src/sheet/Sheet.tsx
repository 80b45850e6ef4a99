// The sheet from the front: its marks and their errors, with axes; used by every screen. Places are mm in the machine
// frame: the origin is the middle of the sheet, y runs up.
import type { ComponentChildren } from "preact";
import { useContext, useId, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import { namedLength, useUnits } from "../controls/lengths";
import { Axes, Legend, legendHeight, type Origin } from "./Axes";
import { MarkCard } from "./MarkCard";
import { BEYOND_NOISE, Marks } from "./Marks";
import type { Mark, State } from "./marks";
import { Save } from "./Save";
import { Divide, halves, Slider } from "./Slider";
import { States } from "./States";
import { type Scale, ScaleContext, SheetSize, useScale } from "./scale";
import { usePointing } from "./usePointing";
import { useZoom } from "./useZoom";
import { factorFor, type Pair } from "./view";
import "./sheet.css";

const WIDE = 800; // [px] before it is measured
const NONE: readonly State[] = [];
const KEYS = {
  tabIndex: 0,
  role: "group" as const, // a region would have to be the only one of its name
  "aria-label": "The sheet: arrow keys choose a mark, plus and minus enlarge",
};

export interface SheetParts {
  /** Width and height [mm], if they differ from the machine's. */
  size?: Pair;
  /** A description of the picture for screen readers. */
  label: string;
  marks: readonly Mark[];
  states?: readonly State[];
  shown?: number;
  show?: (index: number) => void;
  /** Whether a slider divides the first state, on its left, from the shown one, on its right. */
  slides?: boolean | undefined;
  /** Drawn pale, below the state that is shown. */
  ghosts?: State | undefined;
  print?: readonly (Pair | null)[] | undefined;
  sigma?: number | undefined; // [mm] of a reading
  selected?: number | undefined;
  select?: (mark: number | undefined) => void;
  /** A press on a mark. */
  press?: (mark: number) => void;
  origin?: Origin;
  children?: ComponentChildren;
}

export function Sheet(parts: SheetParts) {
  const { label, marks, states = NONE, shown = 0, show, sigma } = parts;
  const usual = useContext(SheetSize);
  const units = useUnits();
  const size = parts.size ?? usual;
  const drawing = useRef<SVGSVGElement>(null);
  const wide = useWidth(drawing);
  const zoom = useZoom(size, wide);
  const { scale } = zoom;
  const clip = useId();
  const [line, slide] = useState(0); // [mm] of the slider
  const before = parts.slides && shown > 0 ? states[0] : undefined;
  const after = states[shown];
  const state = before && after ? halves(marks, line, [before, after]) : after;
  const factors = useMemo(() => states.map((_, i) => usualFactor(parts, size, i)), [states, sigma]);
  const hasArrows = state?.errors.some((error) => error) ?? false;
  const factor = hasArrows ? factors[before ? 0 : shown] : undefined;
  const pointing = usePointing(parts, zoom, factor ?? 0);
  const { selected } = pointing;
  const keys = { ...KEYS, onKeyDown: pointing.onKeyDown };
  const { left, right, top, bottom } = scale.plot;
  const noise = sigma ? `noise: 95 % within ${namedLength(BEYOND_NOISE * sigma, units)}` : "";
  return (
    <>
      {states.length > 1 && show && <States {...{ size, marks, states, shown, show, factors }} />}
      {before && state && (
        <Slider x={line} wide={size[0]} move={slide} left={before.title} right={state.title} />
      )}
      <figure class="sheet">
        <div class="board">
          <div class="frame" {...keys}>
            <svg
              ref={drawing}
              class={zoom.times > 1 ? "enlarged" : ""}
              viewBox={`0 0 ${wide} ${bottom + legendHeight(wide, hasArrows)}`}
              role="img"
              aria-label={label}
              {...pointing.pointer}
            >
              <ScaleContext.Provider value={scale}>
                <clipPath id={clip}>
                  <rect x={left} y={top} width={right - left} height={bottom - top} />
                </clipPath>
                <g clip-path={zoom.times > 1 ? `url(#${clip})` : undefined}>
                  <Wood size={size} />
                </g>
                <Axes origin={parts.origin} />
                <g clip-path={zoom.times > 1 ? `url(#${clip})` : undefined}>
                  {parts.children}
                  {before && <Divide x={line} />}
                  <Marks
                    marks={marks}
                    state={state}
                    ghosts={parts.ghosts?.errors}
                    print={parts.print}
                    factor={factor ?? 0}
                    sigma={sigma}
                    selected={selected}
                  />
                </g>
                <Legend factor={factor} circle={state?.promised ? "promised" : noise} />
              </ScaleContext.Provider>
            </svg>
          </div>
          <div
            class={`card-of-mark ${cornerOf(scale, marks[selected ?? -1])} ${hasArrows ? "waits" : ""}`}
            role="status"
          >
            {selected !== undefined && marks[selected] ? (
              <MarkCard
                mark={marks[selected]}
                error={state?.errors[selected]}
                chains={state?.chains?.[selected]}
              />
            ) : (
              hasArrows && <span>Touch a mark: its numbers stand here.</span>
            )}
          </div>
        </div>
        <div class="tools row">
          <button type="button" aria-label="Farther" onClick={zoom.lessen}>
            −
          </button>
          <button type="button" aria-label="Nearer" onClick={zoom.enlarge}>
            +
          </button>
          <button type="button" aria-disabled={zoom.times === 1} onClick={zoom.all}>
            All
          </button>
          <Save drawing={drawing} />
        </div>
      </figure>
    </>
  );
}

function Wood({ size }: { size: Pair }) {
  const { at, px } = useScale();
  const [x, y] = at([-size[0] / 2, size[1] / 2]);
  return <rect class="wood" x={x} y={y} width={size[0] * px} height={size[1] * px} />;
}

/** The width of a drawing [px], measured before it is shown, so that text never appears in a wrong size. */
function useWidth(drawing: { current: SVGSVGElement | null }): number {
  const [wide, setWide] = useState(WIDE);
  useLayoutEffect(() => {
    const svg = drawing.current;
    if (!svg) return;
    const measure = () => svg.clientWidth > 0 && setWide(svg.clientWidth);
    measure();
    const watch = new ResizeObserver(measure);
    watch.observe(svg);
    return () => watch.disconnect();
  }, [drawing]);
  return wide;
}

/** Where the card of a mark stands: on the other half of the sheet. */
function cornerOf({ at, plot }: Scale, mark: Mark | undefined): string {
  if (!mark) return "";
  const [x, y] = at(mark.target);
  const across = x > (plot.left + plot.right) / 2 ? "at-left" : "at-right";
  return `${across} ${y > (plot.top + plot.bottom) / 2 ? "at-top" : "at-bottom"}`;
}

/** The state as set has its own scale; all fitted states share the fitted frame's. */
function usualFactor(
  { marks, states = NONE, sigma = 0 }: SheetParts,
  [width]: Pair,
  shown: number,
): number {
  const state = states[Math.min(shown, 1)];
  return factorFor(
    (state?.errors ?? []).map((error, i) => (marks[i]?.isDoubted ? null : error)),
    width,
    Math.max(BEYOND_NOISE * sigma, ...(state?.promised ?? [])),
  );
}
