// The mark being typed: at first one without a reading. After choosing another you can type at once.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Form } from "./saves";

export interface OpenMark {
  open: number;
  pick: (index: number) => void;
}

export function useOpenMark(form: Form | undefined): OpenMark {
  const [picked, setPicked] = useState<{ file: string; index: number }>();
  const begin = useRef({ file: "", index: 0 });
  const { file = "", marks = [] } = form ?? {};
  if (begin.current.file !== file) {
    const waiting = marks.find((mark) => !mark.read) ?? marks[0];
    begin.current = { file, index: waiting?.index ?? 0 };
  }
  // At once, so that the next key is for it.
  useLayoutEffect(() => {
    if (picked) document.querySelector<HTMLElement>(`#mark-${picked.index} input`)?.focus();
  }, [picked]);
  return {
    open: picked?.file === file ? picked.index : begin.current.index,
    pick: (index) => setPicked({ file, index }),
  };
}
