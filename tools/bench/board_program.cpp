// Runs the kinematics over the sheet on the (simulated) Mega, with marks around each call. A mark
// is a write to GPIOR0, a register that nothing else uses: case + 1 before the call, zero after it.
#include <avr/io.h>
#include <avr/sleep.h>

#include "Kinematics.h"
#include "cases.h"
#include "quadrilateral.h"

using namespace kinematics;

namespace {

/// The compiler must not move work across a mark.
__attribute__((always_inline)) inline void mark(uint8_t number) {
  __asm__ __volatile__("" ::: "memory");
  GPIOR0 = number;
  __asm__ __volatile__("" ::: "memory");
}

volatile float sink, other_sink, tilt_sink;

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
  const Frame<float> frame = {2978.4f,  1072.6f, 0,           139.1f,
                              10.1063f, sled,    0.00137293f, Feed::kOverTop};
  EffectParams<float> effects;
  TypicalSizes sizes = {wanted, effects.value};
  Effects::For<float>::visit(sizes);
  return prepare(frame, effects);
}

/// The published sled with two brackets, with the usual faults of the chains' pitch.
Quadrilateral<float> bracketMachine() {
  const Frame<float> frame = {2978.4f,  1072.6f, 0,           139.1f,
                              10.1063f, 97.9f,   0.00137293f, Feed::kOverTop};
  return prepare(frame, BracketSled<float>{310, 139, 79}, PitchStrain<float>{0.001f, 0.001f});
}

Point<float> gridPlace(uint8_t column, uint8_t row) {
  return {-1219.2f + 2438.4f * column / (bench::kColumns - 1),
          -609.6f + 1219.2f * row / (bench::kRows - 1)};
}

/// Stores an answer; if there is none, sleeps with interrupts off, which the simulator reports.
void note(Found found, float first, float second, float tilt_sine) {
  sink = first;
  other_sink = second;
  tilt_sink = tilt_sine;
  if (found == Found::kYes) return;
  sleep_enable();
  sleep_cpu();
}

void timeTilted(uint8_t number, const Quadrilateral<float>& machine, Point<float> place) {
  const float before = inverse(machine, Point<float>{place.x - 0.09f, place.y + 0.12f}).tilt_sine;
  const bool is_near = bench::kCases[number].what == bench::kTiltedInverseNear;
  mark(number + 1);
  const TiltedPaidOut<float> timed =
      is_near ? inverse(machine, place, before) : inverse(machine, place);
  note(timed.found, timed.chains.left, timed.chains.right, timed.tilt_sine);
  mark(0);
}

void timeOne(uint8_t number, const Machine<float>& machine, Point<float> place) {
  const Chains<float> chains = inverse(machine, place).chains;
  const Point<float> near = {place.x + 0.1f, place.y - 0.1f};
  const bench::What what = bench::kCases[number].what;
  if (what == bench::kInverse) {
    mark(number + 1);
    const PaidOut<float> paid = inverse(machine, place);
    sink = paid.chains.left;
    other_sink = paid.chains.right;
  } else if (what == bench::kForward) {
    mark(number + 1);
    sink = forward(machine, chains).sled.x;
  } else if (what == bench::kForwardNear) {
    mark(number + 1);
    sink = forward(machine, chains, near).sled.x;
  } else {
    mark(number + 1);
    sink = place.x;
  }
  mark(0);
}

}  // namespace

int main() {
  const Quadrilateral<float> brackets = bracketMachine();
  for (uint8_t i = 0; i < bench::kCaseCount; ++i) {
    const bool is_tilted = bench::kCases[i].what >= bench::kTiltedInverse;
    const Machine<float> machine = machineFor(bench::kCases[i]);
    for (uint8_t column = 0; column < bench::kColumns; ++column)
      for (uint8_t row = 0; row < bench::kRows; ++row) {
        const Point<float> place = gridPlace(column, row);
        is_tilted ? timeTilted(i, brackets, place) : timeOne(i, machine, place);
      }
  }
  GPIOR0 = bench::kFinished;
  for (;;) {
  }
}
