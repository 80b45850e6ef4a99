// The sheet while it is cut: marks that are done, marks to come, and where the sled is.
import { useMemo } from "preact/hooks";
import { Sheet } from "../../sheet/Sheet";
import { useScale } from "../../sheet/scale";
import { useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Grid } from "../Cut";

const DEEP = -0.2; // [mm] the bit is in the wood
const SLED = 230; // [mm] its radius

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
  const { frame } = useProject().project.machine ?? {};
  const { at, px } = useScale();
  const [cx, cy] = at([x, y]);
  const chains = [-0.5, 0.5].map((side) => {
    const motor = at([side * (frame?.motor_gap ?? 0), frame?.motor_height ?? 0]);
    return `M${motor.join(" ")}L${cx} ${cy}`;
  });
  return (
    <g
      fill="var(--paper)"
      fill-opacity={0.6}
      stroke={old ? "var(--soft)" : "var(--ink)"}
      stroke-dasharray={old ? 4 : undefined}
    >
      <path d={chains.join("")} />
      <circle cx={cx} cy={cy} r={SLED * px} />
      <circle cx={cx} cy={cy} r={4} fill={z < DEEP ? "var(--ink)" : undefined} />
    </g>
  );
}
