// The size of an effect: fitted until the slider is moved, then held.
import type { Schemas } from "../api/client";

const STEPS = 200;

interface SizeSliderParts {
  parameter: Schemas["BenchParameter"];
  held: number | undefined;
  size: Schemas["BenchSize"] | undefined;
  hold: (size: number | undefined, keep: boolean) => void;
}

export function SizeSlider({ parameter, held, size, hold }: SizeSliderParts) {
  const { low, high, label, name } = parameter;
  const value = held ?? size?.value ?? 0;
  const said = size?.said ?? "";
  const slid = (event: Event, keep: boolean) =>
    hold(Number((event.currentTarget as HTMLInputElement).value), keep);
  return (
    <div class="held row">
      <label class="soft" for={name}>
        {label}
      </label>
      {held === undefined ? (
        <span class="soft">fitted</span>
      ) : (
        <button type="button" onClick={() => hold(undefined, true)} aria-label={`Fit: ${label}`}>
          Held: fit it
        </button>
      )}
      <input
        id={name}
        type="range"
        min={low}
        max={high}
        step={(high - low) / STEPS}
        value={value}
        aria-valuetext={said}
        onInput={(event) => slid(event, false)}
        onChange={(event) => slid(event, true)}
      />
      <p>
        {said}
        {size && !size.possible && <strong class="wrong"> No real machine has this.</strong>}
      </p>
    </div>
  );
}
