// A saved report: the verdict as the lab shows it, the numbers, and their sources. It needs no server.
import type { Project, Schemas } from "../api/client";
import { Table } from "../controls/Table";
import { Shares } from "../shell/Shares";
import { Notes, Why } from "../steps/Correct";
import { NumberTable } from "../steps/correct/NumberTable";
import { Course } from "../steps/diary/Course";
import { Errors } from "../steps/diary/Errors";
import { Verdict } from "../steps/Verdict";
import type { VerdictAnswer } from "../steps/verdict/words";
import { MarkTable } from "./MarkTable";
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
  const { verdict } = answers.verdict as VerdictAnswer;
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
      <Notes made={made} weight="stop" />
      <Notes made={made} weight="by_hand" />
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
