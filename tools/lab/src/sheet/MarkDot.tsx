// A mark that is planned: a dot with its number, large enough to see at arm's length.
import { usePixel } from "./SheetMap";

const SHORT = 4; // letters; a longer name begins or ends at its mark, so that it stays on the sheet

interface DotParts {
  place: readonly [number, number]; // [mm] machine frame
  name: string;
  colour?: string;
  /** A ring without filling: not cut yet. */
  hollow?: boolean;
}

export function MarkDot({ place, name, colour = "var(--act)", hollow = false }: DotParts) {
  const pixel = usePixel();
  const [x, y] = [place[0], -place[1]];
  return (
    <g>
      <circle
        cx={x}
        cy={y}
        r={6 * pixel}
        fill={hollow ? "var(--paper)" : colour}
        stroke={colour}
        stroke-width={2 * pixel}
      />
      <text
        x={x}
        y={y - 11 * pixel}
        font-size={14 * pixel}
        text-anchor={name.length <= SHORT ? "middle" : x < 0 ? "start" : "end"}
        fill="var(--ink)"
      >
        {name}
      </text>
    </g>
  );
}
