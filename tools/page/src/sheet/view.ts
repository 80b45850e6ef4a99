// How marks are drawn and found: arithmetic of the sheet.
import { withMinus } from "../controls/lengths";

export type Pair = readonly [number, number];

const MOST = 500; // times
const LONGEST = 0.16; // of the sheet's width, for the longest arrow
const WIDEST = 0.06; // of the sheet's width, for the radius of a circle of noise

/** How much arrows are enlarged: a round number at which the longest is easy to see. */
export function factorFor(
  errors: readonly (Pair | null)[],
  width: number,
  circle: number, // [mm] radius, the same number of times larger
): number {
  const longest = Math.max(1e-6, ...errors.map((error) => (error ? Math.hypot(...error) : 0)));
  const most = Math.min((LONGEST * width) / longest, (WIDEST * width) / Math.max(1e-6, circle));
  return Math.max(1, Math.min(MOST, rounded(most)));
}

/** The largest of 1, 2, 5, 10, ... up to this number. */
export function rounded(most: number): number {
  const ten = 10 ** Math.floor(Math.log10(most) + 1e-9);
  return [5, 2].map((digit) => digit * ten).find((each) => each <= most * (1 + 1e-9)) ?? ten;
}

/** Round numbers between two others, at most this many. */
export function ticks(end: number, other: number, count: number): number[] {
  const [low, high] = end < other ? [end, other] : [other, end];
  const span = high - low;
  if (!(span > 0)) return [];
  const least10 = 10 ** Math.floor(Math.log10(span / count));
  const step =
    [1, 2, 5, 10].map((digit) => digit * least10).find((each) => span / each <= count * 1.001) ??
    span;
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) =>
    Number(((first + i) * step).toPrecision(10)),
  );
}

/** A number at an axis, with a minus as wide as the figures. */
export function tickText(tick: number): string {
  return withMinus(String(Number(tick.toPrecision(6))));
}

const WAYS: Record<string, Pair> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** The mark that an arrow key leads to: the nearest in that direction; undefined for other keys. */
export function markAt(
  key: string,
  places: readonly Pair[],
  from: number | undefined,
): number | undefined {
  if (key === "Home") return 0;
  if (key === "End") return places.length - 1;
  const way = WAYS[key];
  if (!way) return undefined;
  const here = from === undefined ? undefined : places[from];
  if (!here) return 0;
  let [best, least]: [number | undefined, number] = [from, Number.POSITIVE_INFINITY];
  places.forEach(([x, y], i) => {
    const [dx, dy] = [x - here[0], y - here[1]];
    const along = dx * way[0] + dy * way[1];
    const aside = Math.abs(dx * way[1]) + Math.abs(dy * way[0]);
    if (along > 1e-6 && along + 3 * aside < least) [best, least] = [i, along + 3 * aside];
  });
  return best;
}

/** The place nearest to another, within a reach; all in the same unit. */
export function nearest(
  [x, y]: Pair,
  places: readonly (Pair | null | undefined)[],
  reach: number,
): number | undefined {
  let [best, least]: [number | undefined, number] = [undefined, reach];
  places.forEach((place, i) => {
    const gap = place ? Math.hypot(place[0] - x, place[1] - y) : reach;
    if (gap < least) [best, least] = [i, gap];
  });
  return best;
}

/** The pointer's place in the drawing [px]. */
export function pointIn(event: MouseEvent): Pair {
  const box = (event.currentTarget as SVGElement).getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}
