// The numbers of a correction: before, after with their interval, and whether a real machine can have them.
import type { Schemas } from "../../api/client";
import { Table } from "../../controls/Table";

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
      rows={numbers.map(({ name, noun, before, after, margin, unit, possible, range_said }) => [
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
          {range_said && (
            <small class={possible ? "" : "wrong"}>
              {!possible && "impossible: "}real machines have {range_said}
              {!possible && "; something else looks like it"}
            </small>
          )}
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
