// A field whose text is what is saved, until somebody types; what is wrong stays in view until it is mended.
import { useEffect, useRef, useState } from "preact/hooks";

export function useTyped(
  saved: string,
  isWrong: (text: string) => boolean,
): [text: string, type: (text: string) => void] {
  const [text, type] = useState(saved);
  const stays = useRef(false);
  stays.current = isWrong(text);
  useEffect(() => {
    if (!stays.current || saved !== "") type(saved);
  }, [saved]);
  return [text, type];
}
