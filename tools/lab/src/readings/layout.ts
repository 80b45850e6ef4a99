// Where the cells of marks stand: in rows and columns like the marks on the sheet.
import type { Schemas } from "../api/client";

type Asked = Schemas["AskedMark"];
const NEAR_MM = 60; // marks nearer than this along an axis share a row or a column
const MOST_COLUMNS = 9; // beyond it the cells become too narrow, so they stand one after the other

export interface Spot {
  row: number;
  column: number;
  marks: Asked[];
}

export interface Layout {
  columns: number; // 0: no grid, the marks have their order only
  spots: Spot[];
}

/** Rows from the top down and columns from the left; marks of a spot are repeats. */
export function layoutOf(marks: readonly Asked[]): Layout {
  const columns = groups(marks.map((mark) => mark.target[0]));
  const rows = groups(marks.map((mark) => -mark.target[1]));
  const spots = new Map<string, Spot>();
  for (const mark of marks) {
    const [column, row] = [groupOf(columns, mark.target[0]), groupOf(rows, -mark.target[1])];
    const spot = spots.get(`${row}/${column}`) ?? { row, column, marks: [] };
    spot.marks.push(mark);
    spots.set(`${row}/${column}`, spot);
  }
  const sorted = [...spots.values()].sort((a, b) => a.row - b.row || a.column - b.column);
  const scattered = sorted.length < 0.5 * columns.length * rows.length;
  return {
    columns: scattered || columns.length > MOST_COLUMNS ? 0 : columns.length,
    spots: sorted,
  };
}

/** The first number of each group of near numbers, rising. */
function groups(numbers: number[]): number[] {
  const starts: number[] = [];
  let last = Number.NEGATIVE_INFINITY;
  for (const number of [...numbers].sort((a, b) => a - b)) {
    if (number - last > NEAR_MM) starts.push(number);
    last = number;
  }
  return starts;
}

function groupOf(starts: readonly number[], number: number): number {
  return starts.filter((start) => start <= number).length;
}

/** Whether a mark of the same name comes before it. */
export function isAgain(marks: readonly Asked[], index: number): boolean {
  return marks.findIndex((mark) => mark.name === marks[index]?.name) < index;
}
