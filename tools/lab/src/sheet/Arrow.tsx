// An arrow from where a mark should be to where it is, made longer so that it can be seen.
import { usePixel } from "./SheetMap";

interface ArrowParts {
  from: readonly [number, number]; // [mm] machine frame
  to: readonly [number, number];
  exaggeration: number;
  colour: string;
  label?: string;
}

export function Arrow({ from, to, exaggeration, colour, label }: ArrowParts) {
  const pixel = usePixel();
  const [x, y] = [from[0], -from[1]];
  const [dx, dy] = [(to[0] - from[0]) * exaggeration, -(to[1] - from[1]) * exaggeration];
  const length = Math.hypot(dx, dy);
  const head = Math.min(9 * pixel, length);
  const [ux, uy] = length > 0 ? [dx / length, dy / length] : [0, 0];
  const [tipX, tipY] = [x + dx, y + dy];
  const wing = (side: number) =>
    `${tipX - head * (ux + side * 0.45 * uy)},${tipY - head * (uy - side * 0.45 * ux)}`;
  return (
    <g stroke={colour} fill={colour} stroke-width={2 * pixel}>
      {label && <title>{label}</title>}
      <circle cx={x} cy={y} r={2.5 * pixel} stroke="none" />
      <line x1={x} y1={y} x2={tipX - ux * head * 0.8} y2={tipY - uy * head * 0.8} />
      <polygon points={`${tipX},${tipY} ${wing(1)} ${wing(-1)}`} stroke="none" />
    </g>
  );
}
