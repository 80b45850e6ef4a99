// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { numberOf, readingOf, withKnown } from "./values.ts";

const near = (is, wanted) =>
  assert.ok(Math.abs(is - wanted) < 1e-9 * Math.max(1, Math.abs(wanted)), `${is}, not ${wanted}`);

test("a number follows from what is read, and how far it may be off", () => {
  const links = { zero: 635, factor: 1 / 635, curve: "straight" };
  const pitch = numberOf(links, { value: 634.365, sigma: 0.2 });
  near(pitch.value, -0.001);
  near(pitch.sigma, 0.2 / 635);
  const gap = numberOf({ zero: 0, factor: 1, curve: "square" }, { value: -40, sigma: 3 });
  near(gap.value, 1600);
  near(gap.sigma, 43 ** 2 - 40 ** 2);
  const lean = { zero: 0, factor: 1, curve: "tangent squared" };
  near(numberOf(lean, { value: 45, sigma: 1 }).value, 1);
  near(numberOf(lean, { value: 0, sigma: 0.5 }).sigma, Math.tan(Math.PI / 360) ** 2);
});

test("what is read as it is stays as it was typed", () => {
  const gap = { zero: -609.6, factor: 1, curve: "straight" };
  const typed = { value: 3602.5, sigma: 0.8 };
  assert.equal(numberOf(gap, typed).sigma, 0.8);
  assert.equal(readingOf(gap, typed).sigma, 0.8);
});

test("a sign of the factor turns the number round, not how far it may be off", () => {
  const turned = numberOf({ zero: 1, factor: -2, curve: "straight" }, { value: 4, sigma: 0.5 });
  near(turned.value, -6);
  near(turned.sigma, 1);
});

test("what was typed is shown again", () => {
  for (const curve of ["straight", "square", "tangent squared"])
    for (const read of [
      { value: 12.5, sigma: 0.5 },
      { value: 0, sigma: 2 },
    ]) {
      const way = { zero: 0, factor: 0.02, curve };
      const shown = readingOf(way, numberOf(way, read));
      near(shown.value, read.value);
      near(shown.sigma, read.sigma);
    }
  const way = { zero: 635, factor: -1 / 635, curve: "straight" };
  near(readingOf(way, numberOf(way, { value: 634, sigma: 0.2 })).value, 634);
});

const NUMBERS = [
  { name: "weight", by: "" },
  { name: "sag", by: "weight" },
  { name: "gap", by: "" },
];
const KNOWN = { sag: { value: 8, sigma: 2 }, gap: { value: 3000, sigma: 1 } };

test("what was weighed against a sled stays what was weighed when the sled has another weight", () => {
  const weight = { value: 200, sigma: 2 };
  const stated = withKnown(KNOWN, NUMBERS, { name: "weight", value: weight, usual: 100 });
  assert.deepEqual(stated, { ...KNOWN, sag: { value: 2, sigma: 0.5 }, weight });
  const heavier = { value: 400, sigma: 2 };
  const again = withKnown(stated, NUMBERS, { name: "weight", value: heavier, usual: 100 });
  assert.deepEqual(again.sag, { value: 0.5, sigma: 0.125 });
  const gone = withKnown(again, NUMBERS, { name: "weight", value: undefined, usual: 100 });
  assert.deepEqual(gone, KNOWN);
});

test("other numbers change nothing but themselves", () => {
  const gap = { value: 2990, sigma: 1 };
  const stated = withKnown(KNOWN, NUMBERS, { name: "gap", value: gap, usual: 1 });
  assert.deepEqual(stated, { ...KNOWN, gap });
  const { gap: _, ...rest } = KNOWN;
  const gone = withKnown(KNOWN, NUMBERS, { name: "gap", value: undefined, usual: 1 });
  assert.deepEqual(gone, rest);
});
