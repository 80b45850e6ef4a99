// The result of the last cut, and what to do about it.
import { Do } from "../../shell/doing";
import { isReady, type Machine, useMachine } from "../../shell/machine";
import { useTell } from "../../shell/project";
import { isCut, outcomeOf, type Round, type RoundParts } from "./round";

/** isNext: the button of the screen reads the marks. */
export function Outcome({ round, isNext }: RoundParts) {
  const machine = useMachine();
  if (!round.ended || outcomeOf(round, machine) === "running") return null;
  const isDone = isCut(round, machine);
  return (
    <section class={isDone ? "box edge" : "box edge warned"} role="status">
      <p>{round.ended}</p>
      {isDone && !(isNext && !hasTape(round, machine)) && <ToReadings round={round} />}
    </section>
  );
}

/** Reads the marks that are cut: a virtual machine has its tape. */
export function Read({ round }: { round: Round }) {
  const tell = useTell();
  const machine = useMachine();
  if (!hasTape(round, machine)) return <ToReadings round={round} isNext />;
  const read = async () => {
    await tell("machine/readings", { form: round.form });
    if (round.origin !== "proof") location.hash = "#/readings";
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

/** To where they are typed; proof marks are read on their own screen. */
export function ToReadings({ round, isNext }: RoundParts) {
  if (round.origin === "proof") return null;
  return (
    <a class={isNext ? "button primary" : "button"} href="#/readings">
      {round.waits === 0 ? "Look at the readings" : "Type what your tape says"}
    </a>
  );
}
