// A question that is asked again whenever what it depends on has changed: only the answer to the newest counts.
import { useEffect, useRef, useState } from "preact/hooks";
import { get, isSilence } from "../api/client";
import { useProject } from "./project";

const AGAIN_MS = 3000; // after a question that nobody answered

/**
 * The answer of a path for this state. The last answer stays in view until the next is there, and an answer to a
 * state that has passed is dropped, however late it comes. Without a path nothing is asked.
 */
export function useNewest<Answer>(path: string, state: string): Answer | undefined {
  const { setTrouble } = useProject();
  const [answer, setAnswer] = useState<Answer>();
  const refused = useRef(""); // what is said of this question
  // What the server has by now needs a new answer.
  useEffect(() => {
    if (!path) return;
    let over = false;
    let timer = 0;
    const ask = () =>
      get<Answer>(path).then(
        (now) => {
          if (over) return;
          setAnswer(now);
          setTrouble((line) => (line === refused.current ? "" : line));
        },
        (error: Error) => {
          if (over) return;
          refused.current = error.message;
          setTrouble(error.message);
          if (isSilence(error)) timer = window.setTimeout(ask, AGAIN_MS);
        },
      );
    void ask();
    return () => {
      over = true;
      clearTimeout(timer);
    };
  }, [path, state, setTrouble]);
  return answer;
}
