// What to do next with a round of marks, whoever proposed them: save it, cut it, go on with it, read it.
import { send } from "../../api/client";
import { Trouble } from "../../controls/Trouble";
import { capital } from "../../controls/words";
import { Do } from "../../shell/doing";
import { useChoosing } from "../../shell/kept";
import { isConnected, isReady, type Machine, useMachine } from "../../shell/machine";
import { useNewest } from "../../shell/newest";
import { useProject, useTell } from "../../shell/project";
import { useGoOn } from "./GoOn";
import { NewSheet } from "./NewSheet";
import { Outcome, Read, ToReadings } from "./Outcome";
import { Pauses, Running } from "./Running";
import { isCut, outcomeOf, type Round, type RoundParts } from "./round";
import { useSetChains } from "./SetChains";
import "./cut.css";

/** An answer with a round, as it would be written now; asked again when a file, a choice or the machine changes. */
export function useRoundOf<Answer>(path: string): Answer | undefined {
  const machine = useMachine();
  const { files } = useProject().project;
  const state = [files, machine.program?.outcome ?? "", machine.name, isConnected(machine)];
  return useNewest<Answer>(path, JSON.stringify(state));
}

function pathOf({ origin }: Round): string {
  return origin === "proof" ? "rounds/proof" : "rounds/marks";
}

/** The screen's button, its fields, and while the round is cut, what the screen is called and says. */
export function useCutting(round: Round) {
  const machine = useMachine();
  const next = nextOf(round, machine);
  const [whichIsLast, goOn] = useGoOn(round, `${pathOf(round)}/go-on`);
  const [chains, setChains] = useSetChains();
  const acts = {
    wait: (
      <button type="button" disabled>
        Readings open after mark {round.marks.at(-1)?.name}
      </button>
    ),
    connect: null,
    read: <Read round={round} />,
    chains: setChains,
    "go on": goOn,
    cut: <MoveAndCut round={round} isNext />,
    save: <Save round={round} isNext />,
    type: <ToReadings round={round} isNext />,
  };
  const runs = next === "wait";
  const fields = (
    <>
      <Trouble>{round.trouble}</Trouble>
      {runs ? <Running round={round} machine={machine} /> : <Pauses round={round} />}
      <Outcome round={round} isNext={next === "read"} />
      {next === "chains" && chains}
      {next === "go on" && whichIsLast}
      {!runs && next !== "chains" && <Choice round={round} next={next} />}
    </>
  );
  return {
    act: acts[next],
    fields,
    fieldsFirst: runs || next === "chains" || (next === "go on" && round.perhaps > 0),
    running: runs ? whileRunning(machine) : undefined,
  };
}

type Next = "wait" | "connect" | "read" | "chains" | "go on" | "cut" | "save" | "type";

/** What to do next: the screen's button does it, or one in the machine's bar. */
function nextOf(round: Round, machine: Machine): Next {
  if (outcomeOf(round, machine) === "running") return "wait";
  if (isCut(round, machine)) return "read";
  if (machine.phase === "lost") return "connect";
  if (machine.kind === "none")
    return round.origin === "chosen" || !round.is_saved ? "save" : "type";
  if (!machine.knows_place) return "chains";
  return round.goes_on ? "go on" : "cut";
}

function whileRunning({ waits_for, unseen }: Machine): { title: string; say: string } {
  const [title, say] =
    unseen > 0
      ? ["Nobody sees the machine", "It may cut on. Look at it, with a hand on its power switch."]
      : waits_for
        ? ["The machine waits for you", `${capital(waits_for)}. Then press Go on.`]
        : ["The machine is cutting", "Stay beside it. Hold pauses; Stop gives up."];
  return { title, say };
}

/** What else can be done. */
function Choice({ round, next }: RoundParts & { next: Next }) {
  const tell = useTell();
  const choosing = useChoosing();
  const connected = isConnected(useMachine());
  const { origin, last_form, is_saved, program, form } = round;
  return (
    <div class="row">
      {last_form && origin === "chosen" && <NewSheet round={round} />}
      {connected && next !== "cut" && <MoveAndCut round={round} />}
      {origin !== "proposed" && next !== "save" && next !== "type" && <Save round={round} />}
      {origin === "proposed" && next !== "read" && (
        <Do disabled={choosing} work={() => tell("next", undefined, "DELETE")}>
          Cut other marks instead
        </Do>
      )}
      <p class="soft">
        {is_saved
          ? `${program} and ${form} are in your folder.`
          : `${program} is the G-code, ${form} the form for your readings.`}{" "}
        {!connected && (
          <>
            Or <a href="#/open">connect a machine</a> and cut from here.
          </>
        )}
      </p>
    </div>
  );
}

function MoveAndCut({ round, isNext }: RoundParts) {
  const { reload } = useProject();
  const machine = useMachine();
  const blocked = useChoosing() || !isReady(machine) || round.trouble !== "";
  const work = () => send("POST", `${pathOf(round)}/cut`).then(reload);
  return (
    <Do isNext={isNext} disabled={blocked} work={work}>
      {round.begins} the sled and cut {round.marks.length} marks
    </Do>
  );
}

function Save({ round, isNext }: RoundParts) {
  const tell = useTell();
  const blocked = useChoosing() || round.trouble !== "";
  return (
    <Do isNext={isNext} disabled={blocked} work={() => tell(pathOf(round))}>
      {round.is_saved ? `Saved: ${round.program}` : `Save ${round.program}; nothing moves`}
    </Do>
  );
}
