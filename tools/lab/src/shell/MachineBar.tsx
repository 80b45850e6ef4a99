// The machine's line, in view on all screens: where the sled is, what it does, Hold and Stop.
import { useEffect } from "preact/hooks";
import { send } from "../api/client";
import { namedLength } from "../controls/lengths";
import { isReady, type Machine, subject, useMachine } from "./machine";
import { useProject } from "./project";
import "./machine-bar.css";

export function MachineBar() {
  const machine = useMachine();
  const { project, setTrouble } = useProject();
  const press = (way: "hold" | "go-on" | "stop") =>
    send("POST", `machine/${way}`).catch((error: Error) => setTrouble(error.message));
  const runs = machine.moves || machine.phase === "busy";
  const works = machine.kind !== "none" && machine.phase !== "lost";
  useEffect(() => {
    if (!works || !runs) return;
    const pressed = (event: KeyboardEvent) => {
      if (event.key === "Escape" && !event.repeat) void press("hold");
    };
    addEventListener("keydown", pressed);
    return () => removeEventListener("keydown", pressed);
  });
  if (machine.kind === "none") return null;
  const program = machine.program;
  const share = program?.outcome === "running" ? program.done / Math.max(1, program.total) : null;
  return (
    <section class={`machine-bar ${tone(machine)}`} aria-label="The machine">
      <p class="state" role="status">
        <strong>{stateWords(machine)}</strong>
        {machine.place && machine.knows_place && (
          <span class="place">{placeWords(machine.place, project.choices.units ?? "mm")}</span>
        )}
      </p>
      {works && (
        <p class="presses">
          {machine.holds ? (
            <button
              type="button"
              class={machine.waits_for ? "primary" : ""}
              onClick={() => void press("go-on")}
            >
              Go on
            </button>
          ) : (
            <button type="button" title="Also the key Escape" onClick={() => void press("hold")}>
              Hold
            </button>
          )}
          <button type="button" class="stop" onClick={() => void press("stop")}>
            Stop
          </button>
        </p>
      )}
      {share !== null && (
        <progress value={share} aria-label={`${program?.title} so far`}>
          {Math.round(share * 100)} %
        </progress>
      )}
      {machine.waits_for && (
        <p class="waits-for" role="alert">
          Before you press Go on: {machine.waits_for}.
        </p>
      )}
      {machine.trouble && <p class="said">{machine.trouble}</p>}
      {!machine.knows_place && (
        <p class="said">Where the sled is, is not known until you set its chains.</p>
      )}
    </section>
  );
}

function tone(machine: Machine): string {
  if (machine.phase === "lost" || !machine.knows_place) return "bad";
  return machine.moves || machine.phase === "busy" ? "moves" : "";
}

/** What the machine does, in a few words. */
function stateWords(machine: Machine): string {
  const { phase, program } = machine;
  const name = subject(machine);
  if (phase === "lost") return `${name}: the line is lost`;
  if (phase === "connecting") return `${name}: connecting`;
  if (phase === "stopping") return `${name} stops`;
  if (machine.waits_for) return `${name} waits for you`;
  if (machine.holds) return `${name} holds`;
  if (phase === "busy" && program?.outcome === "running")
    return `${name} runs ${program.title}: ${program.done} of ${program.total} lines`;
  if (machine.moves) return `${name} moves`;
  return isReady(machine) ? `${name} stands` : `${name} works`;
}

function placeWords([x, y, z]: readonly [number, number, number], unit: "mm" | "inch"): string {
  return ` x ${namedLength(x, unit)}, y ${namedLength(y, unit)}, z ${namedLength(z, unit)}`;
}
