// Answers that others may change: asked for again and again. Those of a busy server come in any order, so an answer
// counts until one to a later question is here, or a save has been answered.
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { get } from "../api/client";
import { same } from "./rebase";

export interface Fresh<State> {
  state: State | undefined;
  /** Shows the answer to a save: what was asked before it is out of date. */
  take: (answer: State) => void;
  /** Asks now. Fails without an answer. */
  load: () => Promise<void>;
}

/** The newest answer of a path; `seen` hears of each before it is shown. */
export function useFresh<State>(
  path: string,
  patienceMs: number,
  seen: (answer: State) => void = () => {},
): Fresh<State> {
  const [state, setState] = useState<State>();
  const turns = useRef({ asked: 0, newest: 0 }).current;
  const show = (answer: State) => {
    seen(answer);
    // Unchanged parts stay the same objects, so that no screen asks again for what it shows.
    setState((before) => (same(before, answer) ? before : answer));
  };
  const take = useCallback((answer: State) => {
    turns.newest = turns.asked;
    show(answer);
  }, []);
  const load = useCallback(async () => {
    turns.asked += 1;
    const turn = turns.asked;
    const answer = await get<State>(path, patienceMs);
    if (turn <= turns.newest) return;
    turns.newest = turn;
    show(answer);
  }, [path]);
  return { state, take, load };
}

/** Looks at once and again and again while the page is in view, never twice at the same time. */
export function usePolling(look: () => Promise<unknown>, everyMs: number): void {
  useEffect(() => {
    let looks = false;
    // Unanswered requests would use up all the browser's connections.
    const turn = async () => {
      if (looks) return;
      looks = true;
      await look();
      looks = false;
    };
    void turn();
    const timer = setInterval(() => document.hidden || void turn(), everyMs);
    return () => clearInterval(timer);
  }, [look, everyMs]);
}
