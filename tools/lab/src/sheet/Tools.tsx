// The buttons below a sheet: nearer and farther, how long its arrows are, and files of what it shows.
import type { Zoom } from "./useZoom";

const STEP = 1.6; // of a press on a button
const FACTORS = [1, 2, 5, 10, 20, 50, 100, 200, 500];

interface ToolsParts {
  zoom: Zoom;
  factor: number | undefined;
  setFactor: (factor: number | undefined) => void;
  save: (as: "csv" | "svg" | "png") => void;
}

export function Tools({ zoom, factor, setFactor, save }: ToolsParts) {
  const { view, enlarge } = zoom;
  return (
    <div class="tools row">
      <button type="button" aria-label="Farther" onClick={() => enlarge(1 / STEP)}>
        −
      </button>
      <button type="button" aria-label="Nearer" onClick={() => enlarge(STEP)}>
        +
      </button>
      <button type="button" aria-disabled={view.times === 1} onClick={() => enlarge(0)}>
        All
      </button>
      {factor !== undefined && (
        <label>
          <span class="spoken">Arrows longer than life</span>
          <select
            value={factor}
            onChange={({ currentTarget: { value } }) => setFactor(Number(value))}
          >
            {FACTORS.map((each) => (
              <option key={each} value={each}>
                × {each}
              </option>
            ))}
          </select>
        </label>
      )}
      <details>
        <summary class="button">Save</summary>
        <div>
          <button type="button" onClick={() => save("csv")}>
            Data as CSV
          </button>
          <button type="button" onClick={() => save("svg")}>
            Picture as SVG
          </button>
          <button type="button" onClick={() => save("png")}>
            Picture as PNG
          </button>
        </div>
      </details>
    </div>
  );
}
