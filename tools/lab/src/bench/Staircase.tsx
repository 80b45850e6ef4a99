// How the error falls, effect by effect: three numbers a stair, and a warning where only the first fell.
import { namedLength, shownLength, type Unit } from "../controls/lengths";
import type { Stairs } from "./live";

export function Staircase({ stairs, units }: { stairs: Stairs; units: Unit }) {
  const highest = Math.max(...stairs.stairs.map((stair) => stair.fit_rms), 1e-9);
  const number = (mm: number | null) => (mm === null ? "–" : shownLength(mm, units, 2));
  return (
    <table class="stairs">
      <caption>How the error falls [{units}]</caption>
      <thead>
        <tr>
          <th scope="col">With</th>
          <td class="bars" />
          <th scope="col">fit</th>
          <th scope="col">noise</th>
          <th scope="col">checked</th>
        </tr>
      </thead>
      <tbody>
        {stairs.stairs.map((stair, i) => (
          <tr key={`${i} ${stair.noun}`} class={stair.only_fit ? "only-fit" : ""}>
            <th scope="row">
              {stair.noun}
              {stair.only_fit && <strong class="follows-noise">Only the fit got better.</strong>}
            </th>
            <td class="bars">
              <svg viewBox="0 0 100 12" preserveAspectRatio="none" aria-hidden="true">
                <rect
                  class={i === 0 ? "fall as-set" : "fall"}
                  width={(100 * stair.fit_rms) / highest}
                  height="12"
                />
                {stair.left_out_rms !== null && (
                  <line
                    class="at-left-out"
                    x1={Math.min(99, (100 * stair.left_out_rms) / highest)}
                    x2={Math.min(99, (100 * stair.left_out_rms) / highest)}
                    y2="12"
                  />
                )}
              </svg>
            </td>
            <td title={namedLength(stair.fit_rms, units, 3)}>{number(stair.fit_rms)}</td>
            <td>{number(stair.noise_rms)}</td>
            <td>{number(stair.left_out_rms)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
