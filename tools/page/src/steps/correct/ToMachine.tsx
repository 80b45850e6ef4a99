// What was written, how to send it to the machine, and what the machine reports it holds now.
import type { Project } from "../../api/client";
import { Table } from "../../controls/Table";
import { isReady, useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Writing } from "./useWriting";

const SHOWN = 12;

interface ToMachineParts {
  writing: Writing;
  /** Whether the button of the screen sends the open file. */
  isNext: boolean;
  /** Whether the machine holds its numbers. */
  isHeld: boolean;
  /** The file that was sent last, if what the machine held before it is kept. */
  last: string;
}

export function ToMachine({ writing, isNext, isHeld, last }: ToMachineParts) {
  const { project } = useProject();
  const machine = useMachine();
  const { written, sent, busy } = writing;
  const file = fileToSend(project);
  if (!file && !last) return null;
  const connected = machine.kind !== "none";
  const steps = connected ? [] : (written?.steps ?? []);
  const canGiveBack = connected && last;
  if (isNext && steps.length === 0 && !canGiveBack && !sent) return null;
  return (
    <section class="to-machine" aria-label="To the machine">
      <h2>To the machine</h2>
      {steps.length > 0 && <p>By hand: {steps.join("; ")}.</p>}
      <p class="row">
        {!isNext && <ToSend {...{ writing, isHeld, last }} isNext={false} />}
        {canGiveBack && (
          <button
            type="button"
            disabled={busy || !isReady(machine)}
            onClick={() => void writing.toMachine(last, true)}
          >
            Give back its numbers from before {last}; nothing moves
          </button>
        )}
      </p>
      {!isNext && writing.notSent}
      {sent && (
        <>
          <p role="status">
            {sent.said} {sent.failure}
          </p>
          {sent.changed.length > 0 && (
            <p>The sled stands where it stood; its place reads otherwise with other numbers.</p>
          )}
          <Table rows={sent.changed.slice(0, SHOWN)} />
          {sent.changed.length > SHOWN && <p>and {sent.changed.length - SHOWN} more.</p>}
        </>
      )}
    </section>
  );
}

/** Connects the machine, sends it the open file, and then proves it. */
export function ToSend({ writing, isNext, isHeld, last }: ToMachineParts) {
  const { project } = useProject();
  const machine = useMachine();
  const file = fileToSend(project);
  const look = isNext ? "primary" : "";
  if (machine.kind === "none")
    return (
      <a class={`button ${look}`} href="#/open">
        Connect the machine, then send {file ?? last}
      </a>
    );
  if (!file) return null;
  if (isHeld)
    return (
      isNext && (
        <a class={`button ${look}`} href="#/prove">
          Prove it with two marks
        </a>
      )
    );
  return (
    <button
      type="button"
      class={look}
      disabled={writing.busy || !isReady(machine)}
      onClick={() => void writing.toMachine(file, false)}
    >
      Send {file} to {machine.name}; nothing moves
    </button>
  );
}

/** The open settings, if a machine can take them. */
function fileToSend({ choices }: Project): string | undefined {
  return choices.settings?.endsWith(".toml") ? choices.settings : undefined;
}
