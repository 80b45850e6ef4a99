// What the connected machine and the open file say otherwise, and the question which of the two holds: nothing is cut
// before it is answered.

import { type Project, send } from "../api/client";
import { setting } from "../controls/settings";
import { useDo } from "./doing";
import { isReady, type Machine, subject, useMachine } from "./machine";
import { useProject } from "./project";
import { type HeldAnswer, useHeld } from "./useHeld";

const SHOWN = 6;

export function Held() {
  const machine = useMachine();
  const held = useHeld();
  if (!held || held.numbers.length === 0) return null;
  if (held.is_fit)
    return (
      <p class="box trouble" role="status">
        {subject(machine)} does not hold the numbers of {held.file} yet.{" "}
        <a href="#/correct">Send them to it</a> before you cut.
      </p>
    );
  return <Question held={held} machine={machine} />;
}

function Question({ held, machine }: { held: HeldAnswer; machine: Machine }) {
  const { take, reload } = useProject();
  const [busy, run, refusal] = useDo();
  const { file, numbers } = held;
  const takeIn = async () => take(await send<Project>("POST", "machine/settings"));
  const write = async () => {
    await send("POST", "machine/numbers", { file, replaces: machine.numbers_digest });
    await reload();
  };
  const blocked = busy || !isReady(machine);
  return (
    <section class="box trouble" role="alert" aria-label="Which numbers hold?">
      <h2>
        {subject(machine)} holds other numbers than {file}. Which hold?
      </h2>
      <table>
        <thead>
          <tr>
            <th scope="col">number</th>
            <th scope="col">{file}</th>
            <th scope="col">the machine</th>
          </tr>
        </thead>
        <tbody>
          {numbers.slice(0, SHOWN).map((each) => (
            <tr key={each.number}>
              <th scope="row">{each.name}</th>
              <td>{setting(each.number, each.in_file, each.unit)}</td>
              <td>{setting(each.number, each.in_machine, each.unit)}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {numbers.length > SHOWN && <p>and {numbers.length - SHOWN} more.</p>}
      <p class="row">
        <button type="button" disabled={blocked} onClick={() => void run(takeIn)}>
          The machine's: take them into the folder
        </button>
        {held.is_written_here && (
          <button type="button" disabled={blocked} onClick={() => void run(write)}>
            Those of {file}: send them to the machine; nothing moves
          </button>
        )}
        {refusal}
      </p>
      {!held.is_written_here && (
        <p>
          If those of {file} hold: disconnect here, connect with your client, which sends them, and
          come back.
        </p>
      )}
    </section>
  );
}
