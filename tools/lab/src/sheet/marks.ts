// Marks and their errors, as every drawing of the sheet has them; and the same as a table.
import type { Pair } from "./view";

export type Ends = readonly [number | null, number | null]; // left and right chain [mm]

/** A mark [mm, machine frame]. */
export interface Mark {
  name: string;
  target: Pair;
  measured?: Pair | null | undefined;
  /** How its place is drawn where it has no arrow. */
  look?: "waits" | "planned" | "done" | "next" | "faint";
  /** Has a ring, and its arrow does not count for the scale. */
  isDoubted?: boolean;
  /** What else is said of it. */
  also?: string;
}

/** The marks in a state of the machine: null where a mark has no error [mm]. */
export interface State {
  title: string;
  errors: readonly (Pair | null)[];
  chains?: readonly Ends[];
  fit_rms?: number;
  noise_rms?: number | null;
  /** How far off each mark may be [mm], where that is promised; else it is as far as noise alone makes it. */
  promised?: readonly number[];
}

const COLUMNS =
  "state,name,target_x_mm,target_y_mm,measured_x_mm,measured_y_mm,error_x_mm,error_y_mm,chain_left_mm,chain_right_mm,sigma_mm";

/** All states as a table with commas. */
export function table(
  marks: readonly Mark[],
  states: readonly State[],
  sigma: number | undefined,
): string {
  const rows = (states.length > 0 ? states : [undefined]).flatMap((state) =>
    marks.map((mark, i) => [
      cell(state?.title ?? "planned"),
      cell(mark.name),
      ...both(mark.target),
      ...both(mark.measured),
      ...both(state?.errors[i]),
      ...both(state?.chains?.[i]),
      number(sigma),
    ]),
  );
  return `${[COLUMNS, ...rows.map((row) => row.join(","))].join("\n")}\n`;
}

function both(pair: readonly (number | null)[] | null | undefined): string[] {
  return [number(pair?.[0]), number(pair?.[1])];
}

function number(value: number | null | undefined): string {
  return value == null ? "" : String(Number(value.toFixed(4)));
}

/** A text in a cell: quoted where it could end the cell, and never a formula of a spreadsheet. */
function cell(text: string): string {
  const plain = /^[=+@-]/.test(text) && !/^-?\d/.test(text) ? `'${text}` : text;
  return /[",\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}
