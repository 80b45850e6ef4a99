// What is typed, and one of many, each with its label before it.
import type { InputHTMLAttributes } from "preact";

type Typing = "inputMode" | "value" | "placeholder" | "autocomplete" | "maxLength" | "size";

interface FieldParts extends Pick<InputHTMLAttributes, Typing | "aria-invalid"> {
  label: string;
  /** Hears what is typed. */
  hear: (text: string) => void;
}

export function Field({ label, hear, ...input }: FieldParts) {
  return (
    <label>
      {label} <input {...input} onInput={(event) => hear(event.currentTarget.value)} />
    </label>
  );
}

interface SelectParts<Value> {
  label: string;
  options: readonly (readonly [value: Value, words: string])[];
  chosen: Value;
  choose: (value: Value) => void;
}

export function Select<Value extends string | number>(parts: SelectParts<Value>) {
  const { label, options, chosen, choose } = parts;
  return (
    <label>
      {label}{" "}
      <select
        value={String(chosen)}
        onChange={({ currentTarget }) =>
          choose((options[currentTarget.selectedIndex] ?? [chosen])[0])
        }
      >
        {options.map(([value, words]) => (
          <option key={value} value={String(value)}>
            {words}
          </option>
        ))}
      </select>
    </label>
  );
}
