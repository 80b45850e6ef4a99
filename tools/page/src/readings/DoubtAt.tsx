// A reading that disagrees, beside its fields: its likely cause and, if it has a cause, a button that takes the correction.
import { lengthText, useUnits } from "../controls/lengths";
import { useSaveDistance } from "./saves";
import type { Doubt } from "./useDoubts";
import type { Form, TypedForm } from "./useReadings";

interface DoubtParts {
  doubt: Doubt | undefined;
  form: Form;
  readings: TypedForm;
}

export function DoubtAt({ doubt, form, readings }: DoubtParts) {
  const units = useUnits();
  const save = useSaveDistance(form, readings.take);
  if (!doubt) return null;
  const { is_mark, index, sentence, corrected } = doubt;
  const distance = form.distances[index];
  const correct = ([first = 0, second = 0]: number[]) => {
    if (is_mark) readings.kept.put((typed) => ({ ...typed, [index]: [first, second] }));
    else if (distance) void save(distance, first);
  };
  const look = () => {
    if (is_mark) readings.pick(index);
    else document.querySelector<HTMLElement>(`#distance-${index} input`)?.focus();
  };
  return (
    <p class="doubt row trouble" role="status">
      <span>
        <b>
          {is_mark
            ? `Mark ${form.marks[index]?.name ?? ""}`
            : `Distance ${distance?.between.join(" to ") ?? ""}`}
        </b>
        : {sentence}
      </span>
      {corrected && (
        <button type="button" onClick={() => correct(corrected)}>
          Take {corrected.map((mm) => lengthText(mm, units)).join(", ")}
        </button>
      )}
      <button type="button" onClick={look}>
        Look at it
      </button>
    </p>
  );
}
