// The result of the last cut, and what to do about it.
import { Do } from "../../shell/doing";
import { isConnected, isReady, type Machine, useMachine } from "../../shell/machine";
import { useTell } from "../../shell/project";
import type { Grid } from "../Cut";

interface OutcomeParts {
  grid: Grid;
  /** Whether the button of the screen reads the marks. */
  isRead: boolean;
}

export function Outcome({ grid, isRead }: OutcomeParts) {
  const machine = useMachine();
  const { program } = machine;
  const isThis = program?.title === grid.program;
  const outcome = isThis ? program.outcome : undefined;
  if (outcome === "running") return null;
  const ended = outcome && ENDED[outcome];
  const broke = outcome === "done" ? "" : broken(grid, machine);
  const isCut = outcome === "done" || grid.broke_off === grid.marks.length;
  if (!ended && !broke) return null;
  return (
    <section class={`outcome box edge ${outcome ?? "lost"}`} role="status">
      <p>
        {ended} {broke}
      </p>
      {isCut && !(isRead && !hasTape(grid, machine)) && <ToReadings waits={grid.waits} />}
    </section>
  );
}

const ENDED = {
  done: "All marks are cut.",
  stopped: "Stopped. The machine knows where it is.",
  refused: "The machine refused a line; read what it says below.",
  lost: "The line was lost. Nothing that you typed is lost. Connect it again in the bar below, and set its chains.",
};

/** How far the cut came, and what can be done. */
function broken(grid: Grid, machine: Machine): string {
  const { broke_off, broke_said, perhaps, goes_on, is_proposed } = grid;
  if (broke_off == null) return "";
  if (broke_off === grid.marks.length) return broke_said;
  const connect = isConnected(machine) ? "" : " Connect the machine.";
  const fresh = machine.kind === "virtual" || is_proposed ? "" : " on a fresh sheet";
  const next = perhaps > 0 ? ", or go on" : `, or go on from mark ${grid.marks[broke_off]?.name}`;
  return `${broke_said}${connect} Begin again${fresh}${goes_on ? next : ""}.`;
}

/** Reads the marks that are cut: a virtual machine has its tape. */
export function Read({ grid }: { grid: Grid }) {
  const tell = useTell();
  const machine = useMachine();
  if (!hasTape(grid, machine)) return <ToReadings waits={grid.waits} isNext />;
  const read = async () => {
    await tell("machine/readings", { form: grid.form });
    location.hash = "#/readings";
  };
  return (
    <Do isNext disabled={!isReady(machine)} work={read}>
      Let a tape read the {grid.waits} marks
    </Do>
  );
}

function hasTape(grid: Grid, { kind }: Machine): boolean {
  return kind === "virtual" && grid.waits > 0;
}

interface ToReadingsParts {
  /** Marks that are cut and not read. */
  waits: number;
  isNext?: boolean;
}

export function ToReadings({ waits, isNext }: ToReadingsParts) {
  return (
    <a class={isNext ? "button primary" : "button"} href="#/readings">
      {waits === 0 ? "Look at the readings" : "Type what your tape says"}
    </a>
  );
}
