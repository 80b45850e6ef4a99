// Distances between marks: those of the form in measuring order, then all others.
import type { ComponentChildren } from "preact";
import { lengthText, noLength, typedLength, useUnits } from "../controls/lengths";
import { useTyped } from "../controls/useTyped";
import { DoubtAt } from "./DoubtAt";
import { beyond, lengthBetween, withInstead, withLength } from "./distances";
import { useSave } from "./saves";
import type { Doubt } from "./useDoubts";
import type { Form, TypedForm } from "./useReadings";

interface SpansParts {
  form: Form;
  readings: TypedForm;
  doubts: readonly Doubt[];
}

export function Spans({ form, readings, doubts }: SpansParts) {
  const save = useSave(form, readings.take);
  const { file, spans, distances } = form;
  const others = beyond(distances, spans);
  if (spans.length + others.length === 0) return null;
  return (
    <ol class="spans" aria-label="Distances to measure">
      {[
        ...spans.map((span) => ({ span, measured: lengthBetween(distances, span), isAsked: true })),
        ...others.map((measured) => ({ span: measured.between, measured, isAsked: false })),
      ].map(({ span, measured, isAsked }, i) => {
        const index = measured ? distances.indexOf(measured) : -1;
        const doubt = doubts.find((each) => !each.is_mark && each.index === index);
        return (
          <Span
            key={`${file}/${i}`}
            name={span.join(" to ")}
            index={index}
            length={measured?.length}
            doubt={doubt && <DoubtAt {...{ doubt, form, readings }} />}
            keep={(length) =>
              void save("distances", ({ distances: all }) => ({
                distances:
                  isAsked || !measured
                    ? withLength(all, span, length)
                    : withInstead(all, measured, ...(length ? [{ ...measured, length }] : [])),
              }))
            }
          />
        );
      })}
    </ol>
  );
}

interface SpanParts {
  name: string;
  /** Its index among the form's distances; -1 if it is not measured. */
  index: number;
  length: number | undefined;
  doubt: ComponentChildren;
  keep: (length: number | undefined) => void;
}

function Span({ name, index, length, doubt, keep }: SpanParts) {
  const units = useUnits();
  const saved = length === undefined ? "" : lengthText(length, units);
  const isWrong = (text: string) => text.trim() !== "" && !((typedLength(text, units) ?? 0) > 0);
  const [text, setText] = useTyped(saved, isWrong);
  const [typed, wrong] = [typedLength(text, units), isWrong(text)];
  const reason = noLength(text, units) || (wrong ? "a distance is above zero" : "");
  const reasonId = `span-${name.replaceAll(" ", "-")}`;
  const done = () => {
    if (text === saved) return;
    const length = wrong || text.trim() === "" ? undefined : typed;
    if (length !== undefined || saved !== "") keep(length);
  };
  return (
    <li id={index < 0 ? undefined : `distance-${index}`} class={doubt ? "doubted" : ""}>
      <label class="row">
        <span>{name}</span>
        <input
          inputMode={units === "mm" ? "decimal" : "text"}
          autoComplete="off"
          enterKeyHint="next"
          aria-label={`Distance ${name}, ${units}`}
          aria-invalid={wrong}
          aria-describedby={reason ? reasonId : undefined}
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
        <small id={reasonId} class="wrong">
          {reason}
        </small>
      )}
      {doubt}
    </li>
  );
}
