// The sheet while it is cut: marks that are done, marks to come, and where the sled is.
import { useMemo } from "preact/hooks";
import { Sheet } from "../../sheet/Sheet";
import { useScale } from "../../sheet/scale";
import { useMachine } from "../../shell/machine";
import type { Grid } from "../Cut";

const DEEP = -0.2; // [mm] the bit is in the wood

export function CutMap({ grid }: { grid: Grid }) {
  const { program, place, knows_place, kind, unseen } = useMachine();
  const taken = program?.title === grid.program ? program.done : 0;
  const isCut = (lines: number, index: number) => taken >= lines || index < (grid.broke_off ?? 0);
  const done = grid.marks.filter((mark, index) => isCut(mark.lines, index)).length;
  const marks = useMemo(
    () =>
      grid.marks.map((mark, index) => ({
        name: mark.name,
        target: mark.place,
        look: isCut(mark.lines, index) ? ("done" as const) : ("planned" as const),
      })),
    [grid, done],
  );
  return (
    <Sheet label={`${done} of ${grid.marks.length} marks are cut`} marks={marks}>
      {place && knows_place && kind !== "none" && <Sled place={place} old={unseen > 0} />}
    </Sheet>
  );
}

interface SledParts {
  place: readonly [number, number, number];
  /** It may be elsewhere by now. */
  old: boolean;
}

function Sled({ place: [x, y, z], old }: SledParts) {
  const [cx, cy] = useScale().at([x, y]);
  return (
    <g
      fill="none"
      stroke={old ? "var(--soft)" : "var(--before)"}
      stroke-width={2}
      stroke-dasharray={old ? 4 : undefined}
    >
      <circle cx={cx} cy={cy} r={16} />
      <circle cx={cx} cy={cy} r={3} fill={z < DEEP ? "var(--before)" : "none"} />
    </g>
  );
}
