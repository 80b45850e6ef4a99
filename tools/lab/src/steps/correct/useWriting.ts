// Writes the accepted numbers into a file, sends a file to the machine, and takes either back.
import { useState } from "preact/hooks";
import { type Schemas, send } from "../../api/client";
import { useProject } from "../../shell/project";

export type CorrectionAnswer = Schemas["CorrectionAnswer"];
export type Known = Schemas["Write"];
export type Sent = Schemas["NumbersAnswer"];

export interface Writing {
  busy: boolean;
  written: Schemas["Written"] | undefined;
  sent: Sent | undefined;
  write: (known: Known) => Promise<void>;
  undo: (known: Known) => Promise<void>;
  /** Sends the numbers of a file to the machine, or those that it had before. */
  toMachine: (file: string, back: boolean) => Promise<void>;
}

export function useWriting(): Writing {
  const { reload, setTrouble } = useProject();
  const [busy, setBusy] = useState(false);
  const [written, setWritten] = useState<Schemas["Written"]>();
  const [sent, setSent] = useState<Sent>();
  const doing = async (work: () => Promise<void>) => {
    setBusy(true);
    try {
      await work();
      setTrouble("");
    } catch (error) {
      setTrouble(error instanceof Error ? error.message : String(error));
    }
    await reload();
    setBusy(false);
  };
  return {
    busy,
    written,
    sent,
    write: (known) =>
      doing(async () => {
        setSent(undefined);
        setWritten(await send<Schemas["Written"]>("POST", "correction", known));
      }),
    undo: (known) =>
      doing(async () => {
        await send<Schemas["Undone"]>("POST", "correction/undo", known);
        setWritten(undefined);
      }),
    toMachine: (file, back) =>
      doing(async () =>
        setSent(await send<Sent>("POST", back ? "machine/undo" : "machine/numbers", { file })),
      ),
  };
}
