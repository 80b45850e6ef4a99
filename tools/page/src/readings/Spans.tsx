// Distances between marks that the form has: each can be corrected, or removed.
import type { ComponentChildren } from "preact";
import { lengthText, noLength, typedLength, useUnits } from "../controls/lengths";
import { useTyped } from "../controls/useTyped";
import { DoubtAt } from "./DoubtAt";
import { useSaveDistance } from "./saves";
import type { Doubt } from "./useDoubts";
import type { Form, TypedForm } from "./useReadings";

interface SpansParts {
  form: Form;
  readings: TypedForm;
  doubts: readonly Doubt[];
}

export function Spans({ form, readings, doubts }: SpansParts) {
  const save = useSaveDistance(form, readings.take);
  const { file, distances } = form;
  if (distances.length === 0) return null;
  return (
    <ol class="spans" aria-label="Distances">
      {distances.map((distance, index) => {
        const doubt = doubts.find((each) => !each.is_mark && each.index === index);
        return (
          <Span
            key={`${file}/${index}`}
            name={distance.between.join(" to ")}
            index={index}
            length={distance.length}
            doubt={doubt && <DoubtAt {...{ doubt, form, readings }} />}
            keep={(length) => void save(distance, length)}
          />
        );
      })}
    </ol>
  );
}

interface SpanParts {
  name: string;
  /** Its index among the form's distances. */
  index: number;
  length: number;
  doubt: ComponentChildren;
  /** Without a length it is removed. */
  keep: (length: number | undefined) => void;
}

function Span({ name, index, length, doubt, keep }: SpanParts) {
  const units = useUnits();
  const saved = lengthText(length, units);
  const isWrong = (text: string) => text.trim() !== "" && !((typedLength(text, units) ?? 0) > 0);
  const [text, setText] = useTyped(saved, isWrong);
  const [typed, wrong] = [typedLength(text, units), isWrong(text)];
  const reason = noLength(text, units) || (wrong ? "a distance is above zero" : "");
  const id = `distance-${index}`;
  const done = () => {
    if (text === saved || wrong) return;
    keep(typed);
    if (typed === undefined) setText(saved); // until its row goes
  };
  return (
    <li id={id} class={doubt ? "doubted" : ""}>
      <label class="row">
        <span>{name}</span>
        <input
          inputMode={units === "mm" ? "decimal" : "text"}
          autoComplete="off"
          enterKeyHint="next"
          aria-label={`Distance ${name}, ${units}`}
          aria-invalid={wrong}
          aria-describedby={reason ? `${id}-reason` : undefined}
          placeholder={units}
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
          onBlur={done}
          onKeyDown={(event) => {
            if (event.key !== "Enter") return;
            const after = event.currentTarget.closest("li")?.nextElementSibling;
            const next = after?.querySelector("input");
            if (next) next.focus();
            else event.currentTarget.blur();
          }}
        />
      </label>
      {reason && (
        <small id={`${id}-reason`} class="wrong">
          {reason}
        </small>
      )}
      {doubt}
    </li>
  );
}
