// The machine, in view on all screens: where the sled is, what it does, Hold and Stop. In the head of a wide page, and
// at the foot of a narrow one, near the thumb.
import { useEffect, useState } from "preact/hooks";
import { send } from "../api/client";
import { useUnits } from "../controls/lengths";
import { useDo } from "./doing";
import { type LiveMachine, type Machine, placeWords } from "./machine";
import { Ports } from "./Ports";
import type { Press } from "./presses";
import "./machine-bar.css";

const UNREACHABLE = "Cannot reach the machine: use its power switch";

export function MachineBar({ live }: { live: LiveMachine }) {
  const { machine, presses, press } = live;
  const units = useUnits();
  const [, run, refusal] = useDo();
  const goOn = () => {
    presses.giveUp();
    void run(() => send("POST", "machine/go-on"));
  };
  const unseen = machine.unseen > 0;
  const runs = machine.moves || machine.phase === "busy";
  const works = machine.kind !== "none" && machine.phase !== "lost";
  useEffect(() => {
    if (!works || !runs) return;
    const pressed = (event: KeyboardEvent) => {
      if (event.key === "Escape" && !event.repeat) void presses.press("hold");
    };
    addEventListener("keydown", pressed);
    return () => removeEventListener("keydown", pressed);
  });
  const place = useHeight();
  if (machine.kind === "none") return null;
  const program = machine.program;
  const share = program?.outcome === "running" ? program.done / Math.max(1, program.total) : null;
  return (
    <section ref={place} class={`machine-bar ${tone(machine)}`} aria-label="The machine">
      <div class="line">
        <p class={unseen ? "state old" : "state"}>
          <strong role="status">{unseen ? `${machine.subject}: last seen` : machine.doing}</strong>
          <strong>{countWords(machine)}</strong>
          {machine.place && machine.knows_place && (
            <span class="place soft">{placeWords(machine.place, units)}</span>
          )}
        </p>
        {works && (
          <p class="presses row">
            {machine.holds ? (
              <button
                type="button"
                class={machine.waits_for ? "primary" : ""}
                disabled={unseen}
                onClick={goOn}
              >
                Go on
              </button>
            ) : (
              <button
                type="button"
                title="Also the key Escape"
                disabled={unseen}
                onClick={() => void presses.press("hold")}
              >
                Hold
              </button>
            )}
            <button
              type="button"
              class={unseen ? "stop again" : "stop"}
              onClick={() => void presses.press("stop")}
            >
              {unseen ? "Try Stop again" : "Stop"}
            </button>
          </p>
        )}
      </div>
      {share !== null && !unseen && (
        <progress value={share} aria-label={`${program?.title} so far`}>
          {Math.round(share * 100)} %
        </progress>
      )}
      <div class="words row">
        {machine.phase === "lost" && machine.kind === "board" && <Ports lost={machine.name} />}
        {machine.phase === "lost" && <p class="said">{UNREACHABLE}.</p>}
        {refusal}
        <p class="pressed" role="status">
          {press && pressWords(press)}
        </p>
        {machine.waits_for && (
          <p class="waits-for" role="alert">
            Before you press Go on: {machine.waits_for}.
          </p>
        )}
        {machine.trouble && <p class="said">{machine.trouble}</p>}
        {!machine.knows_place && (
          <p class="said unplaced">Where the sled is, is not known until you set its chains.</p>
        )}
      </div>
    </section>
  );
}

/** Sets the bar's height as a style, so that it covers nothing. */
function useHeight() {
  const [bar, place] = useState<HTMLElement | null>(null);
  useEffect(() => {
    const lab = bar?.parentElement;
    if (!bar || !lab) return;
    const watch = new ResizeObserver(() => lab.style.setProperty("--bar", `${bar.offsetHeight}px`));
    watch.observe(bar);
    return () => {
      watch.disconnect();
      lab.style.removeProperty("--bar");
    };
  }, [bar]);
  return place;
}

function pressWords({ way, state, line }: Press): string {
  const name = way === "stop" ? "Stop" : "Hold";
  if (state === "done") return `${name} was passed on to the machine.`;
  if (state === "refused") return `${name} was refused: ${line}.`;
  // Of a stop that nobody answers the page itself speaks.
  return state === "unanswered" && way === "hold"
    ? "Nobody answers Hold; it is sent again and again."
    : "";
}

function tone(machine: Machine): string {
  if (machine.unseen) return "bad";
  if (machine.phase === "lost" || !machine.knows_place) return "bad";
  return machine.moves || machine.phase === "busy" ? "moves" : "";
}

/** The progress, which changes many times a second: shown, but not read aloud. */
function countWords({ unseen, holds, phase, program }: Machine): string {
  if (unseen > 0) return ` ${unseen} s ago`;
  if (holds || phase !== "busy" || program?.outcome !== "running") return "";
  return `: ${program.done} of ${program.total} lines`;
}
