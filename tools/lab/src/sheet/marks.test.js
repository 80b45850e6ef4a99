// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { table } from "./marks.ts";

const marks = [
  { name: "1", target: [-10, 20], measured: [-9.5, 19] },
  { name: "=A1,x", target: [30, 40] },
];

const error = [0.5, -1];
const ends = [0.25, null];
const asSet = { title: "as set", errors: [error, null], chains: [ends] };

test("a table has a row for each mark in each state, with empty cells for what is not known", () => {
  const rows = table(marks, [asSet], 0.5).split("\n");
  assert.ok(rows[0].startsWith("state,name,target_x_mm,"));
  assert.equal(rows[1], "as set,1,-10,20,-9.5,19,0.5,-1,0.25,,0.5");
  assert.equal(rows[2], ["as set", `"'=A1,x"`, "30,40,,,,,,,0.5"].join(","));
  assert.equal(rows[3], "");
});

test("marks without errors are planned", () => {
  const rows = table(marks, [], undefined).split("\n");
  assert.equal(rows.length, 4);
  assert.equal(rows[1], "planned,1,-10,20,-9.5,19,,,,,");
});
