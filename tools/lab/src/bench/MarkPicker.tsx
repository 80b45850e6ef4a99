// Chooses a mark by name, and says what is left of it: the way of the keyboard to what a click does.
import { namedLength, type Unit } from "../controls/lengths";
import type { Bench } from "./live";
import type { View } from "./views";

interface MarkPickerParts {
  bench: Bench;
  view: View | undefined;
  units: Unit;
  selected: number | undefined;
  select: (mark: number | undefined) => void;
}

export function MarkPicker({ bench, view, units, selected, select }: MarkPickerParts) {
  const error = selected === undefined ? undefined : view?.errors[selected];
  const [left, right] = (selected === undefined ? undefined : view?.chains[selected]) ?? [
    null,
    null,
  ];
  const shown = (mm: number | null) => (mm === null ? "–" : namedLength(mm, units, 2));
  return (
    <p class="mark-picker" aria-live="polite">
      <label for="bench-mark">Mark</label>{" "}
      <select
        id="bench-mark"
        value={selected ?? ""}
        onChange={({ currentTarget: { value } }) =>
          select(value === "" ? undefined : Number(value))
        }
      >
        <option value="">none</option>
        {bench.marks.map((mark, i) => (
          <option key={i} value={i}>
            {mark.name}
          </option>
        ))}
      </select>{" "}
      {error ? (
        <>
          off by {shown(Math.hypot(...error))}: left chain {shown(left)}, right chain {shown(right)}
        </>
      ) : (
        <>Choose a mark here or touch a dot: it lights up everywhere.</>
      )}
    </p>
  );
}
