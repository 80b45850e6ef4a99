// What came of the last cut, and what to do about it.
import { type Project, send } from "../../api/client";
import { useDo } from "../../shell/doing";
import { isReady, useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Grid } from "../Cut";

export function Outcome({ grid }: { grid: Grid }) {
  const machine = useMachine();
  const { program } = machine;
  const isThis = program?.title === grid.program;
  const isRound = program && /^(grid|more)/.test(program.title) && (isThis || !grid.is_proposed);
  const outcome = isRound ? program.outcome : undefined;
  if (outcome === "running") return null;
  const ended = outcome && ENDED[outcome];
  const broke = brokenWords(grid, machine.kind !== "none" && machine.phase !== "lost");
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

/** How far the cut came, as the folder knows it: after a restart of the lab too. */
function brokenWords({ broke_off, goes_on, marks }: Grid, connected: boolean): string {
  if (broke_off == null) return "";
  const next = marks[broke_off];
  if (!next) return "All marks are cut; the sled was on its way back.";
  const begin = connected ? "Begin again" : "Connect the machine and begin again";
  const ways = goes_on ? `${begin}, or go on from mark ${next.name}.` : `${begin}.`;
  return `Cut ${broke_off} of ${marks.length} marks, then it broke off. ${ways}`;
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
