// Where it fails: the marks of a board in each state, on the sheet and against all that errors may depend on.
import { useMemo, useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { Sheet } from "../sheet/Sheet";
import { useProject } from "../shell/project";
import { type Covariate, type Left, Plots } from "./Plots";
import type { Drawn } from "./useDrawn";
import { useRested } from "./useRested";
import "./residuals.css";

interface ResidualsParts {
  marks: readonly Schemas["ComparedMark"][];
  /** As set, with the frame fitted, and with effects. */
  states: readonly Left[];
  /** The state below that which is shown. */
  ghosts?: Left | undefined;
  sigma: number; // [mm] of a reading
  covariates: readonly Covariate[] | undefined;
  /** What effects draw, over what the frame leaves. */
  drawn: Drawn | undefined;
  sheet: readonly [number, number];
}

const FRAME = 1; // the state of the fitted frame

export function Residuals(parts: ResidualsParts) {
  const { marks, states, ghosts, sigma, covariates, drawn, sheet } = parts;
  const units = useProject().project.choices.units ?? "mm";
  const [chosen, show] = useState<number>();
  const [selected, select] = useState<number>();
  // What an effect draws is compared with what the frame leaves, unless somebody chose another state.
  const usual = drawn ? FRAME : states.length - 1;
  const shown = Math.min(chosen ?? usual, states.length - 1);
  const state = states[shown];
  const drawnMarks = useMemo(
    () => marks.map(({ name, target, measured }) => ({ name, target, measured })),
    [marks],
  );
  const laid = shown === FRAME ? drawn : undefined;
  // A slider moves the arrows; the plots follow a few times a second.
  const plotted = useRested(state);
  const frame = states[FRAME];
  const plots = useMemo(
    () =>
      covariates &&
      plotted &&
      frame && (
        <Plots
          covariates={covariates}
          state={plotted}
          scale={frame}
          drawn={laid}
          units={units}
          selected={selected}
          select={select}
        />
      ),
    [covariates, plotted, frame, laid, units, selected],
  );
  if (!state) return null;
  return (
    <>
      <Sheet
        size={sheet}
        label={`Errors of ${marks.length} marks, ${state.title}`}
        name="residuals"
        units={units}
        marks={drawnMarks}
        states={states}
        shown={shown}
        show={show}
        ghosts={shown === states.length - 1 ? ghosts : undefined}
        print={laid?.moved}
        sigma={sigma}
        selected={selected}
        select={select}
      />
      {plots}
    </>
  );
}
