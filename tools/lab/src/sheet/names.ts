// Where the names of marks stand: none over another, none outside of what is seen.
import type { Pair } from "./view";

const LETTER = 0.62; // of the size of the type
const CORNERS: readonly Pair[] = [
  [1, 1],
  [1, -1],
  [-1, 1],
  [-1, -1],
];

export interface Named {
  name: string;
  at: Pair; // [px] y runs down
  first: boolean; // has its name before all others
}

/** A name that is written: its left end and its foot [px]. */
export interface Written {
  index: number;
  x: number;
  y: number;
}

interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** The names that have room, by the corner of their mark at which they fit. */
export function written(
  marks: readonly Named[],
  type: number,
  gap: number,
  { left, right, top, bottom }: Box,
): Written[] {
  const taken: Box[] = [];
  const order = marks.map((_, i) => i);
  order.sort((i, j) => Number(marks[j]?.first) - Number(marks[i]?.first) || i - j);
  return order.flatMap((index) => {
    const mark = marks[index];
    if (!mark?.name) return [];
    const wide = LETTER * type * mark.name.length;
    for (const [across, down] of CORNERS) {
      const x = across > 0 ? mark.at[0] + gap : mark.at[0] - gap - wide;
      const y = down > 0 ? mark.at[1] + gap + 0.8 * type : mark.at[1] - gap;
      const box = { left: x, right: x + wide, top: y - 0.8 * type, bottom: y + 0.2 * type };
      const isSeen = x >= left && box.right <= right && box.top >= top && box.bottom <= bottom;
      if (!isSeen || taken.some((other) => overlap(box, other))) continue;
      taken.push(box);
      return [{ index, x, y }];
    }
    return [];
  });
}

function overlap(one: Box, other: Box): boolean {
  return (
    one.left < other.right &&
    other.left < one.right &&
    one.top < other.bottom &&
    other.top < one.bottom
  );
}
