// An answer that takes seconds: polled until complete, and asked again when the folder has changed.
import { useEffect, useReducer, useRef } from "preact/hooks";
import { get } from "../api/client";
import { later } from "../api/rest";
import { useAsked } from "./asked";
import { useProject } from "./project";

const AGAIN_MS = 400;

/**
 * The answer of a path for the folder as it is now. Where only a choice has changed, such as the unit, the last whole
 * answer stays in view until the next is whole, with how far that is. After other files nothing of it stays.
 */
export function useAnswer<Answer extends { share: number }>(
  path: string,
  wanted = true,
): { answer: Answer | undefined; refused: string } {
  const { project } = useProject();
  const whole = useRef<{ files: string; answer: Answer } | undefined>(undefined);
  const { "lab.json": _, ...files } = project.files;
  // Choices count once they are saved, as the server uses its own copy.
  const held = JSON.stringify(files);
  const [looks, look] = useReducer((count: number, _: undefined) => count + 1, 0);
  const ask = async () => {
    const now = await get<Answer>(path);
    if (now.share === 1) whole.current = { files: held, answer: now };
    return now;
  };
  const state = JSON.stringify([path, held, project.choices_digest, looks]);
  const { answer, refused } = useAsked(wanted ? ask : undefined, state);
  useEffect(() => {
    if (answer && answer.share < 1) return later(() => look(undefined), AGAIN_MS);
  }, [answer]);
  const stays = whole.current?.files === held ? whole.current.answer : undefined;
  const isOnItsWay = answer !== undefined && answer.share < 1;
  return { answer: isOnItsWay && stays ? { ...stays, share: answer.share } : answer, refused };
}
