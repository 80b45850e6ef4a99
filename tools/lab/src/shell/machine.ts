// The machine as it is now: the server says so over a websocket, each time that something changes.
import { createContext } from "preact";
import { useContext, useEffect, useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { token } from "../api/token";

export type Machine = Schemas["MachineAnswer"];

const NONE: Machine = {
  kind: "none",
  name: "",
  phase: "none",
  place: null,
  knows_place: true,
  holds: false,
  moves: false,
  trouble: "",
  program: null,
  waits_for: "",
  said: [],
};
const TRY_AGAIN_MS = 1000;

export const MachineContext = createContext<Machine>(NONE);

/** The machine; for all screens. */
export function useMachine(): Machine {
  return useContext(MachineContext);
}

/** Whether it can take work now. */
export function isReady(machine: Machine): boolean {
  return machine.phase === "ready" && !machine.moves && !machine.holds;
}

/** Its name at the beginning of a sentence. */
export function subject(machine: Machine): string {
  return machine.kind === "virtual" ? "The virtual machine" : machine.name;
}

/** Listens to the machine; for the frame alone. */
export function useLiveMachine(): Machine {
  const [machine, setMachine] = useState(NONE);
  useEffect(() => {
    let socket: WebSocket | undefined;
    let timer = 0;
    let over = false;
    const listen = () => {
      socket = new WebSocket(new URL("api/live", location.href.replace(/^http/, "ws")), [
        "plumb",
        token(),
      ]);
      socket.onmessage = (message) => setMachine(JSON.parse(message.data) as Machine);
      socket.onclose = () => {
        if (!over) timer = window.setTimeout(listen, TRY_AGAIN_MS);
      };
    };
    listen();
    return () => {
      over = true;
      clearTimeout(timer);
      socket?.close();
    };
  }, []);
  return machine;
}
