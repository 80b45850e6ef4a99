// The sheet while it is cut: marks that are done, marks to come, and where the sled is.
import { useMemo } from "preact/hooks";
import { Sheet } from "../../sheet/Sheet";
import { useScale } from "../../sheet/scale";
import type { Pair } from "../../sheet/view";
import { useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import { marksBefore, outcomeOf, type Round } from "./round";

const DEEP = -0.2; // [mm] the bit is in the wood
const SLED = 230; // [mm] its radius

interface CutMapParts {
  round: Round;
  /** Marks that were cut in other rounds. */
  earlier?: readonly Pair[];
}

export function CutMap({ round, earlier = [] }: CutMapParts) {
  const machine = useMachine();
  const { program, place, knows_place, kind, unseen } = machine;
  const outcome = outcomeOf(round, machine);
  const taken = (outcome && program?.done) ?? 0;
  const done = Math.max(marksBefore(round, taken), round.broke_off ?? 0);
  const marks = useMemo(
    () =>
      round.marks.map(({ name, target }, index) => ({
        name,
        target,
        look: index < done ? ("done" as const) : ("planned" as const),
      })),
    [round, done],
  );
  const faint = earlier.map((target) => ({ name: "", target, look: "faint" as const }));
  const next = outcome === "running" ? marks[done] : undefined;
  const sled = place && knows_place && kind !== "none" ? place : undefined;
  return (
    <>
      <p class="soft only-wide">Filled: cut. Open: to come.</p>
      <Sheet label={`${done} of ${round.marks.length} marks are cut`} marks={[...marks, ...faint]}>
        <Way places={marks.slice(0, done).map(({ target }) => target)} />
        {sled && next && <Way places={[[sled[0], sled[1]], next.target]} isNext />}
        {sled && <Sled place={sled} old={unseen > 0} next={next?.name} />}
      </Sheet>
    </>
  );
}

function Way({ places, isNext }: { places: readonly Pair[]; isNext?: boolean }) {
  const { at } = useScale();
  const d = places.map((place, i) => `${i ? "L" : "M"}${at(place).join(" ")}`).join("");
  return <path d={d} fill="none" stroke="var(--act)" stroke-dasharray={isNext ? 4 : undefined} />;
}

interface SledParts {
  place: readonly [number, number, number];
  /** It may be elsewhere by now. */
  old: boolean;
  /** The mark that it goes to. */
  next: string | undefined;
}

function Sled({ place: [x, y, z], old, next }: SledParts) {
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
      {next && (
        <text class="name" x={cx} y={cy + SLED * px + 16} text-anchor="middle" font-weight={600}>
          going to mark {next}
        </text>
      )}
    </g>
  );
}
