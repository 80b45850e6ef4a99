// The serial ports of this computer, polled so that a newly plugged board appears; and the buttons that connect a
// machine at them.
import { useState } from "preact/hooks";
import { type Schemas, send } from "../api/client";
import { Field } from "../controls/Field";
import { useDo } from "./doing";
import { useWatched } from "./watched";

type Port = Schemas["Port"];

/** USB ports, with all others folded away. A machine that lost its connection may come back at any of them. */
export function Ports({ lost }: { lost?: string }) {
  const { state, silent } = useWatched<Port[]>("machine/ports");
  const ports = silent ? [] : (state ?? []).filter(({ path }) => path !== lost);
  const [typed, setTyped] = useState("");
  const [busy, run, refusal] = useDo();
  const connect = (port: string) => run(() => send("POST", "machine/board", { port }));
  const button = (path: string, again = "") => (
    <button key={path} type="button" disabled={busy} onClick={() => void connect(path)}>
      Connect {path}
      {again}
    </button>
  );
  const boards = ports.filter((port) => port.is_board);
  return (
    <div class="ports row">
      {lost && button(lost, " again")}
      {boards.map(({ path }) => button(path))}
      {!lost && boards.length === 0 && (
        <p>No board is there: plug the Mega in, and it appears here.</p>
      )}
      <details>
        <summary>Another port</summary>
        {ports.filter((port) => !port.is_board).map(({ path }) => button(path))}
        <form
          onSubmit={(event) => {
            event.preventDefault();
            void connect(typed);
          }}
        >
          <Field label="Its name, like COM3 or /dev/ttyACM0" value={typed} hear={setTyped} />{" "}
          <button type="submit" disabled={busy || !typed}>
            Connect
          </button>
        </form>
      </details>
      {refusal}
    </div>
  );
}
