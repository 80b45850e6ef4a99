// Where the model fails: the marks in each state, on the sheet and against what errors may depend on.
import { useMemo, useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { useUnits } from "../controls/units";
import { Sheet } from "../sheet/Sheet";
import { type Covariate, type Left, Plots } from "./Plots";
import { endsOf, SpanLines, SpanTable } from "./Spans";
import type { Drawn } from "./useDrawn";
import "./residuals.css";

interface ResidualsParts {
  /** The doubted among them do not affect the scale. */
  readings: Pick<Schemas["BenchAnswer"], "marks" | "spans" | "sigma" | "doubted" | "doubted_spans">;
  /** As set, with the frame fitted, and with effects. */
  states: readonly Left[];
  /** The state drawn below the one shown. */
  ghosts?: Left | undefined;
  covariates: readonly Covariate[] | undefined;
  /** The effects' patterns, over the errors that the frame leaves. */
  drawn: Drawn | undefined;
  /** The state shown at first: where the model fails, or what is left. */
  opensOn?: "frame" | "last";
}

const FRAME = 1; // the state of the fitted frame

export function Residuals(parts: ResidualsParts) {
  const { readings, states, ghosts, covariates, drawn, opensOn = "last" } = parts;
  const { marks, spans, sigma, doubted, doubted_spans: doubtedSpans } = readings;
  const units = useUnits();
  const [chosen, show] = useState<number>();
  const [selected, select] = useState<number>();
  const shown = Math.min(
    chosen ?? (opensOn === "frame" || drawn ? FRAME : states.length),
    states.length - 1,
  );
  const state = states[shown];
  const drawnMarks = useMemo(() => {
    const all = marks.map(({ name, target, measured }, i) => ({
      name,
      target,
      measured,
      isDoubted: doubted.includes(i),
    }));
    return [...all, ...endsOf(spans, new Set(marks.map(({ name }) => name)))];
  }, [marks, spans, doubted]);
  const laid = shown === FRAME ? drawn : undefined;
  const frame = states[Math.min(FRAME, states.length - 1)];
  const plots = useMemo(
    () =>
      covariates &&
      marks.length > 0 &&
      state &&
      frame && (
        <Plots
          covariates={covariates}
          state={state}
          scale={frame}
          drawn={laid}
          doubted={doubted}
          sigma={sigma}
          units={units}
          selected={selected}
          select={select}
        />
      ),
    [covariates, marks, state, frame, laid, units, selected, doubted, sigma],
  );
  if (!state) return null;
  const taped = { spans, state, doubted: doubtedSpans, sigma, units };
  return (
    <>
      <Sheet
        label={`Errors of ${countWords(marks.length, spans.length)}, ${state.title}`}
        marks={drawnMarks}
        states={states}
        shown={shown}
        show={show}
        ghosts={shown === states.length - 1 ? ghosts : undefined}
        print={laid?.moved}
        sigma={sigma}
        selected={selected}
        select={select}
      >
        <SpanLines {...taped} scale={frame ?? state} />
      </Sheet>
      <SpanTable {...taped} />
      {plots}
    </>
  );
}

function countWords(marks: number, spans: number): string {
  const words = [marks > 0 && `${marks} marks`, spans > 0 && `${spans} distances`];
  return words.filter(Boolean).join(" and ");
}
