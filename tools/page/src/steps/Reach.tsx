// Step 3: where on the sheet the machine can cut, and how far off is normal before it is corrected.
import type { Schemas } from "../api/client";
import type { Mark } from "../sheet/marks";
import { Sheet } from "../sheet/Sheet";
import { useScale } from "../sheet/scale";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import "./reach.css";

type Answer = Schemas["ReachAnswer"];
/** For each verdict its class on the map, and its meaning. */
const MEANING: [string, string][] = [
  ["usable", "usable"],
  ["tight", "too tight: a chain pulls harder than its gearbox likes"],
  ["slack", "too slack: a chain hangs loose, and the sled follows late"],
  ["vertical", "too vertical: the chains hold the sled hardly at all sideways"],
  ["nowhere", "no sled hangs here, or its ring meets a motor"],
];

export function Reach() {
  const { project } = useProject();
  const { settings = "" } = project.choices;
  // Choices count once the server has them.
  const state = `${project.files[settings]} ${project.choices_digest}`;
  const reach = useNewest<Answer>("reach", state);
  if (!reach || !project.machine)
    return <Screen title="Reach" say="The sheet is looked over …" busy />;
  return (
    <Screen
      title={`${reach.conclusion.replace(/;.*|\.$/s, "")}.`}
      say={reach.normal}
      why={<Why reach={reach} />}
      command={reach.command}
      stage={
        <div>
          <Sheet label={`Where the machine is usable: ${reach.conclusion}`} marks={spotsOf(reach)}>
            <Places reach={reach} sheet={project.machine.sheet} />
          </Sheet>
          <ul class="plain">
            {MEANING.map(([tone, words], verdict) => {
              const share = reach.shares[reach.words[verdict] ?? ""];
              return reach.verdicts.includes(verdict) ? (
                <li key={tone}>
                  <span class={`swatch ${tone}`} />
                  <span>
                    {share}: {words}
                  </span>
                </li>
              ) : null;
            })}
          </ul>
        </div>
      }
    />
  );
}

function Places({ reach, sheet }: { reach: Answer; sheet: readonly [number, number] }) {
  const { at, px } = useScale();
  const [wide, high] = [sheet[0] / reach.columns, sheet[1] / reach.rows];
  return (
    <g class="reached">
      {reach.verdicts.map((verdict, index) => {
        const [tone] = MEANING[verdict] ?? MEANING[0] ?? ["usable"];
        const row = Math.floor(index / reach.columns);
        const [x, y] = at([
          -sheet[0] / 2 + (index % reach.columns) * wide,
          sheet[1] / 2 - row * high,
        ]);
        return <rect key={index} class={tone} x={x} y={y} width={wide * px} height={high * px} />;
      })}
    </g>
  );
}

/** The extreme places, without duplicates. */
function spotsOf(reach: Answer): Mark[] {
  const spots = new Map<string, Mark>();
  for (const { place, title } of reach.extremes) {
    const before = spots.get(place.join());
    spots.set(place.join(), {
      target: place,
      name: before ? `${before.name}, ${title}` : title,
      look: "planned",
    });
  }
  return [...spots.values()];
}

function Why({ reach }: { reach: Answer }) {
  return (
    <>
      <ul>
        {reach.extremes.map((extreme) => (
          <li key={extreme.title}>
            {extreme.title}
            {extreme.side && `, ${extreme.side}`}:{" "}
            {extreme.value.toFixed(extreme.value < 1 ? 2 : 0)} {extreme.unit}
          </li>
        ))}
      </ul>
      {reach.assumed.map((sentence) => (
        <p key={sentence}>{sentence}</p>
      ))}
      <p>
        How far off is normal follows from how well each number is known, and from what effects in
        their usual size would do.
      </p>
    </>
  );
}
