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
/** The colour of each sign of the map: of Okabe and Ito, and as light or dark as grey keeps apart. */
const TONES: Record<string, string> = {
  ".": "light-dark(#cfeadf, #123c31)", // usable
  T: "light-dark(#d55e00, #e8803a)", // tight
  S: "light-dark(#56b4e9, #3f8fc0)", // slack
  V: "light-dark(#f0e442, #b9ae25)", // vertical
  "#": "light-dark(#3a3f42, #000000)", // out of reach
};

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
      {...reach.heading}
      why={<Why reach={reach} />}
      command={reach.command}
      stage={
        <div>
          <Sheet label={`Where the machine is usable: ${reach.conclusion}`} marks={spotsOf(reach)}>
            <Places reach={reach} sheet={project.machine.sheet} />
          </Sheet>
          <ul class="plain">
            {reach.legend.map(({ sign, share, meaning }) => (
              <li key={sign}>
                <span class="swatch" style={{ background: TONES[sign] }} />
                <span>
                  {share}: {meaning}
                </span>
              </li>
            ))}
          </ul>
        </div>
      }
    />
  );
}

function Places({ reach, sheet }: { reach: Answer; sheet: readonly [number, number] }) {
  const { at, px } = useScale();
  const columns = reach.map[0]?.length ?? 1;
  const [wide, high] = [sheet[0] / columns, sheet[1] / reach.map.length];
  return (
    <g shape-rendering="crispEdges">
      {[...reach.map.join("")].map((sign, index) => {
        const row = Math.floor(index / columns);
        const [x, y] = at([-sheet[0] / 2 + (index % columns) * wide, sheet[1] / 2 - row * high]);
        return (
          <rect key={index} fill={TONES[sign]} x={x} y={y} width={wide * px} height={high * px} />
        );
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
