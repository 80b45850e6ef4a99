// The waits that several commands need.
#include "waiting.h"

#include <math.h>

namespace machine {

bool Waiting::waitFor(uint32_t ms) {
  const uint32_t start = clock_.milliseconds();
  return waitWhile([&] { return clock_.milliseconds() - start < ms; });
}

bool Waiting::dwell(uint32_t ms) {
  dwelling_ = true;
  const bool completed = waitFor(ms);
  dwelling_ = false;
  return completed;
}

bool Waiting::drain() {
  if (!isMoving()) return !isStopping();
  waitWhile([&] { return isMoving(); });
  settle();
  return !isStopping();
}

void Waiting::settle() {
  const float kNear = 0.012f;      // [mm]
  const uint32_t kPatience = 500;  // [ms] for a motor without gains, which never comes nearer
  const uint32_t start = clock_.milliseconds();
  waitWhile([&] {
    if (clock_.milliseconds() - start >= kPatience) return false;
    for (uint8_t i = 0; i < kAxisCount; ++i)
      if (!(float(fabs(axes_.error(Axis(i)))) < kNear)) return true;
    return false;
  });
}

void Waiting::awaitStandstill() {
  const uint32_t kPatience = 1000;  // [ms] somebody may turn a sprocket by hand
  const uint32_t start = clock_.milliseconds();
  while (axes_.isTurning() && clock_.milliseconds() - start < kPatience) pass();
}

}  // namespace machine
