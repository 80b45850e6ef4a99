// How large effects could still be that are no suspects.
import { namedLength, type Unit } from "../../controls/lengths";
import type { VerdictParts } from "./words";

export function CouldHide({ verdict, units }: { verdict: VerdictParts; units: Unit }) {
  if (verdict.could_hide.length === 0 && !verdict.blind) return null;
  return (
    <section class="hidden-effects">
      <h2>What could still hide</h2>
      <p>
        An effect may act although your marks do not show it: it may move them by this much, RMS. A
        fitted frame takes up the share on the right, so that no mark shows it.
      </p>
      <table>
        <thead>
          <tr>
            <th scope="col">effect</th>
            <th scope="col">up to</th>
            <th scope="col">hidden in the frame</th>
          </tr>
        </thead>
        <tbody>
          {verdict.could_hide.map((hidden) => (
            <tr key={hidden.noun}>
              <th scope="row">{hidden.noun}</th>
              <td>{namedLength(hidden.mm, units)}</td>
              <td>{hidden.share === null ? "–" : `${Math.round(100 * hidden.share)} %`}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {verdict.blind && <p>{verdict.blind.charAt(0).toUpperCase() + verdict.blind.slice(1)}.</p>}
    </section>
  );
}
