// The sheet from the front: its marks and their errors, with axes, the same on every screen.
// Places are mm in the machine frame: the origin is the middle of the sheet, y runs up.
import type { ComponentChildren } from "preact";
import { useId, useLayoutEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Unit } from "../controls/lengths";
import { Axes, Legend, legendHeight, MIDDLE, type Origin } from "./Axes";
import { MarkCard } from "./MarkCard";
import { BEYOND_NOISE, Marks } from "./Marks";
import { type Mark, type State, table } from "./marks";
import { States } from "./States";
import { saveCsv, savePng, saveSvg } from "./save";
import { type Scale, ScaleContext, scaleOf } from "./scale";
import { Tools } from "./Tools";
import { usePointing } from "./usePointing";
import { useZoom } from "./useZoom";
import { factorFor, type Pair } from "./view";
import "./sheet.css";

const WIDE = 800; // [px] before it is measured
const NONE: readonly State[] = [];

export interface SheetParts {
  size: Pair; // width, height [mm]
  /** What the picture shows, for those who cannot see it. */
  label: string;
  /** Of the files that are saved. */
  name: string;
  units: Unit;
  marks: readonly Mark[];
  states?: readonly State[];
  shown?: number;
  show?: (index: number) => void;
  /** Drawn pale, below the state that is shown. */
  ghosts?: State | undefined;
  print?: readonly (Pair | null)[] | undefined;
  sigma?: number | undefined; // [mm] of a reading
  selected?: number | undefined;
  select?: (mark: number | undefined) => void;
  /** A press on a mark. */
  press?: (mark: number) => void;
  origin?: Origin;
  /** Whether what lies on it is pressed or moved; its marks are then drawn by what lies on it. */
  acts?: boolean;
  children?: ComponentChildren;
}

export function Sheet(parts: SheetParts) {
  const { size, label, name, marks, states = NONE, shown = 0, show } = parts;
  const { units, sigma, acts = false } = parts;
  const drawing = useRef<SVGSVGElement>(null);
  const clip = useId();
  const wide = useWidth(drawing);
  const zoom = useZoom(drawing, size, wide);
  const scale = useMemo(() => scaleOf(size, zoom.view, wide), [size[0], size[1], zoom.view, wide]);
  const [chosen, setFactor] = useState<number>();
  const state = states[shown];
  const factors = useMemo(() => states.map((_, i) => usualFactor(parts, i)), [states, sigma]);
  const hasArrows = state?.errors.some((error) => error) ?? false;
  const factor = hasArrows ? (chosen ?? factors[shown]) : undefined;
  const pointing = usePointing(parts, scale, zoom, factor ?? 0, drawing);
  const { selected } = pointing;
  const frame = {
    tabIndex: 0,
    role: "group" as const,
    "aria-label": `The sheet: arrow keys choose a mark, plus and minus enlarge${states.length > 1 ? ", [ and ] change the state" : ""}`,
  };
  const { plot } = scale;
  const high = plot.bottom + legendHeight(wide, hasArrows);
  const isWhole = zoom.view.times === 1;
  const title = `${document.title}: ${state?.title ?? label}`;
  return (
    <>
      {states.length > 1 && show && (
        <States {...{ size, marks, states, shown, show, units }} factors={factors} />
      )}
      <figure class={acts ? "sheet acts" : "sheet"}>
        <div class="board" {...(acts ? {} : { ...frame, onKeyDown: pointing.onKeyDown })}>
          <svg
            ref={drawing}
            viewBox={`0 0 ${wide} ${high}`}
            role={acts ? "group" : "img"}
            aria-label={label}
            {...(acts ? {} : pointing.pointer)}
          >
            <ScaleContext.Provider value={scale}>
              <clipPath id={clip}>
                <rect
                  x={isWhole ? 0 : plot.left}
                  y={isWhole ? 0 : plot.top}
                  width={isWhole ? wide : plot.right - plot.left}
                  height={plot.bottom + (isWhole ? 8 : -plot.top)}
                />
              </clipPath>
              <Wood size={size} scale={scale} />
              <Axes units={units} origin={parts.origin ?? MIDDLE} />
              <g clip-path={`url(#${clip})`}>
                {!acts && parts.children}
                {!acts && (
                  <Marks
                    marks={marks}
                    state={state}
                    ghosts={parts.ghosts?.errors}
                    print={parts.print}
                    factor={factor ?? 0}
                    sigma={sigma}
                    selected={selected}
                  />
                )}
                {acts && parts.children}
              </g>
              <Legend
                units={units}
                factor={factor}
                circle={!hasArrows ? undefined : state?.promised ? "promised" : sigma && "noise"}
              />
            </ScaleContext.Provider>
          </svg>
          {!acts && (
            <div
              class={`card-of-mark ${cornerOf(scale, marks[selected ?? -1])} ${hasArrows ? "waits" : ""}`}
              role="status"
            >
              {selected !== undefined && marks[selected] ? (
                <MarkCard
                  mark={marks[selected]}
                  error={state?.errors[selected]}
                  chains={state?.chains?.[selected]}
                  units={units}
                />
              ) : (
                hasArrows && <span>Touch a mark: its numbers stand here.</span>
              )}
            </div>
          )}
        </div>
        <Tools
          zoom={zoom}
          factor={factor}
          setFactor={setFactor}
          save={(as) => {
            if (as === "csv") saveCsv(table(marks, states, sigma), name);
            else if (drawing.current)
              (as === "svg" ? saveSvg : savePng)(drawing.current, name, title);
          }}
        />
      </figure>
    </>
  );
}

function Wood({ size, scale }: { size: Pair; scale: Scale }) {
  const [x, y] = scale.at([-size[0] / 2, size[1] / 2]);
  const { plot, px } = scale;
  const [left, top] = [Math.max(x, plot.left), Math.max(y, plot.top)];
  const [right, bottom] = [
    Math.min(x + size[0] * px, plot.right),
    Math.min(y + size[1] * px, plot.bottom),
  ];
  return <rect class="wood" x={left} y={top} width={right - left} height={bottom - top} />;
}

/** The width of a drawing [px]: measured before it is seen, so that nobody sees text in a wrong size. */
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

/** As set has its scale; all that is fitted has that of the fitted frame. */
function usualFactor({ marks, states = NONE, sigma = 0, size }: SheetParts, shown: number): number {
  const state = states[Math.min(shown, 1)];
  return factorFor(
    (state?.errors ?? []).map((error, i) => (marks[i]?.isDoubted ? null : error)),
    size[0],
    Math.max(BEYOND_NOISE * sigma, ...(state?.promised ?? [])),
  );
}
