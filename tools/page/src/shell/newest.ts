// A path's answer for the folder as it is now; errors are shown on top of the page.
import { useEffect, useRef } from "preact/hooks";
import { get } from "../api/client";
import { useAsked } from "./asked";
import { useProject } from "./project";

/** The answer of a path for this state. Without a path nothing is asked. */
export function useNewest<Answer>(path: string, state: string): Answer | undefined {
  const { setTrouble } = useProject();
  const key = JSON.stringify([path, state]);
  const { answer, refused, looking } = useAsked(path ? () => get<Answer>(path) : undefined, key);
  const said = useRef(""); // of this question
  useEffect(() => {
    if (looking) return;
    const before = said.current;
    said.current = refused;
    setTrouble((line) => refused || (line === before ? "" : line));
  }, [refused, looking, setTrouble]);
  return answer;
}
