// Errors of both chains against a covariate: left as discs, right as squares; a suspect's curves below the dots.
import { scaleLinear } from "d3-scale";
import { area, line } from "d3-shape";
import type { Unit } from "../controls/lengths";
import type { Drawn, Ends } from "./live";
import { nearest } from "./nearest";

export const WIDTH = 320;
const HEIGHT = 200;
const EDGE = { left: 44, right: 24, top: 10, bottom: 34 };
const SIDES = ["left", "right"] as const;
type Curve = Drawn["curves"][string][0];

interface PlotParts {
  title: string;
  unit: string;
  values: readonly Ends[];
  chains: readonly Ends[];
  most: number; // [mm] the largest error that fits
  units: Unit;
  curves: readonly [Curve, Curve] | undefined;
  selected: number | undefined;
  select: (mark: number | undefined) => void;
}

export function Plot(parts: PlotParts) {
  const { title, unit, values, chains, most, units, curves, selected, select } = parts;
  const known = values.flat().filter((value): value is number => value !== null);
  const ends = [Math.min(...known), Math.max(...known)] as const;
  if (known.length === 0 || ends[0] === ends[1])
    return <SamePlot title={title} unit={unit} at={ends} />;
  const room = (ends[1] - ends[0]) * 0.04;
  const x = scaleLinear([ends[0] - room, ends[1] + room], [EDGE.left, WIDTH - EDGE.right]);
  const inch = units === "inch" ? 25.4 : 1;
  const y = scaleLinear([-most / inch, most / inch], [HEIGHT - EDGE.bottom, EDGE.top]);
  const dots = SIDES.map((_, side) =>
    chains.map((pair, i) => {
      const [at, error] = [values[i]?.[side], pair[side]];
      if (at == null || error == null) return undefined;
      return [x(at), y(Math.max(-most, Math.min(most, error)) / inch)] as const;
    }),
  );
  const pick = (event: MouseEvent) => {
    const drawing = (event.currentTarget as Element).closest("svg");
    const found = nearest(event, drawing, dots.flat());
    select(found === undefined ? undefined : found % chains.length);
  };
  const shown = unit ? `${title} [${unit}]` : title;
  return (
    // biome-ignore lint/a11y/useKeyWithClickEvents: the list of marks does it by keyboard
    <svg
      class="plot"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="img"
      aria-label={`Errors of the chains against ${title}`}
      onClick={pick}
    >
      <Axes x={x} y={y} title={shown} units={units} />
      {curves?.map((curve, side) => (
        <CurvePath
          key={SIDES[side]}
          curve={curve}
          side={SIDES[side] ?? ""}
          x={x}
          y={y}
          inch={inch}
        />
      ))}
      {dots.map((places, side) => (
        <path key={SIDES[side]} class={`dots ${SIDES[side]}`} d={dotted(places)} />
      ))}
      {selected !== undefined &&
        dots.map((places, side) => {
          const place = places[selected];
          return (
            place && <circle key={SIDES[side]} class="lit" cx={place[0]} cy={place[1]} r={7} />
          );
        })}
    </svg>
  );
}

type Scale = ReturnType<typeof scaleLinear<number, number>>;

function Axes({ x, y, title, units }: { x: Scale; y: Scale; title: string; units: Unit }) {
  const bottom = HEIGHT - EDGE.bottom;
  return (
    <g class="axes">
      {y.ticks(4).map((tick) => (
        <g key={tick}>
          <line x1={EDGE.left} x2={WIDTH - EDGE.right} y1={y(tick)} y2={y(tick)} />
          <text x={EDGE.left - 5} y={y(tick) + 4} text-anchor="end">
            {tickText(tick)}
          </text>
        </g>
      ))}
      <line class="zero" x1={EDGE.left} x2={WIDTH - EDGE.right} y1={y(0)} y2={y(0)} />
      {x.ticks(3).map((tick) => (
        <text key={tick} x={x(tick)} y={bottom + 14} text-anchor="middle">
          {tickText(tick)}
        </text>
      ))}
      <text class="name" x={WIDTH - EDGE.right} y={HEIGHT - 5} text-anchor="end">
        {title}
      </text>
      <text class="name" x={4} y={HEIGHT - 5}>
        {units}
      </text>
    </g>
  );
}

interface CurveParts {
  curve: Curve;
  side: string;
  x: Scale;
  y: Scale;
  inch: number;
}

function CurvePath({ curve, side, x, y, inch }: CurveParts) {
  const [low, high] = x.domain() as [number, number];
  const rows = curve.at.flatMap((at, i) => (at >= low && at <= high ? [i] : []));
  const across = (i: number) => x(curve.at[i] ?? 0);
  const up = (values: readonly number[]) => (i: number) => y((values[i] ?? 0) / inch);
  const band = area<number>(across, up(curve.low), up(curve.high))(rows);
  const middle = line<number>(across, up(curve.middle))(rows);
  return (
    <g class={`curve ${side}`}>
      <path class="band" d={band ?? ""} />
      <path class="middle" d={middle ?? ""} />
    </g>
  );
}

/** Nothing can depend on what is the same for all marks. */
function SamePlot({ title, unit, at }: { title: string; unit: string; at: readonly number[] }) {
  const value = at[0] !== undefined && Number.isFinite(at[0]) ? at[0] : undefined;
  return (
    <p class="plot unknown">
      {title}:{" "}
      {value === undefined ? "not known for these marks" : `${tickText(value)} ${unit} for all`}
    </p>
  );
}

/** A number at an axis, with a minus as wide as the figures. */
function tickText(tick: number): string {
  return String(Number(tick.toPrecision(6))).replace("-", "\u2212");
}

/** A path of points: each is a line without length, so its round or square ends are the dot. */
function dotted(places: readonly (readonly [number, number] | undefined)[]): string {
  return places
    .map((place) => place && `M${place[0].toFixed(1)} ${place[1].toFixed(1)}h0`)
    .join("");
}
