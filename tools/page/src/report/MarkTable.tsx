// Each mark with its error, for the printed report, where you cannot point at a mark.
import { shownLength, useUnits, withMinus } from "../controls/lengths";
import { Table } from "../controls/Table";
import type { VerdictParts } from "../steps/verdict/words";

export function MarkTable({ verdict }: { verdict: VerdictParts }) {
  const units = useUnits();
  const left = verdict.states.at(-1);
  const pair = (both: readonly (number | null)[] | null | undefined, digits: number) =>
    withMinus(
      both?.map((each) => (each === null ? "–" : shownLength(each, units, digits))).join(", ") ??
        "–",
    );
  return (
    <section>
      <h2>The readings [{units}]</h2>
      <p>
        From the middle of the sheet, x right, y up. Off by: read − where the settings put it. Left:
        what {left?.title} leaves, on the sheet and as left and right chain.
      </p>
      <Table
        class="readings-read"
        names={["mark", "target", "read", "off by", "left", "chains"]}
        tone={(row) => (verdict.doubted.includes(row) ? "doubted" : "")}
        rows={verdict.marks.map((mark, i) => [
          `${mark.name} ${verdict.doubted.includes(i) ? "(read it again)" : ""}`,
          pair(mark.target, 1),
          pair(mark.measured, 1),
          pair(mark.error, 2),
          pair(left?.errors[i], 2),
          pair(left?.chains[i], 2),
        ])}
      />
    </section>
  );
}
