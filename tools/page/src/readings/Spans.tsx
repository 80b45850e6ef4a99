// Distances between marks: those of the form in measuring order, then all others.
import { useEffect, useRef, useState } from "preact/hooks";
import { lengthText, noLength, typedLength } from "../controls/lengths";
import { useUnits } from "../controls/units";
import { beyond, lengthBetween, withInstead, withLength } from "./distances";
import { useDistances } from "./useDistances";
import type { Doubt } from "./useDoubts";
import type { Form } from "./useReadings";

interface SpansParts {
  form: Form;
  take: (form: Form) => void;
  doubts: Doubt[];
}

export function Spans({ form, take, doubts }: SpansParts) {
  const save = useDistances(form, take);
  const { file, spans, distances } = form;
  const doubted = new Set(doubts.filter((doubt) => !doubt.is_mark).map((doubt) => doubt.index));
  const others = beyond(distances, spans);
  if (spans.length + others.length === 0) return null;
  return (
    <ol class="spans" aria-label="Distances to measure">
      {[
        ...spans.map((span) => ({ span, measured: lengthBetween(distances, span), isAsked: true })),
        ...others.map((measured) => ({ span: measured.between, measured, isAsked: false })),
      ].map(({ span, measured, isAsked }, i) => {
        const index = measured ? distances.indexOf(measured) : -1;
        return (
          <Span
            key={`${file}/${i}`}
            name={span.join(" to ")}
            index={index}
            length={measured?.length}
            doubted={doubted.has(index)}
            keep={(length) =>
              void save((all) =>
                isAsked || !measured
                  ? withLength(all, span, length)
                  : withInstead(all, measured, ...(length ? [{ ...measured, length }] : [])),
              )
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
  doubted: boolean;
  keep: (length: number | undefined) => void;
}

function Span({ name, index, length, doubted, keep }: SpanParts) {
  const units = useUnits();
  const saved = length === undefined ? "" : lengthText(length, units);
  const [text, setText] = useState(saved);
  const typed = typedLength(text, units);
  const wrong = text.trim() !== "" && !(typed && typed > 0);
  // Text that is not a length stays in view until it is corrected; the previous number no longer counts.
  const stays = useRef(false);
  stays.current = wrong;
  useEffect(() => {
    if (!stays.current || saved !== "") setText(saved);
  }, [saved]);
  const reason = noLength(text, units) || (wrong ? "a distance is above zero" : "");
  const reasonId = `span-${name.replaceAll(" ", "-")}`;
  const done = () => {
    if (text === saved) return;
    const length = wrong || text.trim() === "" ? undefined : typed;
    if (length !== undefined || saved !== "") keep(length);
  };
  return (
    <li id={index < 0 ? undefined : `distance-${index}`} class={doubted ? "doubted" : ""}>
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
    </li>
  );
}
