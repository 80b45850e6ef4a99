// The result of the last cut, and what to do about it.
import { Do } from "../../shell/doing";
import { isConnected, isReady, type Machine, useMachine } from "../../shell/machine";
import { useTell } from "../../shell/project";
import { isCut, outcomeOf, type Round } from "./round";

interface OutcomeParts {
  round: Round;
  /** Whether the button of the screen reads the marks. */
  isRead: boolean;
}

export function Outcome({ round, isRead }: OutcomeParts) {
  const machine = useMachine();
  const outcome = outcomeOf(round, machine);
  if (outcome === "running") return null;
  const ended = outcome && ENDED[outcome];
  const broke = outcome === "done" ? "" : broken(round, machine);
  if (!ended && !broke) return null;
  return (
    <section class={`outcome box edge ${outcome ?? "lost"}`} role="status">
      <p>
        {ended} {broke}
      </p>
      {isCut(round, machine) && !(isRead && !hasTape(round, machine)) && (
        <ToReadings round={round} />
      )}
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
function broken(round: Round, machine: Machine): string {
  const { broke_off, broke_said, perhaps, goes_on, origin } = round;
  if (broke_off == null) return "";
  if (broke_off === round.marks.length) return broke_said;
  const connect = isConnected(machine) ? "" : " Connect the machine.";
  const fresh = machine.kind === "virtual" || origin !== "chosen" ? "" : " on a fresh sheet";
  const next = perhaps > 0 ? ", or go on" : `, or go on from mark ${round.marks[broke_off]?.name}`;
  return `${broke_said}${connect} Begin again${fresh}${goes_on ? next : ""}.`;
}

/** Reads the marks that are cut: a virtual machine has its tape. */
export function Read({ round }: { round: Round }) {
  const tell = useTell();
  const machine = useMachine();
  if (!hasTape(round, machine)) return <ToReadings round={round} isNext />;
  const read = async () => {
    await tell("machine/readings", { form: round.form });
    if (round.origin !== "check") location.hash = "#/readings";
  };
  return (
    <Do isNext disabled={!isReady(machine)} work={read}>
      Let a tape read the {round.waits} marks
    </Do>
  );
}

function hasTape(round: Round, { kind }: Machine): boolean {
  return kind === "virtual" && round.waits > 0;
}

interface ToReadingsParts {
  round: Round;
  isNext?: boolean;
}

/** To where they are typed; check marks are read on their own screen. */
export function ToReadings({ round, isNext }: ToReadingsParts) {
  if (round.origin === "check") return null;
  return (
    <a class={isNext ? "button primary" : "button"} href="#/readings">
      {round.waits === 0 ? "Look at the readings" : "Type what your tape says"}
    </a>
  );
}
