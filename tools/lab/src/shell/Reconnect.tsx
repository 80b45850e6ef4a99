// A board whose line was lost: connected again at its port, or at one that is there by now.
import { send } from "../api/client";
import { useDo } from "./doing";
import type { Machine } from "./machine";
import { usePorts } from "./ports";

export function Reconnect({ machine }: { machine: Machine }) {
  const others = usePorts().filter(({ path, is_board }) => is_board && path !== machine.name);
  const [busy, run, refusal] = useDo();
  const connect = (port: string) => run(() => send("POST", "machine/board", { port }));
  return (
    <p class="presses">
      <button type="button" disabled={busy} onClick={() => void connect(machine.name)}>
        Connect {machine.name} again
      </button>
      {others.map(({ path }) => (
        <button key={path} type="button" disabled={busy} onClick={() => void connect(path)}>
          Connect {path}
        </button>
      ))}
      {refusal}
    </p>
  );
}
