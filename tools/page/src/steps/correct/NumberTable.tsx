// The numbers of a correction: before, after with their interval, and whether a real machine can have them.
import type { Schemas } from "../../api/client";
import { Table } from "../../controls/Table";
import { useProject } from "../../shell/project";

interface TableParts {
  numbers: readonly Schemas["ChangedNumber"][];
  /** The names of the accepted numbers, if they can be chosen. */
  accepted?: readonly string[];
  accept?: (names: string[]) => void;
}

export function NumberTable({ numbers, accepted = [], accept }: TableParts) {
  return (
    <Table
      class="wide change"
      names={["number", "was", "becomes"]}
      rows={numbers.map(({ name, noun, before, after, margin, unit, possible, met }) => [
        <>
          {accept ? (
            <label class="tick">
              <input
                type="checkbox"
                checked={accepted.includes(name)}
                onChange={({ currentTarget: { checked } }) => {
                  const others = accepted.filter((each) => each !== name);
                  accept(checked ? [...others, name] : others);
                }}
              />
              {noun}
            </label>
          ) : (
            noun
          )}
          {met && <small class={possible ? "" : "wrong"}>{met}</small>}
        </>,
        before,
        <>
          <b>{after}</b>
          <small>
            ± {margin} {unit}
          </small>
        </>,
      ])}
    />
  );
}

/** The numbers of the machine, each with a box to accept it. */
export function Numbers({ made, busy }: { made: Schemas["CorrectionParts"]; busy: boolean }) {
  const { project, choose } = useProject();
  // Including those not yet saved on the server.
  const accepted = project.choices.accepted ?? [];
  const accept = (names: string[]) => choose({ accepted: names });
  const now = made.asked;
  // Those that a real machine can have.
  const all = now.filter(({ possible }) => possible).map(({ name }) => name);
  if (now.length === 0) return null;
  return (
    <fieldset class="numbers" aria-busy={busy}>
      <legend>Numbers of the machine</legend>
      <NumberTable numbers={now} accepted={accepted} accept={accept} />
      {all.some((name) => !accepted.includes(name)) && (
        <button type="button" onClick={() => accept([...new Set([...accepted, ...all])])}>
          Accept all {all.length}
        </button>
      )}
    </fieldset>
  );
}
