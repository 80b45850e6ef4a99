// Marks with half a reading in this browser: they do not count, and the verdict says so.
import { useEffect, useState } from "preact/hooks";
import { get } from "../../api/client";
import { allHalves } from "../../readings/halves";
import type { Form } from "../../readings/saves";
import { useProject } from "../../shell/project";

export function HalfTyped() {
  const { project } = useProject();
  const [count, setCount] = useState(0);
  const state = JSON.stringify(project.files);
  // Marks that have been read since are no longer half typed.
  useEffect(() => {
    let over = false;
    void halfTyped(project.key).then((now) => over || setCount(now));
    return () => {
      over = true;
    };
  }, [project.key, state]);
  if (count === 0) return null;
  return (
    <p class="half-typed" role="status">
      {count === 1 ? "1 mark is half typed and does" : `${count} marks are half typed and do`} not
      count. <a href="#/readings">Type the rest</a>
    </p>
  );
}

/** How many marks of a folder are half typed here, and not read. */
async function halfTyped(key: string): Promise<number> {
  const halves = allHalves(key);
  const files = [...new Set(halves.map(({ file }) => file))];
  const waiting = await Promise.all(
    files.map(async (file) => {
      const form = await get<Form>(`readings?file=${encodeURIComponent(file)}`).catch(() => null);
      const open = (form?.marks ?? []).filter((mark) => !mark.read).map((mark) => mark.index);
      return halves.filter((half) => half.file === file && open.includes(half.index)).length;
    }),
  );
  return waiting.reduce((sum, each) => sum + each, 0);
}
