// Prints, for each effect, how far the laws' chain lengths are from the judge's over the sheet with
// it, and how far they would be without it: {"name": [with, without], ...} in mm.
#include <cstdio>

#include "hidden.h"

int main() {
  const char* between = "{";
  for (const Hidden& hidden : everyEffect()) {
    reference::Machine machine = judge();
    hidden.hide(machine);
    std::printf("%s\"%s\": [%.4f, %.3f]", between, hidden.name.c_str(),
                worstOver(lawsWith(hidden.sizes), machine), worstOver(lawsWith({}), machine));
    between = ", ";
  }
  std::printf(", \"sled_swing\": [%.4f, %.3f]}\n", worstSwing(lawsWith({{120, 3}, {121, -2}})),
              worstSwing(lawsWith({})));
}
