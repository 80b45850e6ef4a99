// What came of the last cut, and what to do about it.
import { type Project, send } from "../../api/client";
import { useDo } from "../../shell/doing";
import { isReady, type Machine, useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Grid } from "../Cut";
import { brokenWords } from "./GoOn";

export function Outcome({ grid }: { grid: Grid }) {
  const machine = useMachine();
  const { program } = machine;
  const isThis = program?.title === grid.program;
  const isRound = program && /^(grid|more)/.test(program.title) && (isThis || !grid.is_proposed);
  const outcome = isRound ? program.outcome : undefined;
  if (outcome === "running") return null;
  const ended = outcome && ENDED[outcome];
  const broke = broken(grid, machine);
  const isCut = outcome === "done" || grid.broke_off === grid.marks.length;
  if (!ended && !broke) return null;
  return (
    <section class={`outcome ${outcome ?? "lost"}`} role="status">
      <p>
        {ended} {broke}
      </p>
      {isCut && <Done grid={grid} waits={isThis || broke ? grid.waits : 0} />}
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
function broken(grid: Grid, { kind, phase }: Machine): string {
  const { broke_off, perhaps, goes_on, is_proposed } = grid;
  if (broke_off == null) return "";
  const names = grid.marks.map(({ name }) => name);
  const words = brokenWords(broke_off, perhaps, names);
  if (broke_off === names.length) return words;
  const connect = kind !== "none" && phase !== "lost" ? "" : " Connect the machine.";
  const fresh = kind === "virtual" || is_proposed ? "" : " on a fresh sheet";
  const next = perhaps > 0 ? ", or go on" : `, or go on from mark ${names[broke_off]}`;
  return `${words}${connect} Begin again${fresh}${goes_on ? next : ""}.`;
}

interface DoneParts {
  grid: Grid;
  /** Marks that are cut and not read. */
  waits: number;
}

function Done({ grid, waits }: DoneParts) {
  const { take } = useProject();
  const machine = useMachine();
  const [busy, run, refusal] = useDo();
  if (waits === 0)
    return (
      <a class="button" href="#/readings">
        Look at the readings
      </a>
    );
  const read = () =>
    run(async () => {
      take(await send<Project>("POST", "machine/readings", { form: grid.form }));
      location.hash = "#/readings";
    });
  return (
    <>
      {machine.kind === "virtual" && (
        <button
          type="button"
          class="primary"
          disabled={busy || !isReady(machine)}
          onClick={() => void read()}
        >
          Let a tape read the {waits} marks
        </button>
      )}{" "}
      <a class="button" href="#/readings">
        Type what your tape says
      </a>
      {refusal}
    </>
  );
}
