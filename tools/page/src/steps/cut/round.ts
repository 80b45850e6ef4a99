// A round of marks: whether it runs, and its times by the lines that the machine has taken.
import type { Schemas } from "../../api/client";
import type { Machine } from "../../shell/machine";

export type Round = Schemas["RoundAnswer"];

export interface RoundParts {
  round: Round;
  /** Whether the button of the screen does it. */
  isNext?: boolean;
}

/** How the program of a round ended or that it runs; undefined if another ran last, or none. */
export function outcomeOf({ program }: Round, machine: Machine) {
  return machine.program?.title === program ? machine.program.outcome : undefined;
}

export function isCut(round: Round, machine: Machine): boolean {
  return outcomeOf(round, machine) === "done" || round.broke_off === round.marks.length;
}

/** Minutes from the start until so many lines are done; 0 where no machine says how fast it is. */
export function minutesAt({ done_at }: Round, lines: number): number {
  return done_at[Math.min(lines, done_at.length - 1)] ?? 0;
}

/** How many marks are cut once so many lines are done. */
export function marksBefore(round: Round, lines: number): number {
  return round.lines.filter((each) => each <= lines).length;
}
