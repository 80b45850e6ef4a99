// What the new numbers would do to the marks: as the file says, with what is accepted, with all of it.
import { useState } from "preact/hooks";
import type { Schemas } from "../../api/client";
import { endsOf, SpanLines } from "../../residuals/Spans";
import { Sheet } from "../../sheet/Sheet";

interface MapParts {
  made: Schemas["CorrectionParts"];
  /** What is compared: nothing while the numbers are fitted to another file. */
  states: readonly Schemas["State"][];
}

export function CorrectMap({ made, states }: MapParts) {
  const [chosen, show] = useState<string>();
  const known = new Set(made.marks.map(({ name }) => name));
  const marks = [...made.marks, ...endsOf(made.spans, known)];
  if (marks.length === 0) return null;
  const found = states.findIndex(({ title }) => title === chosen);
  // What is accepted is compared, or else all of it.
  const shown = found < 0 ? Math.min(1, states.length - 1) : found;
  const [first, state] = [states[0], states[shown]];
  return (
    <Sheet
      label={`Errors of ${made.marks.length} marks and ${made.spans.length} distances, ${state?.title ?? "being fitted"}`}
      marks={marks}
      states={states}
      shown={shown}
      show={(index) => show(states[index]?.title)}
      sigma={made.sigma ?? undefined}
      slides
    >
      {first && state && (
        <SpanLines
          {...{ spans: made.spans, state, scale: first, doubted: [], sigma: made.sigma ?? 0 }}
        />
      )}
    </Sheet>
  );
}
