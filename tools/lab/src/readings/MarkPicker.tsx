// The marks as a small map of buttons, for a phone: what is read, what waits, and which mark is open.
import { isAgain, type Layout } from "./layout";
import type { Form, Typed } from "./useReadings";

interface PickerParts {
  form: Form;
  layout: Layout;
  typed: Typed;
  doubted: ReadonlySet<number>;
  open: number;
  pick: (index: number) => void;
}

const SHORT = 4; // letters; marks of longer names have no room in columns

export function MarkPicker({ form, layout, typed, doubted, open, pick }: PickerParts) {
  const inColumns = layout.columns > 0 && form.marks.every(({ name }) => name.length <= SHORT);
  return (
    <fieldset
      class={inColumns ? "picker row in-columns" : "picker row"}
      style={inColumns ? { "--columns": layout.columns } : undefined}
    >
      <legend>Marks on the sheet: tap what you read</legend>
      {layout.spots.map((spot) => (
        <div
          class="row"
          key={`${spot.row}/${spot.column}`}
          style={inColumns ? { "--row": spot.row, "--column": spot.column } : undefined}
        >
          {spot.marks.map(({ index, name }) => {
            const again = isAgain(
              form.marks,
              form.marks.findIndex((mark) => mark.index === index),
            );
            const state = doubted.has(index) ? "look again" : typed[index] ? "read" : "waits";
            return (
              <button
                key={index}
                type="button"
                id={`pick-${index}`}
                class={state === "look again" ? "doubted" : state}
                aria-pressed={index === open}
                aria-label={`Mark ${name}${again ? " again" : ""}: ${state}`}
                onClick={() => pick(index)}
              >
                {name}
                <span aria-hidden="true">{SIGNS[state]}</span>
              </button>
            );
          })}
        </div>
      ))}
    </fieldset>
  );
}

const SIGNS = { read: "✓", waits: "", "look again": "!" };
