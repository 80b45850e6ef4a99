// Where the model fails: the marks in each state, on the sheet and against what errors may depend on.
import { useMemo, useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { Sheet } from "../sheet/Sheet";
import { Plots } from "./Plots";
import { endsOf, SpanLines, SpanTable } from "./Spans";
import type { Drawn } from "./useDrawn";
import "./residuals.css";

type State = Schemas["State"];

interface Readings {
  marks: readonly Schemas["ComparedMark"][];
  spans: readonly Schemas["Span"][];
  sigma: number | null; // [mm] of a reading
  doubted?: readonly number[];
  doubted_spans?: readonly number[];
}

interface ResidualsParts {
  /** The doubted among them do not affect the scale. */
  readings: Readings;
  /** As set, with the frame fitted, and with effects; or as set, and with new numbers. */
  states: readonly State[];
  /** The state drawn below the one shown. */
  ghosts?: State | undefined;
  covariates?: readonly Schemas["BenchCovariate"][] | undefined;
  /** The effects' patterns, over the errors that the frame leaves. */
  drawn?: Drawn | undefined;
  /** The state shown at first: where the model fails, or what is left. */
  opensOn?: "second" | "last";
  slides?: boolean;
}

const NONE: readonly number[] = [];
const SECOND = 1; // the state of the fitted frame

export function Residuals(parts: ResidualsParts) {
  const { readings, states, ghosts, covariates, drawn, opensOn = "last", slides } = parts;
  const { marks, spans, doubted = NONE, doubted_spans: doubtedSpans = NONE } = readings;
  const sigma = readings.sigma ?? 0;
  const [chosen, show] = useState<string>();
  const [selected, select] = useState<number>();
  const last = states.length - 1;
  const found = states.findIndex(({ title }) => title === chosen);
  const usual = opensOn === "second" || drawn ? Math.min(SECOND, last) : last;
  const shown = found < 0 ? usual : found;
  const state = states[shown];
  const drawnMarks = useMemo(() => {
    const all = marks.map((mark, i) => ({ ...mark, isDoubted: doubted.includes(i) }));
    return [...all, ...endsOf(spans, new Set(marks.map(({ name }) => name)))];
  }, [marks, spans, doubted]);
  const laid = shown === SECOND ? drawn : undefined;
  const scale = states[Math.min(SECOND, last)];
  const plots = useMemo(
    () =>
      covariates &&
      marks.length > 0 &&
      state &&
      scale && (
        <Plots {...{ covariates, state, scale, doubted, sigma, selected, select }} drawn={laid} />
      ),
    [covariates, marks, state, scale, laid, selected, doubted, sigma],
  );
  const taped = state && { spans, state, doubted: doubtedSpans, sigma };
  return (
    <>
      <Sheet
        label={`Errors of ${countWords(marks.length, spans.length)}, ${state?.title ?? "being fitted"}`}
        marks={drawnMarks}
        states={states}
        shown={shown}
        show={(index) => show(states[index]?.title)}
        ghosts={shown === last ? ghosts : undefined}
        print={laid?.moved}
        sigma={sigma}
        selected={selected}
        select={select}
        slides={slides}
      >
        {taped && <SpanLines {...taped} scale={scale ?? taped.state} />}
      </Sheet>
      {taped && <SpanTable {...taped} />}
      {plots}
    </>
  );
}

function countWords(marks: number, spans: number): string {
  const words = [marks > 0 && `${marks} marks`, spans > 0 && `${spans} distances`];
  return words.filter(Boolean).join(" and ");
}
