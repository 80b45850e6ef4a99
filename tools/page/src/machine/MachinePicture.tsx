// The machine from the front, to scale: motors, chains, sheet and sled; a distance may be marked on it.
import type { Schemas } from "../api/client";
import { useMachine } from "../shell/machine";
import "./picture.css";

type Machine = Schemas["Machine"];
type Distance = Schemas["KnownNumber"]["marked"];

interface PictureParts {
  machine: Machine;
  /** The distance to mark. */
  marked?: Distance;
  /** Its label. */
  words?: string;
}

export function MachinePicture({ machine, marked = "", words = "" }: PictureParts) {
  const [width, height] = machine.sheet;
  const gap = machine.frame.motor_gap ?? width;
  const up = machine.frame.motor_height ?? height;
  const ring = machine.frame.rotation_radius ?? 140;
  const left = Math.max(gap, width) / 2 + 220;
  const box = [-left, -up - 380, 2 * left, up + height / 2 + 610];
  const { place, knows_place, kind } = useMachine();
  const sled: [number, number] =
    place && knows_place && kind !== "none" ? [place[0], -place[1]] : [-width / 8, -height / 16];
  const ends = {
    motor_gap: [-gap / 2, -up - 150, gap / 2, -up - 150],
    motor_height: [width / 2 - 60, -height / 2, width / 2 - 60, -up],
    rotation_radius: [sled[0], sled[1], sled[0] + ring, sled[1]],
    sled_weight: [sled[0], sled[1], sled[0], sled[1] + 330],
    chain: [gap / 4, -up / 2, gap / 4, -up / 2],
  } as const;
  return (
    <svg
      class="machine-picture"
      viewBox={box.join(" ")}
      role="img"
      aria-label={`The machine from the front${marked ? `; marked: ${words}` : ""}`}
    >
      <rect class="wood" x={-width / 2} y={-height / 2} width={width} height={height} />
      <line class="beam" x1={-gap / 2 - 90} x2={gap / 2 + 90} y1={-up} y2={-up} />
      {[-gap / 2, gap / 2].map((x) => {
        const [dx, dy] = [sled[0] - x, sled[1] + up];
        const share = 1 - ring / Math.hypot(dx, dy);
        return (
          <g key={x}>
            <path
              class={marked === "chain" ? "chain marked" : "chain"}
              d={`M${x} ${-up}l${dx * share} ${dy * share}`}
            />
            <circle class="motor" cx={x} cy={-up} r={55} />
          </g>
        );
      })}
      <circle class="sled" cx={sled[0]} cy={sled[1]} r={230} />
      <circle class="ring" cx={sled[0]} cy={sled[1]} r={ring} />
      <circle class="bit" cx={sled[0]} cy={sled[1]} r={16} />
      {marked && <Marked ends={ends[marked]} {...{ marked, words, sled }} />}
    </svg>
  );
}

interface MarkedParts {
  marked: Exclude<Distance, "">;
  words: string;
  ends: readonly [number, number, number, number];
  sled: readonly [number, number];
}

function Marked({ marked, words, ends: [x1, y1, x2, y2], sled }: MarkedParts) {
  const [x, y] = [(x1 + x2) / 2, (y1 + y2) / 2];
  const level = y1 === y2 && marked !== "rotation_radius";
  const below = marked === "rotation_radius" || marked === "sled_weight";
  return (
    <g class="mark">
      <line x1={x1} y1={y1} x2={x2} y2={y2} />
      <circle cx={x1} cy={y1} r={18} />
      <circle cx={x2} cy={y2} r={18} />
      <text
        x={below ? sled[0] : level ? x : x - 40}
        y={below ? sled[1] + 420 : level ? y - 70 : y + 30}
        text-anchor={below || level ? "middle" : "end"}
      >
        {words}
      </text>
    </g>
  );
}
