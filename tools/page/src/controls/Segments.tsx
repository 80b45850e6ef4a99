// One of a few, chosen by a press.
import type { ComponentChildren } from "preact";
import { useId } from "preact/hooks";

interface SegmentsParts<Value> {
  legend: string;
  options: readonly (readonly [value: Value, words: ComponentChildren])[];
  chosen: Value;
  choose: (value: Value) => void;
  class?: string;
}

export function Segments<Value extends string | number>(parts: SegmentsParts<Value>) {
  const { legend, options, chosen, choose, class: look = "" } = parts;
  const name = useId();
  return (
    <fieldset class={`segments ${look}`}>
      <legend>{legend}</legend>
      {options.map(([value, words]) => (
        <label key={value}>
          <input
            type="radio"
            name={name}
            checked={value === chosen}
            onChange={() => choose(value)}
          />
          <span>{words}</span>
        </label>
      ))}
    </fieldset>
  );
}
