// A picture of numbers against numbers, with axes: errors of the chains against what they may depend on.

import { nearest, type Pair, pointIn, ticks, tickText } from "../sheet/view";

const WIDTH = 148; // [px] as on a small screen: text is never smaller
const HEIGHT = 108;
const EDGE = { left: 26, right: 6, top: 6, bottom: 32 };
const REACH = 44; // [px of the drawing] for a fingertip
const MIDDLE_X = (EDGE.left + WIDTH - EDGE.right) / 2;

/** A number on an axis as a place of the drawing. */
export type Along = (value: number) => number;

const DOTS = {
  left: { "stroke-width": 7, "stroke-linecap": "round" },
  right: { "stroke-width": 4, "stroke-linecap": "square" },
} as const;

/** Dots of one style; each belongs to a mark. */
export interface Dots {
  kind: keyof typeof DOTS;
  places: readonly (Pair | null)[]; // as on the axes
  marks: readonly number[];
}

interface PlotParts {
  title: string;
  label: string;
  across: Pair; // least and most
  most: number; // half the height, in units
  dots: readonly Dots[];
  selected: number | undefined;
  select: (mark: number | undefined) => void;
  /** What lies below the dots. */
  below?: (x: Along, y: Along) => preact.ComponentChildren;
}

export function Plot(parts: PlotParts) {
  const { title, label, across, most, dots, selected, select, below } = parts;
  const room = (across[1] - across[0]) * 0.04;
  const x = along([across[0] - room, across[1] + room], [EDGE.left, WIDTH - EDGE.right]);
  const y = along([-most, most], [HEIGHT - EDGE.bottom, EDGE.top]);
  const placed = dots.map((each) => ({
    ...each,
    places: each.places.map((place) =>
      place ? ([x(place[0]), y(Math.max(-most, Math.min(most, place[1])))] as const) : null,
    ),
  }));
  const pick = (event: MouseEvent) => {
    const svg = event.currentTarget as SVGSVGElement;
    const [px, py] = pointIn(event);
    const scale = WIDTH / svg.clientWidth;
    const all = placed.flatMap((each) => each.places);
    const which = nearest([px * scale, py * scale], all, REACH);
    select(which === undefined ? undefined : placed.flatMap((each) => each.marks)[which]);
  };
  return (
    // biome-ignore lint/a11y/useKeyWithClickEvents: the sheet does it by keyboard
    <svg
      class="plot"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="img"
      aria-label={label}
      onClick={pick}
    >
      <g class="axes">
        {ticks(-most, most, 4).map((tick) => (
          <g key={tick}>
            <line x1={EDGE.left} x2={WIDTH - EDGE.right} y1={y(tick)} y2={y(tick)} />
            <text x={EDGE.left - 5} y={y(tick) + 5} text-anchor="end">
              {tickText(tick)}
            </text>
          </g>
        ))}
        <line class="zero" x1={EDGE.left} x2={WIDTH - EDGE.right} y1={y(0)} y2={y(0)} />
        {ticks(across[0], across[1], 3).map((tick) => (
          <text key={tick} x={x(tick)} y={HEIGHT - EDGE.bottom + 14} text-anchor="middle">
            {tickText(tick)}
          </text>
        ))}
        <text class="name" x={MIDDLE_X} y={HEIGHT - 5} text-anchor="middle">
          {title}
        </text>
      </g>
      {below?.(x, y)}
      {placed.map(({ kind, places }) => (
        <path key={kind} class={`dots ${kind}`} {...DOTS[kind]} d={dotted(places)} />
      ))}
      {selected !== undefined &&
        placed.map(({ kind, places, marks }) =>
          places.map(
            (place, i) =>
              place &&
              marks[i] === selected && (
                <circle
                  key={`${kind}${i}`}
                  class="lit"
                  cx={place[0]}
                  cy={place[1]}
                  r={7}
                  stroke-width={3}
                />
              ),
          ),
        )}
    </svg>
  );
}

function along([least, most]: Pair, [from, to]: Pair): Along {
  return (value) => from + ((value - least) * (to - from)) / (most - least);
}

/** A path of points: each is a line of almost no length, drawn as a dot by its round or square ends. */
function dotted(places: readonly (Pair | null)[]): string {
  return places
    .map((place) => place && `M${place[0].toFixed(1)} ${place[1].toFixed(1)}h0.01`)
    .join("");
}
