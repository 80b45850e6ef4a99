// Runs the kinematics over the sheet on the (simulated) Mega, with marks around each call. A mark
// is a write to GPIOR0, a register that nothing else uses: case + 1 before the call, zero after it.
#include <avr/io.h>

#include "Kinematics.h"
#include "cases.h"
#include "reach.h"

using namespace kinematics;

namespace {

// The compiler must not move work across a mark.
#define BARRIER() __asm__ __volatile__("" ::: "memory")

volatile float sink, other_sink;
// noinline: called from a single place, the compiler would inline it there.
Reached<float> (*volatile const askReach)(const Machine<float>&, Point<float>,
                                          const ReachLimits<float>&) = reach<float>;

/// Fills in the typical size of each effect in a case.
struct TypicalSizes {
  const bench::Case& wanted;
  float* next;

  template <class ThisEffect>
  void effect(int first_setting) {
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      *next++ =
          bench::isPresent(wanted, first_setting) ? float(ThisEffect::param(i).typical) : 0.0f;
  }
};

Machine<float> machineFor(const bench::Case& wanted) {
  const float sled = wanted.rig == bench::kLightSled ? 60.0f : 97.9f;
  const Feed feed = wanted.rig == bench::kOffBottom ? Feed::kOffBottom : Feed::kOverTop;
  const Frame<float> frame = {2978.4f, 1072.6f, 0, 139.1f, 10.1063f, sled, 0.00137293f, feed};
  EffectParams<float> effects;
  TypicalSizes sizes = {wanted, effects.value};
  Effects::For<float>::visit(sizes);
  return prepare(frame, effects);
}

Point<float> gridPlace(uint8_t column, uint8_t row) {
  return {-1219.2f + 2438.4f * column / (bench::kColumns - 1),
          -609.6f + 1219.2f * row / (bench::kRows - 1)};
}

void timeOne(uint8_t number, const Machine<float>& machine, Point<float> place) {
  const Chains<float> chains = inverse(machine, place).chains;
  const Point<float> far = {place.x > 0 ? -1219.2f : 1219.2f, place.y > 0 ? -609.6f : 609.6f};
  const Point<float> near = {place.x + 0.1f, place.y - 0.1f};
  const bench::What what = bench::kCases[number].what;
  if (what == bench::kInverse) {
    BARRIER();
    GPIOR0 = number + 1;
    BARRIER();
    const PaidOut<float> paid = inverse(machine, place);
    sink = paid.chains.left;
    other_sink = paid.chains.right;
  } else if (what == bench::kForward) {
    BARRIER();
    GPIOR0 = number + 1;
    BARRIER();
    sink = forward(machine, chains).sled.x;
  } else if (what == bench::kForwardFar || what == bench::kForwardNear) {
    const Point<float> guess = what == bench::kForwardFar ? far : near;
    BARRIER();
    GPIOR0 = number + 1;
    BARRIER();
    sink = forward(machine, chains, guess).sled.x;
  } else if (what == bench::kReach) {
    const ReachLimits<float> limits;
    BARRIER();
    GPIOR0 = number + 1;
    BARRIER();
    const Reached<float> here = askReach(machine, place, limits);
    sink = here.give.xx;
    other_sink = float(here.verdict);
  } else {
    BARRIER();
    GPIOR0 = number + 1;
    BARRIER();
    sink = place.x;
  }
  BARRIER();
  GPIOR0 = 0;
  BARRIER();
}

}  // namespace

int main() {
  for (uint8_t i = 0; i < bench::kCaseCount; ++i) {
    const Machine<float> machine = machineFor(bench::kCases[i]);
    for (uint8_t column = 0; column < bench::kColumns; ++column)
      for (uint8_t row = 0; row < bench::kRows; ++row) timeOne(i, machine, gridPlace(column, row));
  }
  GPIOR0 = bench::kFinished;
  for (;;) {
  }
}
