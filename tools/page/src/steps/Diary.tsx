// Step 10: what was fitted and written over time, with the error and each number.

import type { Schemas } from "../api/client";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { Course, Errors } from "./diary/History";
import "./diary/diary.css";

type DiaryAnswer = Schemas["DiaryAnswer"];

export function Diary() {
  const { project } = useProject();
  // Asked again for a new entry or another unit; the server uses its saved unit.
  const state = `${project.files["diary.jsonl"]} ${project.choices_digest}`;
  const diary = useNewest<DiaryAnswer>("diary", state);
  if (!diary) return <Screen title="The diary" say="One moment …" busy />;
  const { fits } = diary;
  return (
    <Screen {...diary.heading}>
      {fits.length > 0 && <Errors fits={fits} />}
      {diary.courses.length > 0 && (
        <section>
          <h2>Numbers</h2>
          <div class="tiles">
            {diary.courses.map((course) => (
              <Course key={course.noun} course={course} />
            ))}
          </div>
        </section>
      )}
      {diary.others.length > 0 && (
        <section>
          <h2>What was done</h2>
          <ul class="noted">
            {diary.others.map((noted) => (
              <li key={noted.at + noted.said}>
                <time dateTime={noted.at}>{when(noted.at)}</time> {noted.said}
              </li>
            ))}
          </ul>
        </section>
      )}
      {diary.spoilt > 0 && (
        <p>
          {diary.spoilt} {diary.spoilt === 1 ? "line" : "lines"} of diary.jsonl cannot be read.
        </p>
      )}
    </Screen>
  );
}

function when(at: string): string {
  return new Date(at).toLocaleString(undefined, { dateStyle: "medium", timeStyle: "short" });
}
