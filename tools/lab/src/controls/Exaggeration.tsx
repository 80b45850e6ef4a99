// How much longer than life arrows are drawn: x1 to x200, in steps that look alike.
import { useId } from "preact/hooks";
import "./exaggeration.css";

const STEPS = [1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200];

interface ExaggerationParts {
  value: number;
  change: (value: number) => void;
}

export function Exaggeration({ value, change }: ExaggerationParts) {
  const id = useId();
  const index = STEPS.findIndex((step) => step >= value);
  return (
    <p class="exaggeration">
      <label for={id}>Arrows longer than life</label>
      <input
        id={id}
        type="range"
        min={0}
        max={STEPS.length - 1}
        value={index < 0 ? STEPS.length - 1 : index}
        aria-valuetext={`${value} times`}
        onInput={(event) => change(STEPS[Number(event.currentTarget.value)] ?? 1)}
      />
      <output for={id}>× {value}</output>
    </p>
  );
}
