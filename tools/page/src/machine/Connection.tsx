// Connects a machine: a board at a port, or a virtual machine to try; afterwards its settings can be read.
import { useState } from "preact/hooks";
import { get, LOOK_MS, send } from "../api/client";
import { later } from "../api/rest";
import { Field, Select } from "../controls/Field";
import { Progress } from "../controls/Progress";
import { Do } from "../shell/doing";
import { type Machine, useMachine } from "../shell/machine";
import { Ports } from "../shell/Ports";
import { useProject, useTell } from "../shell/project";
import "./connection.css";

export function Connection() {
  const machine = useMachine();
  if (machine.kind !== "none") return <Connected machine={machine} />;
  return (
    <div class="ways tiles">
      <section class="box">
        <h2>A machine on USB</h2>
        <Ports />
      </section>
      <VirtualStart />
    </div>
  );
}

const MACHINES = 1_000_000; // that can be drawn
const HIDES = [
  ["random", "a hidden effect"],
  ["nothing", "nothing but wrong numbers"],
] as const;
const SPEEDS = [
  [1, "as slowly as a real machine"],
  [10, "10 times as fast"],
  [100, "100 times as fast"],
  [1000, "as fast as this computer can"],
] as const;

function VirtualStart() {
  const { project } = useProject();
  const tell = useTell();
  const [hides, setHides] = useState<(typeof HIDES)[number][0]>("random");
  const [speed, setSpeed] = useState<(typeof SPEEDS)[number][0]>(100);
  const [number, setNumber] = useState("");
  const start = async () => {
    const drawn = Math.floor(Math.random() * MACHINES);
    const seed = /^\d{1,6}$/.test(number) ? Number(number) : drawn;
    await send("POST", "machine/virtual", { hides, seed, speed });
    if (project.machine) return;
    await ready();
    await tell("machine/settings");
  };
  return (
    <section class="box">
      <h2>A virtual machine to try</h2>
      <Select label="It has" options={HIDES} chosen={hides} choose={setHides} />
      <Select label="and cuts" options={SPEEDS} chosen={speed} choose={setSpeed} />
      <details>
        <summary>A certain machine</summary>
        <Field
          label="Its number"
          inputMode="numeric"
          value={number}
          placeholder="drawn"
          hear={setNumber}
        />
      </details>
      <Do work={start} meanwhile="It starts …">
        Start a virtual machine
      </Do>
    </section>
  );
}

/** Waits until the machine is ready for work. */
async function ready(): Promise<void> {
  for (;;) {
    const machine = await get<Machine>("machine", LOOK_MS);
    if (machine.phase !== "connecting") return;
    await new Promise((done) => later(() => done(undefined), 100));
  }
}

function Connected({ machine }: { machine: Machine }) {
  const tell = useTell();
  const isLost = machine.phase === "lost";
  return (
    <section class="connected box">
      <h2>
        {machine.subject}
        {machine.kind === "board" && ` at ${machine.name}`}
      </h2>
      {isLost ? (
        <p>What you cut and typed is kept. Connect it again in the bar below.</p>
      ) : (
        <Do
          disabled={machine.phase !== "ready"}
          meanwhile="It is asked …"
          work={() => tell("machine/settings")}
        >
          Read its settings; nothing moves
        </Do>
      )}{" "}
      <Do work={() => send("POST", "machine/disconnect")}>
        {isLost ? "Let go of it" : "Disconnect"}
      </Do>
      <Firmware machine={machine} />
      {machine.said.length > 0 && (
        <details>
          <summary>What the machine said</summary>
          <pre>{machine.said.join("\n")}</pre>
        </details>
      )}
    </section>
  );
}

/** The firmware on the board, and ours to write over it. */
function Firmware({ machine }: { machine: Machine }) {
  const { brought, firmware, phase, written } = machine;
  const [asked, setAsked] = useState(false);
  if (written !== null) {
    return (
      <>
        <p>{brought} is being written to the board. Leave its cable in.</p>
        <Progress share={written} label="Written" />
      </>
    );
  }
  if (machine.kind !== "board" || !brought || phase === "connecting") return null;
  const write = async () => {
    await send("POST", "machine/firmware");
    setAsked(false);
  };
  return (
    <details open={firmware !== "" && firmware !== brought}>
      <summary>On the board: {firmware || "a firmware that did not say its name"}</summary>
      {asked ? (
        <p>
          Its motors go off and the sled may sink. Settings and chain lengths stay.{" "}
          <Do work={write}>Write it now</Do>{" "}
          <button type="button" onClick={() => setAsked(false)}>
            Leave it as it is
          </button>
        </p>
      ) : (
        <button type="button" onClick={() => setAsked(true)}>
          Write {brought} to this board
        </button>
      )}
    </details>
  );
}
