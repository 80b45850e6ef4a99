// Differences between the connected machine and the open file, and the question which of them is right. Nothing is cut
// before that is answered.

import { type Schemas, send } from "../api/client";
import { Table } from "../controls/Table";
import { Do } from "./doing";
import { isReady, useMachine } from "./machine";
import { useNewest } from "./newest";
import { useProject, useTell } from "./project";

const SHOWN = 6;

export function Held() {
  const held = useHeld();
  if (!held || held.alike) return null;
  if (held.is_fit)
    return (
      <p class="box trouble" role="status">
        {held.headline} <a href="#/correct">Send them to it</a> before you cut.
      </p>
    );
  return <Question held={held} />;
}

function Question({ held }: { held: HeldAnswer }) {
  const machine = useMachine();
  const { reload } = useProject();
  const tell = useTell();
  const { file, said } = held;
  const write = async () => {
    await send("POST", "machine/numbers", { file, replaces: machine.numbers_digest });
    await reload();
  };
  const blocked = !isReady(machine);
  return (
    <section class="box trouble" role="alert" aria-label="Which numbers hold?">
      <h2>{held.headline}</h2>
      <Table names={["number", file, "the machine"]} rows={said.slice(0, SHOWN)} />
      {said.length > SHOWN && <p>and {said.length - SHOWN} more.</p>}
      <p class="row">
        <Do disabled={blocked} work={() => tell("machine/settings")}>
          The machine's: take them into the folder
        </Do>
        {held.is_written_here && (
          <Do disabled={blocked} work={write}>
            Those of {file}: send them to the machine; nothing moves
          </Do>
        )}
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

type HeldAnswer = Schemas["HeldAnswer"];

/** Differences between the connected machine and the open file; undefined while one of them is unknown. */
export function useHeld(): HeldAnswer | undefined {
  const machine = useMachine();
  const { project } = useProject();
  const file = project.choices.settings ?? "";
  const known = machine.numbers_digest !== "" && file !== "";
  const state = JSON.stringify([machine.numbers_digest, file, project.files[file]]);
  const held = useNewest<HeldAnswer>(known ? "machine/held" : "", state);
  return known && held?.file === file ? held : undefined;
}
