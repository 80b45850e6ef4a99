// What came of the last cut, and what to do about it.
import { useState } from "preact/hooks";
import { type Project, send } from "../../api/client";
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
    lost: `The line was lost after ${share}. Nothing that you typed is lost. Connect the machine again, set its chains, then cut again.`,
  }[program.outcome];
  const isThis = program.title === grid.program;
  if (!words || (!isThis && grid.is_proposed)) return null;
  return (
    <section class={`outcome ${program.outcome}`} role="status">
      <p>{words}</p>
      {program.outcome === "done" && <Done grid={grid} waits={isThis ? grid.waits : 0} />}
      {program.outcome === "lost" && machine.phase === "lost" && (
        <a class="button" href="#/open">
          Connect the machine again
        </a>
      )}
    </section>
  );
}

interface DoneParts {
  grid: Grid;
  /** Marks that are cut and not read. */
  waits: number;
}

function Done({ grid, waits }: DoneParts) {
  const { take, setTrouble } = useProject();
  const machine = useMachine();
  const [busy, setBusy] = useState(false);
  if (waits === 0)
    return (
      <a class="button" href="#/readings">
        Look at the readings
      </a>
    );
  const read = () => {
    setBusy(true);
    send<Project>("POST", "machine/readings", { form: grid.form })
      .then(
        (project) => {
          take(project);
          setTrouble("");
          location.hash = "#/readings";
        },
        (error: Error) => setTrouble(error.message),
      )
      .finally(() => setBusy(false));
  };
  return (
    <>
      {machine.kind === "virtual" && (
        <button type="button" class="primary" disabled={busy || !isReady(machine)} onClick={read}>
          Let a tape read the {waits} marks
        </button>
      )}{" "}
      <a class="button" href="#/readings">
        Type what your tape says
      </a>
    </>
  );
}
