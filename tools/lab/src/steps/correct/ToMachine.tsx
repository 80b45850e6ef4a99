// What was written, how it comes into the machine, and what the machine says that it holds now.
import { isReady, useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import { lastSent } from "./kept";
import type { Writing } from "./useWriting";

const SHOWN = 12;

interface ToMachineParts {
  writing: Writing;
  /** Whether sending is what comes next. */
  isNext: boolean;
}

export function ToMachine({ writing, isNext }: ToMachineParts) {
  const { project } = useProject();
  const machine = useMachine();
  const { written, sent, busy } = writing;
  const settings = project.choices.settings ?? "";
  const file = settings.endsWith(".toml") ? settings : undefined;
  const last = lastSent(Object.keys(project.files));
  if (!file && !last) return null;
  const connected = machine.kind !== "none";
  return (
    <section class="to-machine" aria-label="To the machine">
      <h2>To the machine</h2>
      {written && (
        <p role="status">
          Written: {written.files.join(", ")}. {written.failure}
        </p>
      )}
      {!connected && (
        <p>
          No machine is connected. <a href="#/open">Connect it</a>
          {written && written.steps.length > 0 && `, or by hand: ${written.steps.join("; ")}`}.
        </p>
      )}
      {connected && (
        <p class="buttons">
          {file && (
            <button
              type="button"
              class={isNext && !sent ? "primary" : ""}
              disabled={busy || !isReady(machine)}
              onClick={() => void writing.toMachine(file, false)}
            >
              Write {file} into {machine.name}; nothing moves
            </button>
          )}
          {last && (
            <button
              type="button"
              disabled={busy || !isReady(machine)}
              onClick={() => void writing.toMachine(last, true)}
            >
              Give back its numbers from before {last}; nothing moves
            </button>
          )}
        </p>
      )}
      {sent && (
        <>
          <p role="status">
            {sent.changed.length === 0
              ? "The machine held these numbers already; each was read back."
              : `The machine holds ${sent.changed.length} ${sent.back ? "old" : "new"} numbers; each was read back. Those before are in ${sent.kept}.`}{" "}
            {sent.failure}
          </p>
          {sent.changed.length > 0 && (
            <p>The sled stands where it stood; its place reads otherwise with other numbers.</p>
          )}
          {!sent.back && (
            <p>
              <a class="button primary" href="#/check">
                Check it with two marks
              </a>
            </p>
          )}
          <table>
            <tbody>
              {sent.changed.slice(0, SHOWN).map((number) => (
                <tr key={number.number}>
                  <th scope="row">
                    {number.name || "number"} (${number.number})
                  </th>
                  <td>
                    {shown(number.before)} → {shown(number.after)} {number.unit}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
          {sent.changed.length > SHOWN && <p>and {sent.changed.length - SHOWN} more.</p>}
        </>
      )}
    </section>
  );
}

function shown(value: number): string {
  return String(Number(value.toPrecision(6)));
}
