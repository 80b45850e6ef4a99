// Asks which readings disagree, a moment after each change.
import { useEffect, useState } from "preact/hooks";
import { get, isSilence, type Schemas } from "../api/client";
import { later } from "../api/rest";
import type { Form } from "./useReadings";

export type Doubt = Schemas["Doubted"];
const PAUSE_MS = 500;

interface Doubts {
  doubts: Doubt[];
  looking: boolean;
  /** Why nothing is looked for; empty if it is. */
  refused: string;
}

export function useDoubts(form: Form | undefined): Doubts {
  const [answer, setAnswer] = useState<Schemas["DoubtsAnswer"]>();
  const [refused, setRefused] = useState("");
  const { file = "", digest = "" } = form ?? {};
  const empty = !form?.distances.length && !form?.marks.some((mark) => mark.read);
  useEffect(() => {
    if (!file || empty) return;
    let over = false;
    const giveUp = later(async () => {
      const asked = get<Schemas["DoubtsAnswer"]>(`doubts?file=${encodeURIComponent(file)}`);
      let line = "";
      const doubts = await asked.catch((error: Error) => {
        line = isSilence(error) ? "" : error.message;
        return { file, digest, doubts: [] };
      });
      if (over) return;
      setAnswer(doubts);
      setRefused(line);
    }, PAUSE_MS);
    return () => {
      over = true;
      giveUp();
    };
  }, [file, digest, empty]);
  const current = answer?.file === file && answer.digest === digest;
  // An answer about the readings before stays in view, so that rings do not flicker.
  const doubts = !empty && answer?.file === file ? answer.doubts : [];
  return { doubts, looking: !current && !empty, refused: empty ? "" : refused };
}
