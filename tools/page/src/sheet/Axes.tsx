// The sheet's axes and grid lines, and a legend with the scales of the sheet and its arrows.
import { lengthText, MM, useUnits } from "../controls/lengths";
import { useScale } from "./scale";
import { type Pair, rounded, ticks, tickText } from "./view";

const APART = 70; // [px] between ticks
const LINE = 22; // [px] of a line of the legend
const ROW = 34; // [px] of a legend with buttons beside it
const TICKS = 24; // [px] below the sheet

/** Origin and direction of the axes: the middle of the sheet, or the edges that the tape measures from. */
export interface Origin {
  zero: Pair; // [mm] machine frame
  way: Pair; // 1 or -1
}

const MIDDLE: Origin = { zero: [0, 0], way: [1, 1] };

export function Axes({ origin = MIDDLE }: { origin?: Origin | undefined }) {
  const units = useUnits();
  const { plot, at, ends } = useScale();
  const unit = MM[units];
  const along = (axis: 0 | 1, room: number) => {
    const shown = (mm: number) => ((mm - origin.zero[axis]) * origin.way[axis]) / unit;
    const count = Math.max(3, Math.floor(room / APART));
    return ticks(shown(ends[0][axis]), shown(ends[1][axis]), count).map((tick) => {
      const mm = origin.zero[axis] + tick * unit * origin.way[axis];
      const [x, y] = at([mm, mm]);
      const { left, top } = plot;
      return (
        <g key={`${axis} ${tick}`}>
          <path d={axis === 0 ? `M${x} ${top}V${plot.bottom}` : `M${left} ${y}H${plot.right}`} />
          <text
            x={axis === 0 ? x : left - 6}
            y={axis === 0 ? plot.bottom + 16 : y + 5}
            text-anchor={axis === 0 ? "middle" : "end"}
          >
            {tickText(tick)}
          </text>
        </g>
      );
    });
  };
  return (
    <g class="axes">
      {along(0, plot.right - plot.left)}
      {along(1, plot.bottom - plot.top)}
      <text x={4} y={plot.bottom + 16}>
        {units}
      </text>
    </g>
  );
}

const ROOMY = 560; // [px] in which the legend is a single line

/** How high the legend is [px]. */
export function legendHeight(wide: number, hasArrows: boolean): number {
  return TICKS + (wide >= ROOMY ? ROW : hasArrows ? 2 * LINE : 0);
}

interface LegendParts {
  /** How many times longer than life arrows are; undefined without arrows. */
  factor: number | undefined;
  /** What a circle around a mark means; empty without circles. */
  circle: string;
}

/** The legend below the drawing: what an arrow and a circle mean. */
export function Legend({ factor, circle }: LegendParts) {
  const units = useUnits();
  const { plot, px } = useScale();
  if (factor === undefined) return null;
  const unit = MM[units];
  const arrow = rounded(50 / px / factor / unit) * unit; // [mm]
  const isNarrow = plot.right - plot.left + 60 < ROOMY;
  const start = isNarrow ? plot.left : 10;
  const end = start + arrow * px * factor;
  const y = plot.bottom + TICKS + 0.5 * (isNarrow ? LINE : ROW);
  const below = y + (isNarrow ? LINE : 0);
  const noise = isNarrow ? plot.left + 8 : 205;
  return (
    <g class="legend-of-sheet">
      <path class="arrow beyond" d={arrowPath([start, y], [end, y])} />
      <text x={end + 8} y={y + 5}>
        {lengthText(arrow, units)} {units} off, {factor}× life
      </text>
      {circle && (
        <>
          <circle class="noise" cx={noise} cy={below} r={8} />
          <text x={noise + 14} y={below + 5}>
            {circle}
          </text>
        </>
      )}
    </g>
  );
}

const HEAD = 9; // [px]

/** An arrow between two places of the drawing: a line, and a head that is never longer than the arrow. */
export function arrowPath([x, y]: Pair, [tx, ty]: Pair): string {
  const [dx, dy] = [tx - x, ty - y];
  const length = Math.hypot(dx, dy);
  if (length < 0.1) return "";
  const head = Math.min(HEAD, length) / length;
  const wing = (side: number) =>
    `${(tx - head * (dx + side * 0.45 * dy)).toFixed(1)} ${(ty - head * (dy - side * 0.45 * dx)).toFixed(1)}`;
  const neck = `${(tx - dx * head * 0.8).toFixed(1)} ${(ty - dy * head * 0.8).toFixed(1)}`;
  return `M${x.toFixed(1)} ${y.toFixed(1)}L${neck}M${tx.toFixed(1)} ${ty.toFixed(1)}L${wing(1)}L${wing(-1)}z`;
}
