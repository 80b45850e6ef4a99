// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { written } from "./names.ts";

const PLOT = { left: 0, right: 300, top: 0, bottom: 150 };
const named = (name, x, y, first = false) => ({ name, at: [x, y], first });

test("no name stands over another, and what comes first has its name", () => {
  const crowd = Array.from({ length: 30 }, (_, i) => named(`${i}`, 100 + i, 70));
  crowd[17].first = true;
  const shown = written(crowd, 14, 6, PLOT);
  assert.ok(shown.length >= 2 && shown.length < 12);
  assert.equal(shown[0].index, 17);
  for (const one of shown)
    for (const other of shown)
      if (one !== other) {
        const wide = 0.62 * 14 * crowd[Math.min(one.index, other.index)].name.length;
        assert.ok(Math.abs(one.x - other.x) >= wide - 9 || Math.abs(one.y - other.y) >= 14);
      }
});

test("a name at an edge stands on the side that is seen", () => {
  const [right] = written([named("25", 295, 20)], 14, 6, PLOT);
  assert.ok(right.x < 295);
  const [low] = written([named("25", 20, 148)], 14, 6, PLOT);
  assert.ok(low.y < 148);
  assert.deepEqual(written([named("far", 500, 20), named("", 20, 20)], 14, 6, PLOT), []);
});
