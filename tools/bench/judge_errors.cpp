// Prints, for each effect, how far the laws' chain lengths are from the judge's over the sheet with
// it, how far they would be without it, and how far the bit is off under all motors of the
// box: {"name": [with, without, at the bit], ...} in mm.
#include <cstdio>

#include "hidden.h"

int main() {
  const char* between = "{";
  for (const Hidden& hidden : everyEffect()) {
    reference::Machine machine = judge();
    hidden.hide(machine);
    std::printf("%s\"%s\": [%.4f, %.3f, %.4f]", between, hidden.name.c_str(),
                worstOver(lawsWith(hidden.sizes), machine), worstOver(lawsWith({}), machine),
                worstAtTheBit(hidden));
    between = ", ";
  }
  std::printf(", \"sled_swing\": [%.4f, %.3f]}\n", worstSwing(lawsWith({{120, 3}, {121, -2}})),
              worstSwing(lawsWith({})));
}
