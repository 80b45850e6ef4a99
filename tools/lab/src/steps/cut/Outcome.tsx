// What came of the last cut, and what to do about it.
import { type Project, send } from "../../api/client";
import { useDo } from "../../shell/doing";
import { isReady, useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Grid } from "../Cut";

export function Outcome({ grid }: { grid: Grid }) {
  const machine = useMachine();
  const { program } = machine;
  if (!program || !/^(grid|more)/.test(program.title)) return null;
  const share = `${program.done} of ${program.total} lines`;
  const words = {
    running: "",
    done: "All marks are cut.",
    stopped: `Stopped after ${share}. The machine knows where it is. Cutting again begins at the first mark.`,
    refused: `The machine refused a line after ${share}. Read what it says below, then cut again.`,
    lost: `The line was lost after ${share}. Nothing that you typed is lost. Connect the machine again in the bar below, set its chains, then cut again.`,
  }[program.outcome];
  const isThis = program.title === grid.program;
  if (!words || (!isThis && grid.is_proposed)) return null;
  return (
    <section class={`outcome ${program.outcome}`} role="status">
      <p>{words}</p>
      {program.outcome === "done" && <Done grid={grid} waits={isThis ? grid.waits : 0} />}
    </section>
  );
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
