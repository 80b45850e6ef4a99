// A part of the server's state that others change too: polled, and changed by buttons.
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { get, isSilence, send } from "../api/client";
import { LOOK_MS } from "../api/patience";

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

/** Never two polls at once, and none while a press is under way; more often while `works`, if given. */
export function useWatched<State>(
  path: string,
  works: (state: State) => boolean = () => false,
  oftenMs = SELDOM_MS,
): Watched<State> {
  const [state, setState] = useState<State>();
  const [silent, setSilent] = useState(false);
  const [refused, setRefused] = useState("");
  const [waiting, setWaiting] = useState(0);
  const now = useRef({ looks: false, presses: 0, pressed: 0 }).current;
  const refuse = (error: unknown) =>
    setRefused(error instanceof Error ? error.message : String(error));
  const look = useCallback(async () => {
    if (now.looks || now.presses > 0) return;
    now.looks = true;
    const { pressed } = now;
    try {
      const seen = await get<State>(path, LOOK_MS);
      // A press has been answered since: this answer is out of date.
      if (pressed === now.pressed) setState(() => seen);
      setSilent(false);
    } catch (error) {
      if (isSilence(error)) setSilent(true);
      else refuse(error);
    }
    now.looks = false;
  }, [path, now]);
  const often = state !== undefined && works(state);
  useEffect(() => {
    void look();
    const timer = setInterval(() => document.hidden || void look(), often ? oftenMs : SELDOM_MS);
    return () => clearInterval(timer);
  }, [look, often, oftenMs]);
  const press = async (name: string, body?: unknown) => {
    now.presses += 1;
    now.pressed += 1;
    setWaiting(now.presses);
    try {
      const answer = await send<State>("POST", `${path}/${name}`, body);
      setState(() => answer);
      setSilent(false);
      setRefused("");
    } catch (error) {
      refuse(error);
    }
    now.presses -= 1;
    setWaiting(now.presses);
  };
  return { state, silent, press, busy: waiting > 0, refused };
}
