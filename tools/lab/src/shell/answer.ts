// An answer that takes seconds: asked again until it is whole, and again when the folder has changed.
import { useEffect, useRef, useState } from "preact/hooks";
import { get, isSilence } from "../api/client";
import { later } from "../api/rest";
import { useProject } from "./project";

const AGAIN_MS = 400;

interface Slow {
  share: number;
}

interface Whole<Answer> {
  files: string;
  answer: Answer;
}

/**
 * The answer of a path for the folder as it is now. Where only a choice has changed, such as the unit, the last whole
 * answer stays in view until the next is whole, with how far that is. After other files nothing of it stays.
 */
export function useAnswer<Answer extends Slow>(
  path: string,
  wanted = true,
): { answer: Answer | undefined; refused: string } {
  const { project } = useProject();
  const [answer, setAnswer] = useState<Answer>();
  const whole = useRef<Whole<Answer> | undefined>(undefined);
  const [refused, setRefused] = useState("");
  const { "lab.json": _, ...files } = project.files;
  // Choices count once they are saved: the server answers by what it has.
  const held = JSON.stringify(files);
  const state = `${held} ${project.choices_digest}`;
  // A new state of the folder needs a new answer.
  useEffect(() => {
    if (!wanted) return;
    let over = false;
    let giveUp = () => {};
    const ask = async () => {
      try {
        const now = await get<Answer>(path);
        if (over) return;
        if (now.share === 1) whole.current = { files: held, answer: now };
        setAnswer(now);
        setRefused("");
        if (now.share < 1) giveUp = later(() => void ask(), AGAIN_MS);
      } catch (error) {
        if (over) return;
        if (isSilence(error)) giveUp = later(() => void ask(), 5 * AGAIN_MS);
        else setRefused(error instanceof Error ? error.message : String(error));
      }
    };
    void ask();
    return () => {
      over = true;
      giveUp();
    };
  }, [path, state, wanted]);
  const stays = whole.current?.files === held ? whole.current.answer : undefined;
  const isOnItsWay = answer !== undefined && answer.share < 1;
  return { answer: isOnItsWay && stays ? { ...stays, share: answer.share } : answer, refused };
}
