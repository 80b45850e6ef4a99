// Step 6: the tape's readings, typed into a grid laid out like the sheet.

import { Trouble } from "../controls/Trouble";
import { FileOfReadings, FormPicker, ReadAgain } from "../readings/FormPicker";
import { Grid } from "../readings/Grid";
import { ReadingsMap } from "../readings/ReadingsMap";
import { Spans } from "../readings/Spans";
import { Tape } from "../readings/Tape";
import { useDoubts } from "../readings/useDoubts";
import { useReadings } from "../readings/useReadings";
import { Screen } from "../shell/Screen";
import "../readings/readings.css";

const LEAST = 9; // marks for a first verdict
export function Readings() {
  const readings = useReadings();
  const { doubts, compared, looking, refused } = useDoubts(readings.form);
  const { form } = readings;
  if (!form) return <Screen title="What does the tape say?" say="One moment …" busy />;
  const read = form.marks.filter((mark) => mark.read).length;
  const doubted = new Set(doubts.filter((doubt) => doubt.is_mark).map((doubt) => doubt.index));
  return (
    <Screen
      {...form.heading}
      why={<Why />}
      command={form.command}
      stage={
        form.marks.length > 0 && (
          <ReadingsMap form={form} doubted={doubted} open={readings.open} pick={readings.pick} />
        )
      }
      fieldsFirst
      act={read >= LEAST && <ToVerdict read={read} all={form.marks.length} />}
    >
      <FormPicker form={form} choose={readings.chooseFile} />
      {form.marks.length > 0 && (
        <>
          <ReadAgain form={form} />
          <Tape form={form} take={readings.take} />
          <p class="count soft" role="status" aria-busy={looking}>
            {form.counted}
            {compared && ` ${compared}`}
            {looking && " Looking for readings that disagree …"}
          </p>
          <Trouble>{refused && `Nothing looks for readings that disagree. ${refused}`}</Trouble>
          <Spans {...{ form, readings, doubts }} />
          <Grid {...{ form, readings, doubts }} />
        </>
      )}
      <FileOfReadings form={form} choose={readings.chooseFile} />
    </Screen>
  );
}

/** The verdict is possible before all is read; it names more when it is. */
function ToVerdict({ read, all }: { read: number; all: number }) {
  return read < all ? (
    <>
      <a class="button tinted" href="#/verdict">
        First verdict, from {read} marks
      </a>
      <small>{all - read} to go; all name more</small>
    </>
  ) : (
    <a class="button primary" href="#/verdict">
      Go to the verdict
    </a>
  );
}

function Why() {
  return (
    <>
      <p>
        An arrow shows each reading as soon as it is there: from where the mark was sent to where it
        is. Arrows that change smoothly over the sheet are the machine. An arrow that differs from
        its neighbours is most often a slip of the eye or the pen.
      </p>
      <p>
        Nothing is deleted or changed unless you press the button. A table of a spreadsheet is read
        as a file.
      </p>
    </>
  );
}
