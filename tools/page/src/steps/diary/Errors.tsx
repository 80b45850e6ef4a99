// The error of each fit: before it, after it, and on marks that were not part of it.
import type { Schemas } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { namedLength, useUnits } from "../../controls/lengths";
import { Table } from "../../controls/Table";

export function Errors({ fits }: { fits: Schemas["DiaryFit"][] }) {
  const units = useUnits();
  const most = Math.max(...fits.map((fit) => fit.before_mm ?? 0), 0.1);
  const shown = (mm: number | null) => (mm === null ? "–" : namedLength(mm, units, 2));
  return (
    <Table
      class="rounds"
      names={["fit", "error before and after", "marks left out"]}
      rows={fits.map((fit) => [
        <>
          {new Date(fit.at).toLocaleDateString(undefined, { dateStyle: "medium" })}
          <br />
          {fit.machine}, {fit.readings} readings
          <br />
          {fit.said}
        </>,
        <div key={fit.at} class="bars">
          <Bar share={(fit.before_mm ?? 0) / most} colour="var(--before)" />
          {shown(fit.before_mm)}
          <Bar share={(fit.rms_mm ?? 0) / most} colour="var(--after)" />
          {shown(fit.rms_mm)}
        </div>,
        shown(fit.left_out_mm),
      ])}
    />
  );
}
