// For each effect, prints errors against the judge in mm: {"name": [with, without, at the bit],
// ...}. `with` is the largest error of lib/Kinematics' chain lengths over the sheet, `without` the
// same if the effect were left out, `at the bit` the error of the bit under all positions of the
// motors. A word on the command line picks the effects whose names begin with it.
#include <cstdio>
#include <stdexcept>

#include "hidden.h"

namespace {

void print(const std::string& chosen) {
  const char* between = "{";
  for (const Hidden& hidden : everyEffect()) {
    if (hidden.name.compare(0, chosen.size(), chosen) != 0) continue;
    const reference::Machine machine = judge(hidden.effects);
    std::printf("%s\"%s\": [%.4f, %.3f, %.4f]", between, hidden.name.c_str(),
                worstOver(prepare(frameUnder({}), hidden.effects), machine),
                worstOver(prepare(frameUnder({}), hidden.unsuspected), machine),
                worstAtTheBit(hidden));
    between = ", ";
  }
  std::printf("}\n");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    print(argc > 1 ? argv[1] : "");
  } catch (const std::invalid_argument& refusal) {
    std::fprintf(stderr, "judge_errors: %s\n", refusal.what());
    return 1;
  }
  return 0;
}
