// A question that is asked again whenever what it depends on has changed: only the answer to the newest counts.
import { useEffect, useState } from "preact/hooks";
import { get } from "../api/client";
import { useProject } from "./project";

/**
 * The answer of a path for this state. The last answer stays in view until the next is there, and an answer to a
 * state that has passed is dropped, however late it comes. Without a path nothing is asked.
 */
export function useNewest<Answer>(path: string, state: string): Answer | undefined {
  const { setTrouble } = useProject();
  const [answer, setAnswer] = useState<Answer>();
  // What the server has by now needs a new answer.
  useEffect(() => {
    if (!path) return;
    let over = false;
    get<Answer>(path).then(
      (now) => over || setAnswer(now),
      (error: Error) => over || setTrouble(error.message),
    );
    return () => {
      over = true;
    };
  }, [path, state, setTrouble]);
  return answer;
}
