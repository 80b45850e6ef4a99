// Causes that may act although the marks do not show it, in the words of `plumb diagnose`.
import { namedLength, useUnits } from "../../controls/lengths";
import { Table } from "../../controls/Table";
import { capital } from "../../controls/words";
import type { VerdictParts } from "./words";

export function UnseenCauses({ verdict }: { verdict: VerdictParts }) {
  const units = useUnits();
  const { causes, silent, title, words, header } = verdict.unseen;
  if (causes.length === 0 && !silent) return null;
  return (
    <section class="hidden-effects">
      <h2>{title}</h2>
      {causes.length > 0 && (
        <>
          <p>{words}</p>
          <Table
            names={header}
            rows={causes.map((cause) => [cause.noun, namedLength(cause.mm, units), cause.taken_up])}
          />
        </>
      )}
      {silent && <p>{capital(silent)}.</p>}
    </section>
  );
}
