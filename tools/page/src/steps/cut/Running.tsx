// How far a cut is that runs: marks, minutes, and what the machine last said.
import { shownLength } from "../../controls/lengths";
import { Table } from "../../controls/Table";
import { useUnits } from "../../controls/units";
import type { Machine } from "../../shell/machine";
import type { Grid } from "../Cut";
import { marksBefore, minutesAt } from "./times";

export function Running({ grid, machine }: { grid: Grid; machine: Machine }) {
  const units = useUnits();
  const { program, place, kind, unseen } = machine;
  const [lines, total] = [program?.done ?? 0, program?.total ?? 1];
  const left = Math.ceil(minutesAt(grid, total) - minutesAt(grid, lines));
  const pause = grid.pauses.find((each) => each.lines > lines);
  const facts = [
    ["File", grid.program],
    ["Line", `${lines} of ${total}`],
    ["Sled", place && `${place.map((mm) => shownLength(mm, units)).join(", ")} ${units}`],
    ["Next pause", pause && `after mark ${marksBefore(grid, pause.lines)}: ${pause.do}`],
    ["Last answer", `${unseen} s ago`],
  ];
  return (
    <>
      <p class="soft">
        <output class="large">{marksBefore(grid, lines)}</output> of {grid.marks.length} marks
        {/* A virtual machine is as fast as it was asked to be. */}
        {kind === "board" && left > 0 && `, ${left} min left`}
      </p>
      <Table class="wide change" rows={facts.filter(([, said]) => said)} />
    </>
  );
}
