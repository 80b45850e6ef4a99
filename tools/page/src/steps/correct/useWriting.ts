// Writes the accepted numbers into a file, sends a file to the machine, and undoes either.
import { useState } from "preact/hooks";
import { type Schemas, send } from "../../api/client";
import { type Doing, useDo } from "../../shell/doing";
import { useProject } from "../../shell/project";

export type CorrectionAnswer = Schemas["CorrectionAnswer"];
export type Known = Schemas["Write"];
export type Sent = Schemas["NumbersAnswer"];

export interface Writing {
  busy: boolean;
  /** Why the last action was refused, for its button. */
  notWritten: Doing[2];
  notSent: Doing[2];
  written: Schemas["Written"] | undefined;
  sent: Sent | undefined;
  write: (known: Known) => Promise<void>;
  undo: (known: Known) => Promise<void>;
  /** Sends the numbers of a file to the machine, or those that it had before. */
  toMachine: (file: string, back: boolean) => Promise<void>;
}

export function useWriting(): Writing {
  const { reload } = useProject();
  const [writes, change, notWritten] = useDo();
  const [sends, tell, notSent] = useDo();
  const [written, setWritten] = useState<Schemas["Written"]>();
  const [sent, setSent] = useState<Sent>();
  const reloading = (work: () => Promise<void>) => () => work().finally(reload);
  return {
    busy: writes || sends,
    notWritten,
    notSent,
    written,
    sent,
    write: (known) =>
      change(
        reloading(async () => {
          setSent(undefined);
          setWritten(await send<Schemas["Written"]>("POST", "correction", known));
        }),
      ),
    undo: (known) =>
      change(
        reloading(async () => {
          await send<Schemas["ProjectAnswer"]>("POST", "correction/undo", known);
          setWritten(undefined);
        }),
      ),
    toMachine: (file, back) =>
      tell(
        reloading(async () =>
          setSent(await send<Sent>("POST", back ? "machine/undo" : "machine/numbers", { file })),
        ),
      ),
  };
}

/** What the page knows of the folder, so that nothing it has not seen is overwritten. */
export function useKnown(): Known {
  const { project } = useProject();
  return {
    settings: project.files[project.choices.settings ?? ""] ?? "",
    choices: project.choices_digest,
  };
}
