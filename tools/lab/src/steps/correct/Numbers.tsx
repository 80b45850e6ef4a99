// The numbers of the machine, each with a box to accept it.
import type { Schemas } from "../../api/client";
import { believable, withAll } from "./believable";

type Parts = Schemas["CorrectionParts"];
type Changed = Schemas["ChangedNumber"];

interface NumbersParts {
  made: Parts;
  /** Names of the accepted numbers, those too that the server does not know yet. */
  accepted: readonly string[];
  accept: (names: string[]) => void;
  busy: boolean;
}

export function Numbers({ made, accepted, accept, busy }: NumbersParts) {
  const again = new Map(made.with_accepted.map((number) => [number.name, number]));
  const now = made.numbers.map((number) => again.get(number.name) ?? number);
  const all = believable(now);
  return (
    <fieldset class="numbers" aria-busy={busy}>
      <legend>Numbers of the machine</legend>
      {now.map((number) => (
        <label
          key={number.name}
          class={accepted.includes(number.name) ? "number accepted" : "number"}
        >
          <input
            type="checkbox"
            checked={accepted.includes(number.name)}
            onChange={(event) =>
              accept(
                event.currentTarget.checked
                  ? [...accepted, number.name]
                  : accepted.filter((name) => name !== number.name),
              )
            }
          />
          <span class="noun">{number.noun}</span>
          <Change number={number} />
          {!number.possible && (
            <span class="impossible">
              impossible: real machines have {number.range_said}; something else looks like it
            </span>
          )}
        </label>
      ))}
      {all.some((name) => !accepted.includes(name)) && (
        <button type="button" onClick={() => accept(withAll(accepted, all))}>
          Accept all {all.length}
        </button>
      )}
    </fieldset>
  );
}

function Change({ number }: { number: Changed }) {
  return (
    <span class="change">
      {number.before} <span aria-hidden="true">→</span>
      <span class="spoken"> becomes </span> <b>{number.after}</b> ± {number.margin} {number.unit}
    </span>
  );
}
