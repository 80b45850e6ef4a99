// The numbers of a correction: before, after with their interval, and whether a real machine can have them.
import type { Schemas } from "../../api/client";
import { Head } from "../../controls/Head";

interface TableParts {
  numbers: readonly Schemas["ChangedNumber"][];
  /** The names of the accepted numbers, if they can be chosen. */
  accepted?: readonly string[];
  accept?: (names: string[]) => void;
}

export function NumberTable({ numbers, accepted = [], accept }: TableParts) {
  return (
    <table class="wide">
      <Head names={["number", "before", "after"]} />
      <tbody>
        {numbers.map(({ name, noun, before, after, margin, unit, possible, range_said }) => (
          <tr key={name}>
            <th scope="row">
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
            </th>
            <td>{before}</td>
            <td>
              <b>{after}</b> ± {margin} {unit}
              {range_said && (
                <small class={possible ? "" : "wrong"}>
                  {!possible && "impossible: "}real machines have {range_said}
                  {!possible && "; something else looks like it"}
                </small>
              )}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
