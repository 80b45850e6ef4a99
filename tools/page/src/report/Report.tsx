// A saved report: the verdict as the lab shows it, the numbers, and their sources. It needs no server.
import type { Project, Schemas } from "../api/client";
import { shownLength, useUnits, withMinus } from "../controls/lengths";
import { Table } from "../controls/Table";
import { Shares } from "../shell/Shares";
import { Notes, Why } from "../steps/Correct";
import { NumberTable } from "../steps/correct/NumberTable";
import { Course, Errors } from "../steps/diary/History";
import { Verdict } from "../steps/Verdict";
import "./report.css";

/** What a report holds besides the lab's answers. */
interface About {
  title: string;
  said: string;
  files: { what: string; name: string; digest: string }[];
  versions: string;
  compared: string;
  command: string;
}

const stays = async () => {};

export function Report({ answers }: { answers: Readonly<Record<string, unknown>> }) {
  const project = answers.project as Project;
  const about = answers.about as About;
  const { verdict } = answers.verdict as Schemas["VerdictAnswer"];
  const diary = answers.diary as Schemas["DiaryAnswer"];
  const shared = { project, take: stays, choose: stays, reload: stays, trouble: "" };
  return (
    <Shares shared={{ ...shared, setTrouble: stays }}>
      <main class="report">
        <p class="about soft">
          <b>{about.title}</b> {about.said}. {about.compared}
        </p>
        <Verdict />
        <Numbers made={answers.correction as Schemas["CorrectionParts"]} />
        {diary.fits.length > 0 && (
          <section>
            <h2>Round by round</h2>
            <Errors fits={diary.fits} />
            <div class="tiles">
              {diary.courses.map((course) => (
                <Course key={course.noun} course={course} />
              ))}
            </div>
          </section>
        )}
        {verdict && verdict.marks.length > 0 && <MarkTable verdict={verdict} />}
        <Sources about={about} />
      </main>
    </Shares>
  );
}

function Numbers({ made }: { made: Schemas["CorrectionParts"] }) {
  return (
    <section>
      <h2>The numbers, before and after</h2>
      {made.numbers.length > 0 && <NumberTable numbers={made.numbers} />}
      <Notes title="Do not write these numbers" said={made.stops} />
      <Notes title="By hand" said={made.by_hand} />
      <Why made={made} />
    </section>
  );
}

function Sources({ about }: { about: About }) {
  return (
    <section>
      <h2>Where this comes from</h2>
      <Table
        names={["file", "name", "fingerprint (SHA-256)"]}
        rows={about.files.map(({ what, name, digest }) => [
          what,
          name,
          <code key={digest}>{digest}</code>,
        ])}
      />
      <p>
        Made by {about.versions}. The same again: <code>{about.command}</code>
      </p>
    </section>
  );
}

/** Each mark with its error, for paper, where you cannot point at a mark. */
function MarkTable({ verdict }: { verdict: Schemas["Verdict"] }) {
  const units = useUnits();
  const left = verdict.states.at(-1);
  const pair = (both: readonly (number | null)[] | null | undefined, digits: number) =>
    withMinus(
      both?.map((each) => (each === null ? "–" : shownLength(each, units, digits))).join(", ") ??
        "–",
    );
  return (
    <section>
      <h2>The readings [{units}]</h2>
      <p>
        From the middle of the sheet, x right, y up. Off by: read − where the settings put it. Left:
        what {left?.title} leaves, on the sheet and as left and right chain.
      </p>
      <Table
        class="readings-read"
        names={["mark", "target", "read", "off by", "left", "chains"]}
        tone={(row) => (verdict.doubted.includes(row) ? "doubted" : "")}
        rows={verdict.marks.map((mark, i) => [
          `${mark.name} ${verdict.doubted.includes(i) ? "(read it again)" : ""}`,
          pair(mark.target, 1),
          pair(mark.measured, 1),
          pair(mark.error, 2),
          pair(left?.errors[i], 2),
          pair(left?.chains[i], 2),
        ])}
      />
    </section>
  );
}
