// A piece of the server's state that others change too: looked at again and again, and changed by presses.
import { useEffect, useMemo, useState } from "preact/hooks";
import { get, isSilence, send } from "../api/client";
import { LOOK_MS } from "../api/patience";
import { Lookout } from "./lookout";

const SELDOM_MS = 3000; // so what another tab or the command line does shows up

/** How a screen sees the state, and changes it. */
export interface Watched<State> {
  state: State | undefined;
  /** Nobody answered the last look, so the state may be old. */
  silent: boolean;
  /** Sends something that answers with the new state. */
  press: (path: string, body?: unknown) => Promise<void>;
  /** Whether a press waits for its answer. */
  busy: boolean;
  /** Why the last was refused; empty if it was not. */
  refused: string;
}

interface Watching<State> {
  path: string;
  /** Whether the server is at work, so that there is more to see. */
  works: (state: State) => boolean;
  oftenMs: number;
}

export function useWatched<State>({ path, works, oftenMs }: Watching<State>): Watched<State> {
  const [state, setState] = useState<State>();
  const [silent, setSilent] = useState(false);
  const [refused, setRefused] = useState("");
  const [waiting, setWaiting] = useState(0);
  const lookout = useMemo(
    () =>
      new Lookout<State>(() => get<State>(path, LOOK_MS), isSilence, {
        state: setState,
        silence: setSilent,
        refusal: (error) => setRefused(error instanceof Error ? error.message : String(error)),
      }),
    [path],
  );
  const often = state !== undefined && works(state);
  useEffect(() => {
    void lookout.look();
    const look = () => document.hidden || void lookout.look();
    const timer = setInterval(look, often ? oftenMs : SELDOM_MS);
    return () => clearInterval(timer);
  }, [lookout, often, oftenMs]);
  const press = async (name: string, body?: unknown) => {
    setWaiting((count) => count + 1);
    await lookout.press(async () => {
      const answer = await send<State>("POST", `${path}/${name}`, body);
      setRefused("");
      return answer;
    });
    setWaiting((count) => count - 1);
  };
  return { state, silent, press, busy: waiting > 0, refused };
}
