// Step 4: choose how to measure, and see what the marks could tell before a hole is cut.
import { type Schemas, send } from "../api/client";
import { Segments } from "../controls/Segments";
import { Trouble } from "../controls/Trouble";
import { useAsked } from "../shell/asked";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { MarksMap, type Place } from "./measure/MarksMap";

type Layout = Schemas["LayoutAnswer"];

const MOMENT_MS = 250; // after a plan was changed

export function Measure() {
  const { project, choose } = useProject();
  const { settings = "" } = project.choices;
  const layouts = useNewest<Layout[]>(settings && "layouts", settings) ?? [];
  const advice = useNewest<Schemas["AdviceAnswer"]>(settings && "layouts/advice", settings);
  const saved: Place[] = project.choices.planned ?? [];
  const id = project.choices.layout ?? "nine";
  const chosen = layouts.find((layout) => layout.id === id);
  const places = id === "own" ? saved : (chosen?.places ?? []);
  const asked = { layout: id, places: id === "own" ? places : [] };
  const preview = () => send<Schemas["PlanAnswer"]>("POST", "preview", asked);
  const state = JSON.stringify([asked, settings]);
  const { answer: plan, refused, looking } = useAsked(preview, state, MOMENT_MS);
  if (layouts.length === 0 || !project.machine)
    return <Screen title="Which marks?" say="One moment …" busy />;
  const keep = (planned: Place[]) => choose({ layout: "own", planned, proposed: "" });
  const take = (layout: Layout["id"]) => {
    const planned = layout === "own" && saved.length === 0 ? places : saved;
    choose({ layout, planned, proposed: "" });
  };
  const own = id === "own" || saved.length === 0 ? places : saved;
  const better = layouts.find((layout) => layout.id === advice?.layout && layout.id !== id);
  return (
    <Screen
      title="Which marks?"
      say="More marks tell more causes apart, and take longer. Nothing is cut yet."
      why={<Why />}
      command={plan?.command ?? `plumb grid --settings ${project.choices.settings} --details`}
      stage={<MarksMap places={places} keep={keep} />}
      act={
        better && (
          <>
            <button type="button" class="primary" onClick={() => take(better.id)}>
              Take {better.title.toLowerCase()}, {Math.round(better.minutes)} minutes
            </button>
            <a class="go" href="#/cut">
              Keep these
            </a>
          </>
        )
      }
    >
      <p class="advised" role="status" aria-busy={!advice || undefined}>
        {advice ? (
          <>
            <strong>Recommended.</strong> {advice.sentence}
          </>
        ) : (
          "Working out which marks to recommend …"
        )}
      </p>
      <Segments
        class="layouts"
        legend="How to measure"
        chosen={id}
        choose={take}
        // Your own choice is always there, so that the sheet does not move under the finger that drags a mark.
        options={[...layouts, { id: "own" as const, title: "Your choice", minutes: 0 }].map(
          (each) => [
            each.id,
            <>
              <b>{each.title}</b>{" "}
              <small>
                {each.minutes > 0 ? `about ${Math.round(each.minutes)} min` : `${own.length} marks`}
              </small>
            </>,
          ],
        )}
      />
      <Trouble>{refused || plan?.trouble}</Trouble>
      {!plan && !refused && (
        <p class="sum" role="status" aria-busy>
          Working out what these marks could tell …
        </p>
      )}
      {plan && (
        <>
          <p class="sum" role="status" aria-busy={looking}>
            <strong>About {Math.round(plan.minutes)} minutes.</strong> {plan.sentence}
            {looking && " Working …"}
          </p>
          <EffectList causes={plan.causes} />
        </>
      )}
    </Screen>
  );
}

function Why() {
  return (
    <p>
      Each effect pushes marks in a pattern of its own. Where two patterns look alike at your marks,
      no arithmetic can tell which it was. Marks at other places, or a weight on the sled, can.
    </p>
  );
}

/** Each cause under the plan: it would be named, would look like another, or would stay hidden. */
function EffectList({ causes }: { causes: Schemas["PlannedCause"][] }) {
  return (
    <details>
      <summary>Each cause by itself</summary>
      <ul class="tiles plain" aria-label="What these marks could tell">
        {causes.map(({ noun, said: [sign, words] }) => (
          <li key={noun} class="box">
            <b>
              <span aria-hidden="true">{sign}</span> {noun}
            </b>
            <small>{words}</small>
          </li>
        ))}
      </ul>
    </details>
  );
}
