// A question that is asked again whenever its input has changed; only the newest answer counts.
import { useEffect, useState } from "preact/hooks";
import { isSilence } from "../api/client";
import { later } from "../api/rest";

const AGAIN_MS = 3000; // after a question without an answer

export interface Asked<Answer> {
  /** The last answer, kept until the next arrives. */
  answer: Answer | undefined;
  /** Why the newest question was refused; empty if it was not. */
  refused: string;
  /** Whether the answer to the newest question is still to come. */
  looking: boolean;
}

/**
 * The answer for this state, asked a pause [ms] after the state came. An answer to a state that has passed is dropped,
 * however late it comes. Without a question nothing is asked.
 */
export function useAsked<Answer>(
  ask: (() => Promise<Answer>) | undefined,
  state: string,
  pause = 0,
): Asked<Answer> {
  const [answer, setAnswer] = useState<Answer>();
  const [ended, setEnded] = useState({ state: "", refused: "" });
  const isAsked = ask !== undefined;
  useEffect(() => {
    if (!ask) return;
    let over = false;
    let timer = 0;
    const turn = () =>
      ask().then(
        (now) => {
          if (over) return;
          setAnswer(() => now);
          setEnded({ state, refused: "" });
        },
        (error: Error) => {
          if (over) return;
          setEnded({ state, refused: error.message });
          if (isSilence(error)) timer = window.setTimeout(turn, AGAIN_MS);
        },
      );
    const giveUp = pause > 0 ? later(turn, pause) : void turn();
    return () => {
      over = true;
      clearTimeout(timer);
      giveUp?.();
    };
  }, [isAsked, state]);
  return {
    answer,
    refused: isAsked ? ended.refused : "",
    looking: isAsked && ended.state !== state,
  };
}
