// Connects a machine: a board at a port, or a virtual machine to try; afterwards its settings can be read.
import { useEffect, useState } from "preact/hooks";
import { get, isSilence, type Project, type Schemas, send } from "../api/client";
import { LOOK_MS } from "../api/patience";
import { useDo } from "../shell/doing";
import { Lookout } from "../shell/lookout";
import { type Machine, subject, useMachine } from "../shell/machine";
import { useProject } from "../shell/project";
import "./connection.css";

type Port = Schemas["Port"];

export function Connection() {
  const machine = useMachine();
  if (machine.kind === "none") return <Ways />;
  return <Connected machine={machine} />;
}

function Ways() {
  const [ports, setPorts] = useState<Port[]>([]);
  const [typed, setTyped] = useState("");
  const [busy, run] = useDo();
  useEffect(() => {
    const lookout = new Lookout(() => get<Port[]>("machine/ports", LOOK_MS), isSilence, {
      state: setPorts,
      silence: (is) => is && setPorts([]),
      refusal: () => setPorts([]),
    });
    void lookout.look();
    const timer = setInterval(() => void lookout.look(), 3000);
    return () => clearInterval(timer);
  }, []);
  const connect = (port: string) => run(() => send("POST", "machine/board", { port }));
  return (
    <div class="ways">
      <section>
        <h2>A machine on USB</h2>
        {ports.length === 0 && <p>No port is there: plug the Mega in, and it appears here.</p>}
        {ports.map((port) => (
          <button key={port.path} type="button" disabled={busy} onClick={() => connect(port.path)}>
            Connect {port.path}
          </button>
        ))}
        <details>
          <summary>Another port</summary>
          <form
            onSubmit={(event) => {
              event.preventDefault();
              connect(typed);
            }}
          >
            <label>
              Its name, like COM3 or /dev/ttyACM0{" "}
              <input value={typed} onInput={(event) => setTyped(event.currentTarget.value)} />
            </label>{" "}
            <button type="submit" disabled={busy || !typed}>
              Connect
            </button>
          </form>
        </details>
      </section>
      <VirtualStart busy={busy} run={run} />
    </div>
  );
}

const MACHINES = 1_000_000; // that can be drawn

interface StartParts {
  busy: boolean;
  run: (work: () => Promise<unknown>) => void;
}

function VirtualStart({ busy, run }: StartParts) {
  const { project, take } = useProject();
  const [hides, setHides] = useState<"random" | "nothing">("random");
  const [speed, setSpeed] = useState(100);
  const [number, setNumber] = useState("");
  const start = async () => {
    const drawn = Math.floor(Math.random() * MACHINES);
    const seed = /^\d{1,6}$/.test(number) ? Number(number) : drawn;
    await send("POST", "machine/virtual", { hides, seed, speed });
    if (project.machine) return;
    await ready();
    take(await send<Project>("POST", "machine/settings"));
  };
  return (
    <section>
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
      <button type="button" disabled={busy} onClick={() => run(start)}>
        {busy ? "It starts …" : "Start a virtual machine"}
      </button>
    </section>
  );
}

/** Waits until the machine takes work. */
async function ready(): Promise<void> {
  for (;;) {
    const machine = await get<Machine>("machine", LOOK_MS);
    if (machine.phase !== "connecting") return;
    await new Promise((done) => setTimeout(done, 100));
  }
}

function Connected({ machine }: { machine: Machine }) {
  const { take } = useProject();
  const [busy, run] = useDo();
  const readSettings = async () => take(await send<Project>("POST", "machine/settings"));
  const again = () => run(() => send("POST", "machine/board", { port: machine.name }));
  return (
    <section class="connected">
      <h2>{subject(machine)} is connected</h2>
      {machine.phase === "lost" ? (
        <>
          <p>The line was lost. What you cut and typed is kept.</p>
          {machine.kind === "board" && (
            <button type="button" class="primary" disabled={busy} onClick={again}>
              Connect {machine.name} again
            </button>
          )}
        </>
      ) : (
        <button
          type="button"
          disabled={busy || machine.phase !== "ready"}
          onClick={() => run(readSettings)}
        >
          {busy ? "It is asked …" : "Read its settings; nothing moves"}
        </button>
      )}{" "}
      <button
        type="button"
        disabled={busy}
        onClick={() => run(() => send("POST", "machine/disconnect"))}
      >
        Disconnect
      </button>
      {machine.said.length > 0 && (
        <details>
          <summary>What the machine said</summary>
          <pre>{machine.said.join("\n")}</pre>
        </details>
      )}
    </section>
  );
}
