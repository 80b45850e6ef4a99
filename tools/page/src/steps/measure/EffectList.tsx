// Each effect under the plan: it would be identified, would look like another, or would stay hidden.
import type { Layout } from "./plan";

type Effect = Layout.Plan["preview"]["outlines"][number];

export function EffectList({ plan }: { plan: Layout.Plan }) {
  return (
    <details>
      <summary>Each cause by itself</summary>
      <ul class="tiles plain" aria-label="What these marks could tell">
        {plan.preview.outlines.map((effect, _, all) => (
          <li key={effect.effect} class={`box ${tone(effect)}`}>
            <b>
              <span aria-hidden="true">{SIGN[tone(effect)]}</span> {effect.noun}
            </b>
            <small>{words(effect, all)}</small>
          </li>
        ))}
      </ul>
    </details>
  );
}

type Tone = "named" | "alike" | "hidden";
const SIGN: Record<Tone, string> = { named: "●", alike: "◐", hidden: "○" };

function tone(effect: Effect): Tone {
  if (!effect.is_seen) return "hidden";
  return effect.is_distinct ? "named" : "alike";
}

function words(effect: Effect, all: readonly Effect[]): string {
  if (!effect.is_seen) return "would stay hidden in its usual size";
  if (effect.is_distinct) return "would be found and named";
  const [first, second] = effect.alike.map((name) => all.find((e) => e.effect === name)?.noun);
  const more = effect.alike.length - 2;
  const others = [first, second].filter(Boolean).join(", ");
  return others
    ? `would show, but may be taken for ${others}${more > 0 ? ` and ${more} more` : ""}`
    : "would show, but is not always told apart";
}
