// The form of readings: loaded, edited, and saved reading by reading.
import { useCallback, useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { isSilence, lineOf, READ_MS, type Schemas, send } from "../api/client";
import { useFresh } from "../shell/fresh";
import { type Kept, useKept } from "../shell/kept";
import { useProject } from "../shell/project";
import { same } from "../shell/rebase";
import { type Form, savesOf } from "./saves";

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
  const [silent, setSilent] = useState(false);
  const shown = useRef(""); // the file
  const refused = useRef(""); // the error of a load
  const path = `readings?file=${encodeURIComponent(file)}`;
  const fresh = useFresh<Form>(path, READ_MS, (answer) => {
    shown.current = answer.file;
    savesOf(answer.file).learn(answer);
  });
  const { state: form, load: ask } = fresh;
  const take = (answer: Form) => {
    if (shown.current === answer.file) fresh.take(answer);
  };
  const load = useCallback(
    () =>
      ask().then(
        () => {
          setSilent(false);
          // The reason for a refused save stays visible.
          setTrouble((line) => (line === refused.current ? "" : line));
        },
        (error) => {
          refused.current = lineOf(error);
          setTrouble(refused.current);
          setSilent(isSilence(error));
        },
      ),
    [ask, setTrouble],
  );
  const onDisk = form ? project.files[form.file] : "";
  const known = Object.keys(project.files).join();
  const digest = form?.digest;
  // What is on disk or chosen has changed, or nobody answered. A file that went back to what the page last saw there
  // shows no change: as long as the form is another than the folder's, it is loaded again.
  useEffect(() => {
    if (onDisk === digest && onDisk && !silent) return;
    void load();
    const timer = onDisk || silent ? setInterval(() => void load(), AGAIN_MS) : undefined;
    return () => clearInterval(timer);
  }, [load, onDisk, known, digest, silent]);
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

interface OpenMark {
  open: number;
  pick: (index: number) => void;
}

/** The mark being typed: at first one without a reading. After choosing another you can type at once. */
function useOpenMark(form: Form | undefined): OpenMark {
  const [picked, setPicked] = useState<{ file: string; index: number }>();
  const begin = useRef({ file: "", index: 0 });
  const { file = "", marks = [] } = form ?? {};
  if (begin.current.file !== file) {
    const waiting = marks.find((mark) => !mark.read) ?? marks[0];
    begin.current = { file, index: waiting?.index ?? 0 };
  }
  // At once, so that the next key is for it.
  useLayoutEffect(() => {
    if (picked) document.querySelector<HTMLElement>(`#mark-${picked.index} input`)?.focus();
  }, [picked]);
  return {
    open: picked?.file === file ? picked.index : begin.current.index,
    pick: (index) => setPicked({ file, index }),
  };
}
