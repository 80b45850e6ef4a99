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
import { Outcome, Read, ToReadings } from "./Outcome";
import { isCut, marksBefore, minutesAt, outcomeOf, type Round, type RoundParts } from "./round";
import { useSetChains } from "./SetChains";

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

/** What the screen says while the machine is at work; the lab may be silent too. */
function whileRunning({ at_work, unseen }: Machine) {
  if (unseen === 0) return at_work;
  const say = "It may cut on. Look at it, with a hand on its power switch.";
  return { title: "Nobody sees the machine", say };
}

/** What else can be done. */
function Choice({ round, next }: RoundParts & { next: Next }) {
  const tell = useTell();
  const { project, choose } = useProject();
  const isNew = project.choices.new_sheet ?? false;
  const choosing = useChoosing();
  const connected = isConnected(useMachine());
  const { origin, last_form } = round;
  return (
    <div class="row">
      {last_form && origin === "chosen" && (
        <label class="tick">
          <input
            type="checkbox"
            checked={isNew}
            onChange={({ currentTarget: { checked } }) => choose({ new_sheet: checked })}
          />
          <span>
            On another sheet than {last_form}
            {isNew && <small>{round.next_sheet}</small>}
          </span>
        </label>
      )}
      {connected && next !== "cut" && <MoveAndCut round={round} />}
      {origin !== "proposed" && next !== "save" && next !== "type" && <Save round={round} />}
      {origin === "proposed" && next !== "read" && (
        <Do disabled={choosing} work={() => tell("next", undefined, "DELETE")}>
          Cut other marks instead
        </Do>
      )}
      <p class="soft">
        {round.files_said}{" "}
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

/** How far a cut is that runs, and where it waits for you next. */
function Running({ round, machine }: { round: Round; machine: Machine }) {
  const { program, kind } = machine;
  const [lines, total] = [program?.done ?? 0, program?.total ?? 1];
  const left = Math.ceil(minutesAt(round, total) - minutesAt(round, lines));
  const pause = round.pauses.find((each) => each.lines > lines);
  return (
    <>
      <p class="soft">
        <output class="large">{marksBefore(round, lines)}</output> of {round.marks.length} marks
        {/* A virtual machine is as fast as it was asked to be. */}
        {kind === "board" && left > 0 && `, ${left} min left`}
      </p>
      {pause && (
        <p>
          The next pause comes after mark {marksBefore(round, pause.lines)}: {pause.do}.
        </p>
      )}
    </>
  );
}

function Pauses({ round }: { round: Round }) {
  if (round.pauses.length === 0) return null;
  return (
    <div class="pauses">
      <p>The program waits until you press Go on:</p>
      <ol>
        {round.pauses.map((pause) => (
          <li key={pause.lines}>{capital(pause.do)}.</li>
        ))}
      </ol>
    </div>
  );
}
