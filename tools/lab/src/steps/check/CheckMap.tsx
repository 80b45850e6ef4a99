// Where the check marks are on the sheet.
import type { Schemas } from "../../api/client";
import { SheetMap, usePixel } from "../../sheet/SheetMap";
import { useProject } from "../../shell/project";

export function CheckMap({ answer }: { answer: Schemas["CheckAnswer"] }) {
  const { project } = useProject();
  const sheet = project.machine?.sheet ?? [2440, 1220];
  return (
    <div class="check-map">
      <SheetMap sheet={sheet} label="Where the two check marks are">
        {answer.places.map((place, index) => (
          <Cross key={place.join()} at={place} name={answer.marks[index]?.name ?? `${index + 1}`} />
        ))}
      </SheetMap>
    </div>
  );
}

function Cross({ at, name }: { at: readonly [number, number]; name: string }) {
  const pixel = usePixel();
  const [x, y] = [at[0], -at[1]];
  const arm = 9 * pixel;
  return (
    <g stroke="var(--act)" stroke-width={3 * pixel}>
      <line x1={x - arm} x2={x + arm} y1={y} y2={y} />
      <line x1={x} x2={x} y1={y - arm} y2={y + arm} />
      <text
        x={x + 1.4 * arm}
        y={y - 0.6 * arm}
        font-size={18 * pixel}
        fill="var(--ink)"
        stroke="none"
      >
        {name}
      </text>
    </g>
  );
}
