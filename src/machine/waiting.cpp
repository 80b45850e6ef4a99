// The waits that several commands need.
#include "waiting.h"

#include <math.h>

namespace machine {
namespace {

const uint32_t kNearPatience = 500;  // [ms] for a motor without gains, which never comes nearer
const uint32_t kStopPatience = 200;  // [ms] meanwhile a motor without its encoder may run

}  // namespace

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
  const uint32_t start = clock_.milliseconds();
  waitWhile([&] { return !areNear(true) && clock_.milliseconds() - start < kNearPatience; });
}

bool Waiting::areNear(bool all) const {
  const float kNear = 0.012f;  // [mm]
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    if (!all && !axes_.isFollowing(Axis(i))) continue;
    if (!(float(fabs(axes_.error(Axis(i)))) < kNear)) return false;
  }
  return true;
}

void Waiting::awaitStandstill() {
  const uint32_t kPatience = 1000;  // [ms] a sprocket may be turned by hand
  const uint32_t kStill = 20;       // [ms] a tick that came late is followed by one without counts
  const uint32_t start = clock_.milliseconds();
  uint32_t went = start, now = start;
  while (now - went < kStill) {
    pass();
    now = clock_.milliseconds();
    const bool goes = (axes_.isTurning() && now - start < kPatience) ||
                      (!areNear(false) && now - start < kStopPatience);
    if (goes) went = now;
  }
}

}  // namespace machine
