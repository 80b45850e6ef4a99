// An effect that can be added: its checkbox, and a slider for each of its sizes.
import type { Schemas } from "../api/client";
import { shownLength, useUnits } from "../controls/lengths";
import type { Choice, Effect, Fit } from "./live";

interface EffectCardParts {
  effect: Effect;
  choice: Choice;
  fit: Fit | undefined;
  /** The error that adding it would leave [mm]. */
  left: number | undefined;
  /** Shows a choice; `keep`: the slider was released. */
  change: (choice: Choice, keep: boolean) => void;
  /** Whether its pattern is shown over the marks. */
  isLaid: boolean;
  lay: (() => void) | undefined; // undefined: there is no mark
}

export function EffectCard({ effect, choice, fit, left, change, isLaid, lay }: EffectCardParts) {
  const units = useUnits();
  const added = choice.effects.includes(effect.name);
  const toggle = () => {
    const effects = added
      ? choice.effects.filter((name) => name !== effect.name)
      : [...choice.effects, effect.name];
    change({ effects, held: ofEffects(choice.held, effects) }, true);
  };
  const hold = (name: string, size: number | undefined, keep: boolean) => {
    const { [name]: _, ...others } = choice.held;
    change({ ...choice, held: size === undefined ? others : { ...others, [name]: size } }, keep);
  };
  return (
    <div class={`effect box row ${added ? "added" : ""}`}>
      <label class="tick">
        <input type="checkbox" checked={added} onChange={toggle} />
        <span>
          {effect.noun}
          {effect.in_settings && <small>in your settings</small>}
          {effect.where !== "firmware" && <small>no setting holds it</small>}
        </span>
      </label>
      {!added && left !== undefined && (
        <output>
          <span class="spoken">would leave</span>
          <span aria-hidden="true">→</span> {shownLength(left, units, 2)}
        </output>
      )}
      {lay && (
        <button
          type="button"
          aria-pressed={isLaid}
          aria-label={`Lay over the marks: ${effect.noun}`}
          onClick={lay}
        >
          Lay over
        </button>
      )}
      {added && (
        <div class="sizes">
          {effect.parameters.map((parameter) => (
            <SizeSlider
              key={parameter.name}
              parameter={parameter}
              held={choice.held[parameter.name]}
              size={fit?.sizes[parameter.name]}
              hold={(size, keep) => hold(parameter.name, size, keep)}
            />
          ))}
        </div>
      )}
    </div>
  );
}

/** The sizes of these effects. */
function ofEffects(held: Choice["held"], effects: string[]): Choice["held"] {
  const mine = ([name]: [string, number]) =>
    effects.some((effect) => name.startsWith(`${effect}.`));
  return Object.fromEntries(Object.entries(held).filter(mine));
}

const STEPS = 200;

interface SizeSliderParts {
  parameter: Schemas["BenchParameter"];
  held: number | undefined;
  size: Schemas["BenchSize"] | undefined;
  hold: (size: number | undefined, keep: boolean) => void;
}

/** The size of an effect: fitted until the slider is moved, then held. */
function SizeSlider({ parameter, held, size, hold }: SizeSliderParts) {
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
