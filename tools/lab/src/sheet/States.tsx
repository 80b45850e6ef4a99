// The states that are compared, each with what it leaves: a press shows it.
import { useId } from "preact/hooks";
import { namedLength, shownLength, type Unit } from "../controls/lengths";
import type { State } from "./marks";

interface StatesParts {
  states: readonly State[];
  shown: number;
  show: (index: number) => void;
  units: Unit;
}

export function States({ states, shown, show, units }: StatesParts) {
  const name = useId();
  return (
    <fieldset class="segments states">
      <legend>What is drawn</legend>
      {states.map((state, i) => (
        <label key={i}>
          <input type="radio" name={name} checked={i === shown} onChange={() => show(i)} />
          <span>
            {state.title}{" "}
            {state.fit_rms !== undefined && <b>{namedLength(state.fit_rms, units, 2)}</b>}
            {state.noise_rms != null && (
              <small> noise leaves {shownLength(state.noise_rms, units, 2)}</small>
            )}
          </span>
        </label>
      ))}
    </fieldset>
  );
}
