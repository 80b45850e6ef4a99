// A piece of the server's state that others change too: looked at again and again, and changed by presses.
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { get, send } from "../api/client";

const SELDOM_MS = 3000; // so what another tab or the command line does shows up

/** How a screen sees the state, and changes it. */
export interface Watched<State> {
  state: State | undefined;
  /** Sends something that answers with the new state. */
  press: (path: string, body?: unknown) => Promise<void>;
  /** Whether a press waits for its answer. */
  busy: boolean;
}

interface Watching<State> {
  path: string;
  /** Whether the server is at work, so that there is more to see. */
  works: (state: State) => boolean;
  oftenMs: number;
  trouble: (line: string) => void;
}

export function useWatched<State>({
  path,
  works,
  oftenMs,
  trouble,
}: Watching<State>): Watched<State> {
  const [state, setState] = useState<State>();
  const [waiting, setWaiting] = useState(0);
  const pressed = useRef({ begun: 0, ended: 0 });
  const looks = useRef(false);
  const look = useCallback(async () => {
    const { begun, ended } = pressed.current;
    if (looks.current || begun > ended) return;
    looks.current = true;
    try {
      const answer = await get<State>(path);
      // An answer that a press has overtaken is old.
      if (begun === pressed.current.begun) setState(answer);
    } catch (error) {
      trouble(error instanceof Error ? error.message : String(error));
    } finally {
      looks.current = false;
    }
  }, [path, trouble]);
  const often = state !== undefined && works(state);
  useEffect(() => {
    void look();
    const timer = setInterval(() => document.hidden || void look(), often ? oftenMs : SELDOM_MS);
    return () => clearInterval(timer);
  }, [look, often, oftenMs]);
  const press = async (name: string, body?: unknown) => {
    pressed.current.begun += 1;
    setWaiting((count) => count + 1);
    try {
      setState(await send<State>("POST", `${path}/${name}`, body));
      trouble("");
    } catch (error) {
      trouble(error instanceof Error ? error.message : String(error));
    }
    pressed.current.ended += 1;
    setWaiting((count) => count - 1);
  };
  return { state, press, busy: waiting > 0 };
}
