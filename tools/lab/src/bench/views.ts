// What the sheet and the plots of the bench can show, all at the same scale.
import type { Bench, Drawn, Ends, Live } from "./live";

export type ViewName = "now" | "before" | "as_set" | "drawn" | "difference";
export type Pair = readonly [number, number];

export const VIEWS: readonly { name: ViewName; title: string }[] = [
  { name: "now", title: "Left now" },
  { name: "before", title: "Left by the frame alone" },
  { name: "as_set", title: "As the machine is set" },
  { name: "difference", title: "What your effects take away" },
  { name: "drawn", title: "What an effect would draw" },
];

/** Errors of the marks on the sheet and in chain [mm]. */
export interface View {
  errors: readonly Pair[];
  chains: readonly Ends[];
}

/** What a view shows; undefined while it is on its way. */
export function viewOf(
  name: ViewName,
  bench: Bench,
  live: Live,
  drawn: Drawn | undefined,
): View | undefined {
  const { now, frame } = live;
  if (name === "as_set")
    return {
      errors: bench.marks.map((mark) => mark.error),
      chains: bench.marks.map((mark) => [mark.left_chain_residual, mark.right_chain_residual]),
    };
  if (name === "drawn") return drawn && { errors: drawn.moved, chains: drawn.chains };
  if (name === "before") return frame;
  if (name === "now") return now?.fit;
  if (!now || !frame) return undefined;
  return {
    errors: frame.errors.map((error, i) => minus(error, now.fit.errors[i] ?? error)),
    chains: frame.chains.map((ends, i) => endsMinus(ends, now.fit.chains[i] ?? ends)),
  };
}

function minus(from: Pair, what: Pair): Pair {
  return [from[0] - what[0], from[1] - what[1]];
}

function endsMinus(from: Ends, what: Ends): Ends {
  const side = (i: 0 | 1) => {
    const [a, b] = [from[i], what[i]];
    return a === null || b === null ? null : a - b;
  };
  return [side(0), side(1)];
}

/** The longest of some errors [mm]. */
export function longest(errors: readonly Pair[]): number {
  return Math.max(0, ...errors.map(([x, y]) => Math.hypot(x, y)));
}

/** The largest error of a chain [mm]. */
export function largest(chains: readonly Ends[]): number {
  return Math.max(0, ...chains.flat().map((end) => Math.abs(end ?? 0)));
}
