// An answer that takes seconds: asked again until it is whole, and again when the folder has changed.
import { useEffect, useState } from "preact/hooks";
import { get, isSilence } from "../api/client";
import { useProject } from "./project";

const AGAIN_MS = 400;

interface Slow {
  share: number;
}

export function useAnswer<Answer extends Slow>(
  path: string,
  wanted = true,
): { answer: Answer | undefined; refused: string } {
  const { project } = useProject();
  const [answer, setAnswer] = useState<Answer>();
  const [refused, setRefused] = useState("");
  const { "lab.json": _, ...files } = project.files;
  // Choices count once they are saved: the server answers by what it has.
  const state = JSON.stringify([files, project.choices_digest]);
  // A new state of the folder needs a new answer.
  useEffect(() => {
    if (!wanted) return;
    let over = false;
    const ask = async () => {
      try {
        const now = await get<Answer>(path);
        if (over) return;
        setAnswer(now);
        setRefused("");
        if (now.share < 1) setTimeout(() => void (over || ask()), AGAIN_MS);
      } catch (error) {
        if (over) return;
        if (isSilence(error)) setTimeout(() => void (over || ask()), 5 * AGAIN_MS);
        else setRefused(error instanceof Error ? error.message : String(error));
      }
    };
    void ask();
    return () => {
      over = true;
    };
  }, [path, state, wanted]);
  return { answer, refused };
}
