// Readings that disagree, each with its likely cause and, if it has a cause, a button that takes the correction.
import { lengthText, type Unit } from "../controls/lengths";
import { withInstead } from "./distances";
import { useDistances } from "./useDistances";
import type { Doubt } from "./useDoubts";
import type { Form, TypedForm } from "./useReadings";

interface DoubtsParts {
  form: Form;
  doubts: Doubt[];
  readings: TypedForm;
  units: Unit;
}

export function Doubts({ form, doubts, readings, units }: DoubtsParts) {
  const saveDistances = useDistances(form, readings.take);
  if (doubts.length === 0) return null;
  const correct = ({ is_mark, index }: Doubt, [first = 0, second = 0]: number[]) => {
    const doubted = form.distances[index];
    if (is_mark) readings.kept.put((typed) => ({ ...typed, [index]: [first, second] }));
    else if (doubted)
      void saveDistances((all) => withInstead(all, doubted, { ...doubted, length: first }));
  };
  return (
    <ul class="doubts plain" aria-live="polite" aria-label="Readings that disagree">
      {doubts.map((doubt) => {
        const { corrected } = doubt;
        return (
          <li class="row trouble" key={`${doubt.is_mark}${doubt.index}`}>
            <span>
              <b>{nameOf(doubt, form)}</b>: {doubt.sentence}
            </span>
            {corrected && (
              <button type="button" onClick={() => correct(doubt, corrected)}>
                Take {corrected.map((mm) => lengthText(mm, units)).join(", ")}
              </button>
            )}
            <button type="button" onClick={() => lookAt(doubt, readings)}>
              Look at it
            </button>
          </li>
        );
      })}
    </ul>
  );
}

/** Brings the reading into view, ready to be changed. */
function lookAt({ is_mark, index }: Doubt, { pick }: TypedForm): void {
  if (is_mark) pick(index);
  else document.querySelector<HTMLElement>(`#distance-${index} input`)?.focus();
}

function nameOf(doubt: Doubt, form: Form): string {
  if (doubt.is_mark) return `Mark ${form.marks[doubt.index]?.name ?? ""}`;
  return `Distance ${form.distances[doubt.index]?.between.join(" to ") ?? ""}`;
}
