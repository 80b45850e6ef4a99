// The planned marks on the sheet: add marks by their place, or remove the chosen one.
import { useState } from "preact/hooks";
import { Field } from "../../controls/Field";
import { typedLength, useUnits } from "../../controls/lengths";
import { Sheet } from "../../sheet/Sheet";

export type Place = [number, number]; // [mm] machine frame

const AXES = ["x", "y"];

interface MapParts {
  places: Place[];
  keep: (places: Place[]) => void;
}

export function MarksMap({ places, keep }: MapParts) {
  const units = useUnits();
  const [selected, select] = useState<number>();
  const [typed, setTyped] = useState(["", ""]);
  const [x, y] = typed.map((text) => typedLength(text, units));
  const add = (event: Event) => {
    event.preventDefault();
    if (x !== undefined && y !== undefined) keep([...places, [x, y]]);
  };
  const takeAway = () => {
    keep(places.filter((_, i) => i !== selected));
    select(undefined);
  };
  return (
    <>
      <Sheet
        label={`${places.length} planned marks`}
        marks={places.map((target, i) => ({ name: String(i + 1), target, look: "done" }))}
        selected={selected}
        select={select}
      />
      <details>
        <summary>Other marks: by their place, or without one</summary>
        <form class="row" onSubmit={add}>
          {AXES.map((axis, i) => (
            <Field
              key={axis}
              label={`${axis} from the middle, ${units}`}
              inputMode={units === "mm" ? "decimal" : "text"}
              value={typed[i] ?? ""}
              hear={(text) => setTyped(typed.with(i, text))}
            />
          ))}
          <button type="submit" disabled={x === undefined || y === undefined}>
            Add a mark
          </button>
          <button type="button" disabled={selected === undefined} onClick={takeAway}>
            {selected === undefined ? "Take away: choose a mark" : `Take mark ${selected + 1} away`}
          </button>
        </form>
      </details>
    </>
  );
}
