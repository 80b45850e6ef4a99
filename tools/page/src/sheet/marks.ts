// Marks and their errors, as every drawing of the sheet has them.
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
