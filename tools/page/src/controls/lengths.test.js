// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { lengthText, noLength, typedLength } from "./lengths.ts";

const near = (mm, text, unit) => assert.ok(Math.abs(typedLength(text, unit) - mm) < 1e-9, text);

test("the sign of the inch means inch, whatever was chosen", () => {
  for (const unit of ["mm", "inch"]) {
    for (const sign of ['"', ' "', "in", " inch", "″", "”", "IN"]) {
      near(111.91875, `4 13/32${sign}`, unit);
      near(-12.7, `-0,5${sign}`, unit);
    }
    near(4.5, "4.5 mm", unit);
    near(4.5, "4,5MM", unit);
  }
});

test("without a sign the chosen unit counts", () => {
  near(4.5, "4.5", "mm");
  near(114.3, "4 1/2", "inch");
});

test("a text that is not a length says how to type one", () => {
  for (const text of ["11l.9", "4 mm mm", '4""', "1/0", "mm", '"', "4 inch mm", "1.2.3"]) {
    assert.equal(typedLength(text, "mm"), undefined, text);
    assert.match(noLength(text, "mm"), /is not a length: type it like 11\.9/);
  }
  assert.match(noLength("x", "inch"), /type it like 4 13\/32/);
  for (const text of ["", "  ", "12", '3/8"']) assert.equal(noLength(text, "mm"), "");
});

test("a length that is shown is read as it was", () => {
  for (const mm of [0, 111.91875, 1219.2, 12.7]) near(mm, lengthText(mm, "inch"), "inch");
});
