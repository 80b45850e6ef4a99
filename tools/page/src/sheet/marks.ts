// Marks and their errors, for every drawing of the sheet.
import type { Pair } from "./view";

export type Ends = readonly [number | null, number | null]; // left and right chain [mm]

/** A mark [mm, machine frame]. */
export interface Mark {
  name: string;
  target: Pair;
  measured?: Pair | null | undefined;
  /** How to draw it if it has no arrow. */
  look?: "waits" | "planned" | "done" | "next" | "faint";
  /** It gets a ring, and its arrow does not affect the scale. */
  isDoubted?: boolean;
  /** Further text about it. */
  also?: string;
}

/** The marks in a state of the machine: null where a mark has no error [mm]. */
export interface State {
  title: string;
  errors: readonly (Pair | null)[];
  chains?: readonly Ends[];
  fit_rms?: number;
  noise_rms?: number | null;
  /** How far off each mark may be [mm], if that is promised; otherwise noise alone decides. */
  promised?: readonly number[];
}
