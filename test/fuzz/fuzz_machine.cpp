// Fuzz target: any characters to the whole machine. The first byte chooses how the sender behaves.
#include <cstddef>

#include "world.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const int steps[] = {5, 1, 2, 10};
  Story story;
  story.step_ms = steps[data[0] & 3];
  story.is_polite = (data[0] & 4) == 0;
  // Most runs begin with a machine that knows its position, because others reject every move.
  if ((data[0] & 0x18) != 0x18) story.eeprom = ownImage();
  story.sent.assign(data + 1, data + size);
  live(story);
  return 0;
}
