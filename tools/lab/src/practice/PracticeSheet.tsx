// The sheet of the game: an arrow for each mark that was read, and places that somebody chooses.
import { useEffect, useState } from "preact/hooks";
import { type Comparison, get } from "../api/client";
import { usualExaggeration } from "../bench/exaggeration";
import { namedLength } from "../controls/lengths";
import { Arrow } from "../sheet/Arrow";
import { SheetMap, usePixel } from "../sheet/SheetMap";
import { useProject } from "../shell/project";

type Place = [number, number];

interface PracticeSheetParts {
  places: Place[];
  place: ((at: Place) => void) | undefined;
}

export function PracticeSheet({ places, place }: PracticeSheetParts) {
  const { project } = useProject();
  const [comparison, setComparison] = useState<Comparison>();
  const marks = project.choices.marks ?? [];
  const read = marks.map((name) => project.files[name]).join();
  useEffect(() => {
    if (read === "") return setComparison(undefined);
    get<Comparison>("comparison").then(setComparison, () => setComparison(undefined));
  }, [read]);
  const sheet = project.machine?.sheet;
  if (!sheet) return null;
  const worst = comparison?.worst ?? 0;
  const times = usualExaggeration(1.6 * worst, sheet[0]);
  const touched = (event: MouseEvent) => {
    const drawing = (event.currentTarget as Element).querySelector("svg");
    const turned = drawing?.getScreenCTM()?.inverse();
    if (!turned || !place) return;
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(turned);
    if (Math.abs(at.x) < sheet[0] / 2 && Math.abs(at.y) < sheet[1] / 2) {
      place([Math.round(at.x), Math.round(-at.y)]);
    }
  };
  return (
    // biome-ignore lint/a11y/useKeyWithClickEvents: grids are chosen by keyboard; a place is a spot on a picture
    // biome-ignore lint/a11y/noStaticElementInteractions: the same
    <div class={place ? "practice-sheet placing" : "practice-sheet"} onClick={touched}>
      <SheetMap
        sheet={sheet}
        label={comparison ? `Marks read: ${comparison.marks.length}` : "The empty sheet"}
      >
        {comparison?.marks.map((mark, i) => (
          <Arrow
            key={i}
            from={mark.predicted}
            to={mark.measured}
            exaggeration={times}
            colour="var(--before)"
            label={mark.name}
          />
        ))}
        <Places places={places} />
      </SheetMap>
      {comparison && (
        <p class="legend">
          {comparison.marks.length} readings, off by{" "}
          {namedLength(comparison.rms, project.choices.units ?? "mm", 2)}; arrows × {times}
        </p>
      )}
    </div>
  );
}

function Places({ places }: { places: Place[] }) {
  const pixel = usePixel();
  return (
    <>
      {places.map(([x, y], i) => (
        <circle key={i} class="wanted" cx={x} cy={-y} r={7 * pixel} stroke-width={2 * pixel} />
      ))}
    </>
  );
}
