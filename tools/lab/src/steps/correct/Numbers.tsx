// The numbers of the machine, each with a box to accept it.
import type { Schemas } from "../../api/client";
import { useProject } from "../../shell/project";
import { asked } from "./asked";
import { believable, withAll } from "./believable";

type Parts = Schemas["CorrectionParts"];
type Changed = Schemas["ChangedNumber"];

export function Numbers({ made, busy }: { made: Parts; busy: boolean }) {
  const { project, choose } = useProject();
  // Those too that the server does not know yet.
  const accepted = project.choices.accepted ?? [];
  const accept = (names: string[]) => void choose({ accepted: names });
  const now = asked(made, accepted);
  const all = believable(now);
  if (now.length === 0) return null;
  return (
    <fieldset class="numbers" aria-busy={busy}>
      <legend>Numbers of the machine</legend>
      {now.map((number) => (
        <label
          key={number.name}
          class={accepted.includes(number.name) ? "number box accepted" : "number box"}
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
            <span class="wrong">
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
