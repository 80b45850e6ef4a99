// Step 5: cut the marks: save the program, or send it; hold and stop are in the bar.

import { type Schemas, send } from "../api/client";
import { Trouble } from "../controls/Trouble";
import { capital } from "../controls/words";
import { Do } from "../shell/doing";
import { useChoosing } from "../shell/kept";
import { isConnected, isReady, type Machine, useMachine } from "../shell/machine";
import { useNewest } from "../shell/newest";
import { useProject, useTell } from "../shell/project";
import { Screen } from "../shell/Screen";
import { TakeAlong } from "../shell/TakeAlong";
import { CutMap } from "./cut/CutMap";
import { useGoOn } from "./cut/GoOn";
import { NewSheet } from "./cut/NewSheet";
import { Outcome, Read, ToReadings } from "./cut/Outcome";
import { Pauses } from "./cut/Pauses";
import { Running } from "./cut/Running";
import { useSetChains } from "./cut/SetChains";
import "./cut/cut.css";

export type Grid = Schemas["GridAnswer"];

const CUTS = "Stay beside it. Hold pauses; Stop gives up.";
const CHOSEN =
  "Router off, hands and hoses away from the chains, the bit just above the wood. The sled moves over the whole sheet; the bit touches each mark 0.5 mm deep.";
const PROPOSED =
  "The verdict proposed these marks, on the same sheet. Router off, hands and hoses away from the chains, the bit just above the wood; it touches each mark 0.5 mm deep.";

export function Cut() {
  const { project } = useProject();
  // The program as it would be written now; asked again when a file or a choice is saved.
  const machine = useMachine();
  const outcome = machine.program?.outcome ?? "";
  const grid = useNewest<Grid>("grid", JSON.stringify([project.files, outcome, machine.name]));
  if (!grid) return <Screen title="Cut the marks" say="One moment …" busy />;
  return <OpenCut grid={grid} />;
}

function OpenCut({ grid }: { grid: Grid }) {
  const machine = useMachine();
  const next = nextOf(grid, machine);
  const [whichIsLast, goOn] = useGoOn({
    surely: grid.broke_off ?? 0,
    perhaps: grid.perhaps,
    names: grid.marks.map(({ name }) => name),
    path: "grid/go-on",
    blocked: grid.trouble !== "",
  });
  const [chains, setChains] = useSetChains();
  const acts = {
    wait: (
      <button type="button" disabled>
        Readings open after mark {grid.marks.at(-1)?.name}
      </button>
    ),
    connect: null,
    read: <Read grid={grid} />,
    chains: setChains,
    "go on": goOn,
    cut: <MoveAndCut grid={grid} isNext />,
    save: <Save grid={grid} isNext />,
    type: <ToReadings waits={grid.waits} isNext />,
  };
  const runs = next === "wait";
  return (
    <Screen
      title={
        runs ? running(machine) : `Cut ${grid.marks.length} ${grid.is_proposed ? "more " : ""}marks`
      }
      say={runs ? whileRunning(machine) : grid.is_proposed ? PROPOSED : CHOSEN}
      why={<Why />}
      command={grid.command}
      stage={<CutMap grid={grid} />}
      fieldsFirst={runs || next === "chains" || (next === "go on" && grid.perhaps > 0)}
      act={acts[next]}
    >
      <Trouble>{grid.trouble}</Trouble>
      {runs ? <Running grid={grid} machine={machine} /> : <Pauses grid={grid} />}
      <Outcome grid={grid} isRead={next === "read"} />
      {next === "chains" && chains}
      {next === "go on" && whichIsLast}
      {!runs && next !== "chains" && <Choice grid={grid} next={next} />}
      <TakeAlong name="marks.pdf">Save a sheet to print, for the readings</TakeAlong>
    </Screen>
  );
}

type Next = "wait" | "connect" | "read" | "chains" | "go on" | "cut" | "save" | "type";

/** What to do next: the screen's button does it, or one in the machine's bar. */
function nextOf(grid: Grid, machine: Machine): Next {
  const outcome = machine.program?.title === grid.program ? machine.program.outcome : undefined;
  if (outcome === "running") return "wait";
  if (outcome === "done" || grid.broke_off === grid.marks.length) return "read";
  if (machine.phase === "lost") return "connect";
  if (machine.kind === "none") return grid.is_proposed ? "type" : "save";
  if (!machine.knows_place) return "chains";
  return grid.goes_on ? "go on" : "cut";
}

function running({ waits_for, unseen }: Machine): string {
  if (unseen > 0) return "Nobody sees the machine";
  return waits_for ? "The machine waits for you" : "The machine is cutting";
}

function whileRunning({ waits_for, unseen }: Machine): string {
  if (unseen > 0) return "It may cut on. Look at it, with a hand on its power switch.";
  if (waits_for) return `${capital(waits_for)}. Then press Go on.`;
  return CUTS;
}

/** What else can be done. */
function Choice({ grid, next }: { grid: Grid; next: Next }) {
  const connected = isConnected(useMachine());
  return (
    <div class="row">
      {grid.last_form && !grid.is_proposed && <NewSheet grid={grid} />}
      {connected && next !== "cut" && <MoveAndCut grid={grid} />}
      {grid.is_proposed ? next !== "read" && <PutBack /> : next !== "save" && <Save grid={grid} />}
      <p class="soft">
        {grid.is_saved
          ? `${grid.program} and ${grid.form} are in your folder.`
          : `${grid.program} is the G-code, ${grid.form} the form for your readings.`}{" "}
        {!connected && (
          <>
            Or <a href="#/open">connect a machine</a> and cut from here.
          </>
        )}
      </p>
    </div>
  );
}

interface ButtonParts {
  grid: Grid;
  isNext?: boolean;
}

function MoveAndCut({ grid, isNext }: ButtonParts) {
  const { reload } = useProject();
  const machine = useMachine();
  const blocked = useChoosing() || !isReady(machine) || grid.trouble !== "";
  return (
    <Do isNext={isNext} disabled={blocked} work={() => send("POST", "grid/cut").then(reload)}>
      {beginWords(grid, machine)} the sled and cut {grid.marks.length} marks
    </Do>
  );
}

function Save({ grid, isNext }: ButtonParts) {
  const tell = useTell();
  const blocked = useChoosing() || grid.trouble !== "";
  return (
    <Do isNext={isNext} disabled={blocked} work={() => tell("grid")}>
      {grid.is_saved ? `Saved: ${grid.program}` : `Save ${grid.program}; nothing moves`}
    </Do>
  );
}

function PutBack() {
  const tell = useTell();
  return (
    <Do disabled={useChoosing()} work={() => tell("next", undefined, "DELETE")}>
      Cut other marks instead
    </Do>
  );
}

/** Beginning again on the same sheet would cut the finished marks twice. */
function beginWords({ broke_off, perhaps, is_proposed }: Grid, { kind }: Machine): string {
  if (broke_off == null) return "Move";
  if (kind === "virtual" || broke_off + perhaps === 0) return "Begin again: move";
  return is_proposed
    ? "Cut what is there a second time: move"
    : "Begin again on a fresh sheet: move";
}

function Why() {
  return (
    <>
      <p>
        The bit comes to each mark from below and only touches the wood: a scratch that a tape can
        find. Chains give and rub, so a mark that is always reached from the same side can be
        trusted.
      </p>
      <p>
        Before anything is sent, each place on the way is checked: chains neither too tight nor too
        slack, and the bit never off the sheet.
      </p>
    </>
  );
}
