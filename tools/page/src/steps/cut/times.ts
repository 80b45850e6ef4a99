// The times of a cut, by the lines that the machine has taken.
import type { Grid } from "../Cut";

/** Minutes from the start until so many lines are done; 0 where no machine says how fast it is. */
export function minutesAt({ done_at }: Grid, lines: number): number {
  return done_at[Math.min(lines, done_at.length - 1)] ?? 0;
}

/** How many marks are cut once so many lines are done. */
export function marksBefore({ marks }: Grid, lines: number): number {
  return marks.filter((mark) => mark.lines <= lines).length;
}
