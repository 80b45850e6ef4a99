// Runs the kinematics of the sled with two brackets over the sheet on the (simulated) Mega; marks
// as in board_program.cpp.
#include <avr/io.h>
#include <avr/sleep.h>

#include "quadrilateral.h"
#include "quadrilateral_cases.h"

using namespace kinematics;

namespace {

// The compiler must not move work across a mark.
#define BARRIER() __asm__ __volatile__("" ::: "memory")

volatile float sink, other_sink, tilt_sink;

Quadrilateral<float> machine;

/// The published sled, with the usual faults of the chains' pitch.
void prepareMachine() {
  const Frame<float> frame = {2978.4f,  609.6f + 463.0f, 0.0f,        139.1f,
                              10.1063f, 97.9f,           0.00137293f, Feed::kOverTop};
  machine = prepare(frame, BracketSled<float>{310, 139, 79}, PitchStrain<float>{0.001f, 0.001f});
}

void mark(uint8_t number) {
  BARRIER();
  GPIOR0 = number;
  BARRIER();
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

void note(const TiltedPaidOut<float>& paid) {
  note(paid.found, paid.chains.left, paid.chains.right, paid.tilt_sine);
}

void note(const TiltedPlace<float>& place) {
  note(place.found, place.sled.x, place.sled.y, place.tilt_sine);
}

void timeInverse(uint8_t number, Point<float> place) {
  if (bench::kCases[number].what == bench::kInverse) {
    mark(number + 1);
    const TiltedPaidOut<float> paid = inverse(machine, place);
    note(paid);
    mark(0);
    return;
  }
  const float before = inverse(machine, Point<float>{place.x - 0.09f, place.y + 0.12f}).tilt_sine;
  mark(number + 1);
  const TiltedPaidOut<float> paid = inverse(machine, place, before);
  note(paid);
  mark(0);
}

void timeForward(uint8_t number, Point<float> place) {
  const bench::What what = bench::kCases[number].what;
  const TiltedPaidOut<float> paid = inverse(machine, place);
  if (what == bench::kForward) {
    mark(number + 1);
    const TiltedPlace<float> found = forward(machine, paid.chains);
    note(found);
    mark(0);
    return;
  }
  const Point<float> far = {place.x > 0 ? -1219.2f : 1219.2f, place.y > 0 ? -609.6f : 609.6f};
  const Point<float> near = {place.x + 0.1f, place.y - 0.1f};
  const Point<float> guess = what == bench::kForwardFar ? far : near;
  mark(number + 1);
  const TiltedPlace<float> found = forward(machine, paid.chains, guess, paid.tilt_sine);
  note(found);
  mark(0);
}

void timeOne(uint8_t number, Point<float> place) {
  switch (bench::kCases[number].what) {
    case bench::kNothing:
      mark(number + 1);
      mark(0);
      break;
    case bench::kInverse:
    case bench::kInverseNear:
      timeInverse(number, place);
      break;
    default:
      timeForward(number, place);
  }
}

}  // namespace

int main() {
  prepareMachine();
  for (uint8_t i = 0; i < bench::kCaseCount; ++i)
    for (uint8_t column = 0; column < bench::kColumns; ++column)
      for (uint8_t row = 0; row < bench::kRows; ++row)
        timeOne(i, {-1219.2f + 2438.4f * column / (bench::kColumns - 1),
                    -609.6f + 1219.2f * row / (bench::kRows - 1)});
  GPIOR0 = bench::kFinished;
  for (;;) {
  }
}
