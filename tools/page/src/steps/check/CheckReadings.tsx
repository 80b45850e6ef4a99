// The readings of the check marks, typed as all others are.
import { Grid } from "../../readings/Grid";
import { useReadings } from "../../readings/useReadings";
import "../../readings/readings.css";

export function CheckReadings({ file }: { file: string }) {
  const readings = useReadings(file);
  if (!readings.form) return null;
  return (
    <section aria-label="Readings of the check marks">
      <h2>What does the tape say?</h2>
      <Grid form={readings.form} readings={readings} doubts={[]} />
    </section>
  );
}
