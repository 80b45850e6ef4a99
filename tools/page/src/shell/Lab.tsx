// The lab: the steps at the side, the screen in the middle, errors on top.
import { useEffect, useRef, useState } from "preact/hooks";
import type { Schemas } from "../api/client";
import { isPhone } from "../api/here";
import { Trouble } from "../controls/Trouble";
import { Header } from "./Header";
import { Held } from "./Held";
import { MachineBar } from "./MachineBar";
import { type LiveMachine, MachineContext, useLiveMachine } from "./machine";
import { Pair } from "./Pair";
import { useProject, useSharedProject } from "./project";
import { Screen as Framed } from "./Screen";
import { Shares } from "./Shares";
import { StopFailed } from "./StopFailed";
import { ROOMS, STEPS, type Step } from "./steps";
import { Way, WayOn } from "./Way";
import { useWatched } from "./watched";

/** Shown for an unknown address. */
const NOWHERE: Step = {
  id: "nowhere",
  title: "No such screen",
  Screen: () => (
    <Framed title="No such screen" say="The address names no screen of the lab.">
      <a class="go" href="#/open">
        To the machine
      </a>
    </Framed>
  ),
  needs: () => "",
};

/** The screen's id after # in the address; after a further / comes a place on that screen. */
function useAddress(): string {
  const [id, setId] = useState(idInAddress);
  useEffect(() => {
    const changed = () => setId(idInAddress());
    addEventListener("hashchange", changed);
    return () => removeEventListener("hashchange", changed);
  }, []);
  return id;
}

function idInAddress(): string {
  return location.hash.replace(/^#\/?/, "").split("/")[0] ?? "";
}

export function Lab() {
  const loaded = useSharedProject();
  const { shared, trouble } = loaded;
  const id = useAddress();
  const live = useLiveMachine();
  if (loaded.isStranger) return <Pair paired={loaded.reload} />;
  if (!shared) {
    return <main>{trouble ? <p role="alert">{trouble}</p> : <p>Loading …</p>}</main>;
  }
  const first = STEPS.find((each) => each.id === (isPhone ? "readings" : "open")) as Step;
  const step = id === "" ? first : ([...STEPS, ...ROOMS].find((each) => each.id === id) ?? NOWHERE);
  return (
    <Shares shared={shared}>
      <MachineContext.Provider value={live.machine}>
        <Header />
        <MachineBar live={live} />
        <Way project={shared.project} here={step.id} />
        <Main {...{ step, live }} />
      </MachineContext.Provider>
    </Shares>
  );
}

function Main({ step, live }: { step: Step; live: LiveMachine }) {
  const { project, trouble } = useProject();
  const missing = step.needs(project);
  const place = useRef<HTMLElement>(null);
  const first = useRef(true);
  useEffect(() => {
    document.title = `${step.title} · ${project.folder} · Plumb`;
    // Keyboard and screen reader users go on at the new screen.
    if (!first.current) {
      place.current?.focus({ preventScroll: true });
      scrollTo(0, 0);
      place.current?.scrollTo(0, 0);
    }
    first.current = false;
  }, [step.title, project.folder]);
  const { Screen } = step;
  return (
    <main ref={place} id="screen" tabIndex={-1}>
      <div class="above">
        <StopFailed live={live} />
        <Trouble>{trouble || project.trouble}</Trouble>
        {isPhone && <Hands />}
        <Held />
      </div>
      {missing ? (
        <Framed title={step.title} say={`This screen opens later: ${missing}.`} />
      ) : (
        <Screen key={step.id} />
      )}
      <WayOn project={project} here={step.id} />
    </main>
  );
}

/** On a phone: what it may do, if not everything. */
function Hands() {
  const { state: me } = useWatched<Schemas["Phone"] | null>("phones/me");
  if (!me || me.may_move) return null;
  return (
    <p class="hands soft" role="status">
      {me.name} {me.may}. On the computer you can let it move the machine too.
    </p>
  );
}
