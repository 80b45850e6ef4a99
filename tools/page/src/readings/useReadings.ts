// The form of readings: loaded, edited, and saved reading by reading.
import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { get, isSilence, type Schemas, send } from "../api/client";
import { type Kept, useKept } from "../shell/kept";
import { useProject } from "../shell/project";
import { same } from "../shell/rebase";
import { Turns } from "../shell/turns";
import { type Form, savesOf } from "./saves";
import { type OpenMark, useOpenMark } from "./useOpenMark";

export type { Form };
export type Place = readonly [number, number];
/** A reading [mm from the chosen edges] for each mark by its number in the form. */
export type Typed = Record<string, Place>;

export interface TypedForm extends OpenMark {
  form: Form | undefined;
  kept: Kept<Typed>;
  /** Shows the result of a save, unless another form is open by now. */
  take: (form: Form) => void;
  chooseFile: (name: string) => void;
}

const NOTHING: Typed = {};
const AGAIN_MS = 3000; // after a server that did not answer

/** The form of this name; without a name the newest. */
export function useReadings(first = ""): TypedForm {
  const { project, setTrouble, reload: reloadProject } = useProject();
  const [file, setFile] = useState(first);
  const [form, setForm] = useState<Form>();
  const [silences, setSilences] = useState(0);
  const newest = useRef<Form | undefined>(undefined);
  const turns = useRef(new Turns()).current;
  const refused = useRef(""); // the error of a load
  const show = useCallback((answer: Form) => {
    newest.current = answer;
    savesOf(answer.file).learn(answer);
    setForm((before) => (same(before, answer) ? before : answer));
  }, []);
  const take = useCallback(
    (answer: Form) => {
      if (newest.current?.file !== answer.file) return;
      // A save has finished since: this answer is out of date.
      turns.overtake();
      show(answer);
    },
    [turns, show],
  );
  const load = useCallback(async () => {
    const question = turns.begin();
    try {
      const answer = await get<Form>(`readings?file=${encodeURIComponent(file)}`);
      if (turns.counts(question)) show(answer);
      // The reason for a refused save stays visible.
      setTrouble((line) => (line === refused.current ? "" : line));
    } catch (error) {
      refused.current = error instanceof Error ? error.message : String(error);
      setTrouble(refused.current);
      if (isSilence(error)) setSilences((count) => count + 1);
    }
  }, [file, turns, show, setTrouble]);
  // Without an answer, ask again.
  useEffect(() => {
    if (silences === 0) return;
    const timer = setTimeout(() => void load(), AGAIN_MS);
    return () => clearTimeout(timer);
  }, [silences, load]);
  const onDisk = form ? project.files[form.file] : "";
  const known = Object.keys(project.files).join();
  const shown = form?.digest;
  // What is on disk or chosen has changed. A file that went back to what the page last saw there shows no change:
  // as long as the form is another than the folder's, it is loaded again.
  useEffect(() => {
    if (onDisk === shown && onDisk) return;
    void load();
    const timer = onDisk ? setInterval(() => void load(), AGAIN_MS) : undefined;
    return () => clearInterval(timer);
  }, [load, onDisk, known, shown]);
  // Other edges or settings change every number, once the server has them.
  useEffect(() => void load(), [project.choices_digest]);
  const kept = useKept<Typed>({
    place: `readings:${form?.file ?? ""}:${form?.edges ?? ""}`,
    saved: form ? typedIn(form) : NOTHING,
    save: async (value) => {
      if (!form) return value;
      const { file, edges } = form;
      const readings = changes(typedIn(form), value);
      const answer = await savesOf(file).save(form, ({ digest }) =>
        send<Form>("PUT", "readings", { file, digest, edges, readings }),
      );
      take(answer);
      void reloadProject();
      // From other edges its numbers differ.
      return answer.edges === edges ? typedIn(answer) : value;
    },
    reload: load,
    asks: true,
  });
  return { form, kept, take, chooseFile: setFile, ...useOpenMark(form) };
}

/** The readings that a form has. */
function typedIn(form: Form): Typed {
  const typed: Record<string, Place> = {};
  for (const mark of form.marks) if (mark.read) typed[mark.index] = mark.read as Place;
  return typed;
}

/** The readings that changed. */
function changes(was: Typed, is: Typed): Schemas["TypedReading"][] {
  const indices = [...new Set([...Object.keys(was), ...Object.keys(is)])];
  return indices
    .filter((index) => !same(was[index], is[index]))
    .map((index) => ({
      index: Number(index),
      read: is[index] ? ([...is[index]] as [number, number]) : null,
    }));
}
