// Columns of a spreadsheet as readings: x and y for each mark from a cell on, or name, x and y.
import type { Schemas } from "../api/client";
import { typedLength, type Unit } from "../controls/lengths";
import type { Place, Typed } from "./useReadings";

/** The readings in a pasted text; undefined if it is a single cell or no table of lengths. */
export function pasted(
  text: string,
  marks: readonly Schemas["AskedMark"][],
  first: number,
  units: Unit,
): Typed | undefined {
  const rows = text
    .trim()
    .split(/\r?\n/)
    .map((line) => line.split(/\t|;/).map((part) => part.trim()));
  if (rows.length === 1 && (rows[0]?.length ?? 0) < 2) return undefined;
  const typed: Record<string, Place> = {};
  for (const [line, row] of rows.entries()) {
    const named = row.length > 2;
    const [x, y] = row.slice(named ? 1 : 0).map((part) => typedLength(part, units));
    const mark = named ? marks.find((mark) => mark.name === row[0]) : marks[first + line];
    if (x === undefined || y === undefined || !mark) continue;
    typed[mark.index] = [x, y];
  }
  return Object.keys(typed).length ? typed : undefined;
}
