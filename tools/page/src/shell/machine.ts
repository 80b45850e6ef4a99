// The machine's current state, which the server sends over a websocket at each change.
import { createContext } from "preact";
import { useContext, useEffect, useMemo, useState } from "preact/hooks";
import { isSilence, type Schemas } from "../api/client";
import { namedLength, shownLength, type Unit } from "../controls/lengths";
import { Live } from "./live";
import { type Press, Presses } from "./presses";

/** Its state, `unseen` seconds ago; 0 while reports keep coming. */
export type Machine = Schemas["MachineAnswer"] & { unseen: number };

const NONE: Machine = {
  kind: "none",
  name: "",
  subject: "",
  doing: "",
  at_work: { title: "", say: "" },
  phase: "none",
  place: null,
  knows_place: true,
  kept_lengths: null,
  holds: false,
  moves: false,
  trouble: "",
  program: null,
  waits_for: "",
  said: [],
  firmware: "",
  brought: "",
  written: null,
  silent_s: 0,
  numbers_digest: "",
  unseen: 0,
};
const LOOK_MS = 500;
const REST_MS = 1000; // before a press is sent again

export const MachineContext = createContext<Machine>(NONE);

/** The machine; for all screens. */
export function useMachine(): Machine {
  return useContext(MachineContext);
}

/** Whether it is ready for work now. */
export function isReady(machine: Machine): boolean {
  return machine.phase === "ready" && !machine.moves && !machine.holds && machine.unseen === 0;
}

/** Whether it is connected. */
export function isConnected({ kind, phase }: Machine): boolean {
  return kind !== "none" && phase !== "lost";
}

/** Where its sled is. */
export function placeWords([x, y, z]: readonly [number, number, number], unit: Unit): string {
  return ` x ${shownLength(x, unit)}, y ${shownLength(y, unit)}, z ${namedLength(z, unit)}`;
}

/** What the frame knows of the machine, and how it is stopped. */
export interface LiveMachine {
  machine: Machine;
  press: Press | undefined;
  presses: Presses;
}

/** Listens to the machine; for the frame alone. */
export function useLiveMachine(): LiveMachine {
  const [said, setSaid] = useState<Schemas["MachineAnswer"]>(NONE);
  const [silent, setSilent] = useState(0);
  const [press, setPress] = useState<Press>();
  const live = useMemo(() => new Live(setSaid), []);
  const presses = useMemo(() => {
    const rest = () => new Promise<void>((done) => setTimeout(done, REST_MS));
    return new Presses({ press: (way) => live.press(way), isSilence, rest }, setPress);
  }, [live]);
  useEffect(() => {
    live.open();
    const timer = setInterval(() => setSilent(live.silence()), LOOK_MS);
    return () => {
      clearInterval(timer);
      live.close();
    };
  }, [live]);
  const machine = useMemo(
    () => ({ ...said, unseen: silent ? silent + said.silent_s : said.silent_s }),
    [said, silent],
  );
  return { machine, press, presses };
}
