// A part of the server's state that others change too: polled, and changed by buttons.
import { useCallback, useState } from "preact/hooks";
import { isSilence, LOOK_MS, lineOf, send } from "../api/client";
import { useFresh, usePolling } from "./fresh";

const SELDOM_MS = 3000; // so what another tab or the command line does shows up

/** How a screen sees the state, and changes it. */
export interface Watched<State> {
  state: State | undefined;
  /** The last poll was not answered, so the state may be out of date. */
  silent: boolean;
  /** Sends something that answers with the new state. */
  press: (name: string, body?: unknown) => Promise<void>;
  /** Whether a press waits for its answer. */
  busy: boolean;
  /** Why the last was refused; empty if it was not. */
  refused: string;
}

/** Polled more often while `works`, if given. */
export function useWatched<State>(
  path: string,
  works: (state: State) => boolean = () => false,
  oftenMs = SELDOM_MS,
): Watched<State> {
  const { state, take, load } = useFresh<State>(path, LOOK_MS);
  const [silent, setSilent] = useState(false);
  const [refused, setRefused] = useState("");
  const [presses, setPresses] = useState(0); // that wait
  const look = useCallback(
    () =>
      load().then(
        () => setSilent(false),
        (error) => (isSilence(error) ? setSilent(true) : setRefused(lineOf(error))),
      ),
    [load],
  );
  usePolling(look, state !== undefined && works(state) ? oftenMs : SELDOM_MS);
  const press = async (name: string, body?: unknown) => {
    setPresses((count) => count + 1);
    try {
      take(await send<State>("POST", `${path}/${name}`, body));
      setSilent(false);
      setRefused("");
    } catch (error) {
      setRefused(lineOf(error));
    }
    setPresses((count) => count - 1);
  };
  return { state, silent, press, busy: presses > 0, refused };
}
