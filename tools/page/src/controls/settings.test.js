// Runs with `node --test`.
import assert from "node:assert/strict";
import { test } from "node:test";
import { setting, settingText } from "./settings.ts";

test("a number of the machine is a line of its own kind, never money and never with an exponent", () => {
  assert.equal(setting(45, 0.00000517, "1/N"), "$45 = 0.00000517 1/N");
  assert.equal(setting(160, 8.2e-12, ""), "$160 = 0.0000000000082");
  assert.equal(settingText(2974.781), "2974.781");
  assert.equal(settingText(0), "0");
  assert.equal(settingText(-4.848065e-7), "-0.0000004848065");
});
