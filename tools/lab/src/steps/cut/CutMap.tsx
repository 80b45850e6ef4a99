// The sheet while it is cut: marks that are done, marks to come, and where the sled is.
import { MarkDot } from "../../sheet/MarkDot";
import { SheetMap, usePixel } from "../../sheet/SheetMap";
import { useMachine } from "../../shell/machine";
import type { Grid } from "../Cut";

const DEEP = -0.2; // [mm] the bit is in the wood

interface MapParts {
  sheet: readonly [number, number];
  grid: Grid;
}

export function CutMap({ sheet, grid }: MapParts) {
  const { program, place, knows_place, kind, unseen } = useMachine();
  const taken = program?.title === grid.program ? program.done : 0;
  const isCut = grid.marks.map(
    (mark, index) => taken >= mark.lines || index < (grid.broke_off ?? 0),
  );
  const done = isCut.filter(Boolean).length;
  return (
    <figure class="cut-map">
      <SheetMap sheet={sheet} label={`${done} of ${grid.marks.length} marks are cut`}>
        {grid.marks.map((mark, index) => (
          <MarkDot key={mark.name} place={mark.place} name={mark.name} hollow={!isCut[index]} />
        ))}
        {place && knows_place && kind !== "none" && <Sled place={place} old={unseen > 0} />}
      </SheetMap>
    </figure>
  );
}

interface SledParts {
  place: readonly [number, number, number];
  /** It may be elsewhere by now. */
  old: boolean;
}

function Sled({ place: [x, y, z], old }: SledParts) {
  const pixel = usePixel();
  return (
    <g
      fill="none"
      stroke={old ? "var(--soft)" : "var(--before)"}
      stroke-width={2 * pixel}
      stroke-dasharray={old ? 4 * pixel : undefined}
    >
      <circle cx={x} cy={-y} r={16 * pixel} />
      <circle cx={x} cy={-y} r={3 * pixel} fill={z < DEEP ? "var(--before)" : "none"} />
    </g>
  );
}
