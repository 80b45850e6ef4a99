// Connects a machine: a board at a port, or a virtual machine to try; afterwards its settings can be read.
import { useState } from "preact/hooks";
import { get, LOOK_MS, send } from "../api/client";
import { later } from "../api/rest";
import { Do } from "../shell/doing";
import { type Machine, useMachine } from "../shell/machine";
import { Ports } from "../shell/Ports";
import { useProject, useTell } from "../shell/project";
import { Firmware } from "./Firmware";
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

function VirtualStart() {
  const { project } = useProject();
  const tell = useTell();
  const [hides, setHides] = useState<"random" | "nothing">("random");
  const [speed, setSpeed] = useState(100);
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
      <label>
        It has{" "}
        <select
          value={hides}
          onChange={(event) => setHides(event.currentTarget.value as typeof hides)}
        >
          <option value="random">a hidden effect</option>
          <option value="nothing">nothing but wrong numbers</option>
        </select>
      </label>
      <label>
        and cuts{" "}
        <select
          value={String(speed)}
          onChange={(event) => setSpeed(Number(event.currentTarget.value))}
        >
          <option value="1">as slowly as a real machine</option>
          <option value="10">10 times as fast</option>
          <option value="100">100 times as fast</option>
          <option value="1000">as fast as this computer can</option>
        </select>
      </label>
      <details>
        <summary>A certain machine</summary>
        <label>
          Its number{" "}
          <input
            inputMode="numeric"
            value={number}
            placeholder="drawn"
            onInput={(event) => setNumber(event.currentTarget.value)}
          />
        </label>
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
