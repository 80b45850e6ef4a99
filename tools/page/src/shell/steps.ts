// The steps of a calibration in order, and what each needs before it opens.
import type { ComponentType } from "preact";
import type { Project, Schemas } from "../api/client";
import { Bench } from "../bench/Bench";
import { Practice } from "../practice/Practice";
import { Correct } from "../steps/Correct";
import { Cut } from "../steps/Cut";
import { Diary } from "../steps/Diary";
import { Known } from "../steps/Known";
import { Measure } from "../steps/Measure";
import { Open } from "../steps/Open";
import { Prove } from "../steps/Prove";
import { Reach } from "../steps/Reach";
import { Readings } from "../steps/Readings";
import { Verdict } from "../steps/Verdict";

export type Form = Schemas["ReadingsAnswer"];

/** A screen of the lab. */
export interface Step {
  id: string; // in the address, behind #
  title: string;
  Screen: ComponentType;
  /** Its result in a word or two; may be empty. */
  result?: (project: Project, form: Form | undefined) => string;
  /** Whether it has been done, as the folder shows it. */
  isDone?: (project: Project, form: Form | undefined) => boolean;
  /** What is missing before this screen opens, in a few words; empty if nothing. */
  needs: (project: Project) => string;
}

const nothing = () => "";
const settings = ({ lacks }: Project) => lacks[0];
const marks = ({ lacks }: Project) => lacks[1];

const known = ({ choices }: Project) => counted(Object.keys(choices.known ?? {}).length);
const accepted = ({ choices }: Project) => counted(choices.accepted?.length ?? 0);
const read = (_: Project, form: Form | undefined) =>
  form?.marks.length ? `${form.marks.filter((mark) => mark.read).length}/${form.marks.length}` : "";
const counted = (count: number) => (count > 0 ? String(count) : "");

const isOpened = (project: Project) => project.machine !== null;
const isPlanned = (_: Project, form: Form | undefined) => !!form?.marks.length;
const isCut = (_: Project, form: Form | undefined) =>
  !!form && (form.marks.some((mark) => mark.read) || form.distances.length > 0);
const isRead = (_: Project, form: Form | undefined) =>
  !!form?.marks.length && form.marks.every((mark) => mark.read);
const isCorrected = ({ choices }: Project) => !!choices.settings_before?.length;

function step(
  id: string,
  title: string,
  Screen: ComponentType,
  needs: Step["needs"],
  more: Pick<Step, "result" | "isDone"> = {},
): Step {
  return { id, title, Screen, needs, ...more };
}

export const STEPS: Step[] = [
  step("open", "Machine", Open, nothing, { isDone: isOpened }),
  step("known", "What you know", Known, settings, { result: known }),
  step("reach", "Reach", Reach, settings),
  step("measure", "Choose marks", Measure, settings, { isDone: isPlanned }),
  step("cut", "Cut", Cut, settings, { isDone: isCut }),
  step("readings", "Readings", Readings, settings, { result: read, isDone: isRead }),
  step("verdict", "Verdict", Verdict, marks),
  step("correct", "Correct", Correct, marks, { result: accepted, isDone: isCorrected }),
  step("prove", "Prove", Prove, marks),
  step("diary", "Diary", Diary, nothing),
];

export const ROOMS: Step[] = [
  step("bench", "Effects bench", Bench, marks),
  step("practice", "Practice", Practice, nothing),
];
