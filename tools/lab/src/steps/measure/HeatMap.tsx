// Cause against cause: how clearly the row stands out once the column is allowed too.
import type { Layout } from "./plan";

export function HeatMap({ plan }: { plan: Layout.Plan }) {
  return (
    <details class="heat">
      <summary>Each cause against each other</summary>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: a wide table is scrolled by keys too */}
      <section class="scroll" tabIndex={0} aria-label="Each cause against each other">
        <table>
          <thead>
            <tr>
              <th scope="col">sigmas of</th>
              {plan.effects.map((effect, index) => (
                <th key={effect.name} scope="col" title={effect.noun}>
                  <abbr title={effect.noun}>{index + 1}</abbr>
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {plan.effects.map((effect, row) => (
              <tr key={effect.name}>
                <th scope="row">
                  {row + 1} {effect.noun}
                </th>
                {effect.sigmas.map((sigmas, column) => (
                  <td
                    key={plan.effects[column]?.name}
                    class={sigmas >= plan.apart ? "apart" : sigmas >= 1 ? "near" : "same"}
                  >
                    {sigmas < 9.95 ? sigmas.toFixed(1) : Math.round(Math.min(sigmas, 99))}
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
      </section>
      <p>
        Green and bold: {plan.apart} sigmas or more, so the two are told apart in most cases. On the
        diagonal: against the settings alone.
      </p>
    </details>
  );
}
