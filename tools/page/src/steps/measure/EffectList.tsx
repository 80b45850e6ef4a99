// Each effect under the plan: it would be identified, would look like another, or would stay hidden.
import type { Schemas } from "../../api/client";

export function EffectList({ causes }: { causes: Schemas["PlannedCause"][] }) {
  return (
    <details>
      <summary>Each cause by itself</summary>
      <ul class="tiles plain" aria-label="What these marks could tell">
        {causes.map(({ noun, said: [sign, words] }) => (
          <li key={noun} class="box">
            <b>
              <span aria-hidden="true">{sign}</span> {noun}
            </b>
            <small>{words}</small>
          </li>
        ))}
      </ul>
    </details>
  );
}
