// Prints, for each effect, how far the laws' chain lengths are from the judge's over the sheet with
// it, how far they would be without it, and how far the bit is off under all motors of the
// box: {"name": [with, without, at the bit], ...} in mm.
#include <cstdio>

#include "hidden.h"

int main() {
  const char* between = "{";
  for (const Hidden& hidden : everyEffect()) {
    const reference::Machine machine = judge(hidden.effects);
    std::printf("%s\"%s\": [%.4f, %.3f, %.4f]", between, hidden.name.c_str(),
                worstOver(prepare(frameUnder({}), hidden.effects), machine),
                worstOver(prepare(frameUnder({}), hidden.unsuspected), machine),
                worstAtTheBit(hidden));
    between = ", ";
  }
  std::printf("}\n");
}
