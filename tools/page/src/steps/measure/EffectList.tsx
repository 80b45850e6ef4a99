// Each effect under the plan: it would be identified, would look like another, or would stay hidden.
import type { Layout } from "./plan";

type Effect = Layout.Plan["preview"]["outlines"][number];

export function EffectList({ plan }: { plan: Layout.Plan }) {
  return (
    <details>
      <summary>Each cause by itself</summary>
      <ul class="tiles plain" aria-label="What these marks could tell">
        {plan.preview.outlines.map((effect, _, all) => {
          const [sign, words] = told(effect, all);
          return (
            <li key={effect.effect} class="box">
              <b>
                <span aria-hidden="true">{sign}</span> {effect.noun}
              </b>
              <small>{words}</small>
            </li>
          );
        })}
      </ul>
    </details>
  );
}

/** A sign and words: whether an effect is named, only shows, or stays hidden. */
function told(effect: Effect, all: readonly Effect[]): [sign: string, words: string] {
  if (!effect.is_seen) return ["○", "would stay hidden in its usual size"];
  if (effect.is_distinct) return ["●", "would be found and named"];
  const nouns = effect.alike.map((name) => all.find((each) => each.effect === name)?.noun);
  const others = nouns.slice(0, 2).filter(Boolean).join(", ");
  const more = nouns.length > 2 ? ` and ${nouns.length - 2} more` : "";
  return [
    "◐",
    others
      ? `would show, but may be taken for ${others}${more}`
      : "would show, but is not always told apart",
  ];
}
