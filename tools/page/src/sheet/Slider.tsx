// Two states on one sheet: the first on the left of a line, the other on its right. A slider moves the line.
import type { Mark, State } from "./marks";
import { useScale } from "./scale";

/** The errors of two states, each on its side of a line [mm, machine frame]. */
export function halves(marks: readonly Mark[], x: number, [left, right]: [State, State]): State {
  const errors = marks.map(({ target }, i) => (target[0] < x ? left : right).errors[i] ?? null);
  return { ...right, errors };
}

export function Divide({ x }: { x: number }) {
  const { at, plot } = useScale();
  return (
    <path
      class="divide"
      stroke="var(--act)"
      stroke-width={2}
      d={`M${at([x, 0])[0]} ${plot.top}V${plot.bottom}`}
    />
  );
}

interface SliderParts {
  x: number;
  wide: number; // [mm] of the sheet
  move: (x: number) => void;
  left: string;
  right: string;
}

export function Slider({ x, wide, move, left, right }: SliderParts) {
  return (
    <label class="slide tick">
      <span>{left}</span>
      <input
        type="range"
        min={-wide / 2}
        max={wide / 2}
        value={x}
        aria-label={`${left} on the left, ${right} on the right`}
        onInput={(event) => move(Number(event.currentTarget.value))}
      />
      <span>{right}</span>
    </label>
  );
}
