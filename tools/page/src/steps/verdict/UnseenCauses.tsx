// Causes that may act although the marks do not show it, in the words of `plumb diagnose`.
import { Head } from "../../controls/Head";
import { namedLength, type Unit } from "../../controls/lengths";
import { capital } from "../../controls/words";
import type { VerdictParts } from "./words";

export function UnseenCauses({ verdict, units }: { verdict: VerdictParts; units: Unit }) {
  const { causes, silent, title, words, header } = verdict.unseen;
  if (causes.length === 0 && !silent) return null;
  return (
    <section class="hidden-effects">
      <h2>{title}</h2>
      {causes.length > 0 && (
        <>
          <p>{words}</p>
          <table>
            <Head names={header} />
            <tbody>
              {causes.map((cause) => (
                <tr key={cause.noun}>
                  <th scope="row">{cause.noun}</th>
                  <td>{namedLength(cause.mm, units)}</td>
                  <td>{cause.taken_up}</td>
                </tr>
              ))}
            </tbody>
          </table>
        </>
      )}
      {silent && <p>{capital(silent)}.</p>}
    </section>
  );
}
